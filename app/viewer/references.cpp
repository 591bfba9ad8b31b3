// What the viewer's picture is compared with, read from files beside the window.
#include "viewer/comparison.h"
#include "viewer/viewer.h"

namespace unshot {

void Viewer::loadReference(const std::filesystem::path& ply) {
  requiredMesh();
  reference_load_.begin(
      ply,
      [ply, snapshot = state_->snapshot](const CancelToken& cancel) {
        return loadedLight(*snapshot, ply, cancel);
      },
      setup_.session.wake);
}

void Viewer::forget() {
  reference_load_.giveUp();
  ui_.settings.view.reference.reset();
}

void Viewer::loadReferencePicture(const std::filesystem::path& file) {
  picture_load_.begin(
      file, [file](const CancelToken& cancel) { return ReferencePicture::read(file, cancel); },
      setup_.session.wake);
}

void Viewer::forgetReferencePicture() {
  picture_load_.giveUp();
  reference_picture_.reset();
}

/// Takes what is read.
void Viewer::followLoads() {
  try {
    if (auto light = reference_load_.take()) {
      if ((*light)->mesh->cut != requiredMesh().cut)
        throw Error(ErrorKind::kUsage, "the scene is another by now than when this was asked for",
                    reference_load_.file().string(), "asking for it again");
      ui_.settings.view.reference = *light;
      notice("compared with " + (*light)->name);
    }
    if (const auto content = picture_load_.take()) {
      reference_picture_ = std::make_shared<ReferencePicture>(*setup_.display, *content);
      notice("compared with " + reference_picture_->name());
    }
  } catch (const Error& error) {
    fail(error);
  }
}

}  // namespace unshot
