// What the viewer's picture is compared with, read from files beside the window.
#include <utility>

#include "viewer/comparison.h"
#include "viewer/viewer.h"

namespace unshot {

void Viewer::loadReference(const std::filesystem::path& file) {
  requiredMesh();
  const std::filesystem::path ply = file;  // it may be that of the load before
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
  giveUpReferencePicture();
  picture_load_.begin(
      file, [file](const CancelToken& cancel) { return ReferencePicture::read(file, cancel); },
      setup_.session.wake);
}

void Viewer::giveUpReferencePicture() {
  picture_load_.giveUp();
  coming_picture_.reset();
}

void Viewer::forgetReferencePicture() {
  giveUpReferencePicture();
  reference_picture_.reset();
}

/// Goes on with sending one to the driver; once it is there it takes the place of the one before.
void Viewer::sendReferencePicture(double deadline) {
  try {
    coming_picture_->upload(deadline);
  } catch (...) {
    coming_picture_.reset();
    return fail(presentError());
  }
  if (coming_picture_->uploaded() < 1) return;
  reference_picture_ = std::exchange(coming_picture_, nullptr);
  notice("compared with " + reference_picture_->name());
}

/// Takes what is read.
void Viewer::followLoads() {
  try {
    if (auto light = reference_load_.take()) {
      // Where the mesh is another by now, it is wanted of that one.
      if ((*light)->mesh->cut != requiredMesh().cut) return loadReference(reference_load_.file());
      ui_.settings.view.reference = *light;
      notice("compared with " + (*light)->name);
    }
    if (auto content = picture_load_.take()) {
      coming_picture_ = std::make_shared<ReferencePicture>(*setup_.display, std::move(*content));
      input();
    }
  } catch (const Cancelled&) {
  } catch (...) {
    fail(presentError());
  }
}

}  // namespace unshot
