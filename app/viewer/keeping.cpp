// What the viewer writes so that nothing is lost: solves and materials, when asked to and before they go.
#include <iostream>
#include <utility>

#include "base/atomic_file.h"
#include "base/clock.h"
#include "export/materials.h"
#include "viewer/viewer.h"

namespace unshot {

/// Writes what was made of the materials by hand and is in no file, before it goes. Scripts know what they
/// do.
void Viewer::keepEdits() {
  if (!edited_by_hand_ || !edits_.unsaved()) return;
  try {
    const std::filesystem::path path = rescueName(".mtl");
    writeMaterials(path, edits_.materials());
    edits_.noteSaved();
    const std::string text = "written: " + path.string() + " (materials as they were edited)";
    notice(text);
    if (closing_) std::cerr << "unshot: " << text << std::endl;
  } catch (...) {
    fail(presentError());
  }
}

void Viewer::saveMaterials(std::filesystem::path path) {
  if (path.empty()) path = newFileName(".mtl");
  if (edits_.materials().empty())
    throw Error(ErrorKind::kUsage, "there are no materials to save yet", {}, "open a scene");
  writeMaterials(path, edits_.materials());
  edits_.noteSaved();
  notice("written: " + path.string());
}

void Viewer::saveSolve(std::filesystem::path path) {
  if (path.empty()) path = newFileName(".unshot");
  if (state_->facts && samePath(path, state_->facts->scene_path))
    throw Error(ErrorKind::kUsage, "is the scene itself", path.string(), "another file name");
  checkWritable(path);
  passingNotice("saving the solve: " + path.string());
  input();
  session_.save(std::move(path));
}

void Viewer::noteSaved(const SessionState& before) {
  if (state_->saves > before.saves) notice("written: " + state_->saved_as.string());
}

void Viewer::finish() {
  closing_ = true;
  keepEdits();
  rememberCamera(*state_);
  rememberPanel();
  session_.close();
  takeState(wallSeconds());
}

/// For what has to be saved somewhere.
std::filesystem::path Viewer::rescueName(const std::string& ending) const {
  try {
    const std::filesystem::path path = newFileName(ending);
    checkWritable(path);
    return path;
  } catch (const Error&) {  // the working folder is gone, or not ours
    return newFileName(ending, std::filesystem::temp_directory_path());
  }
}

Error Viewer::rescue(const Error& error) {
  screenshots_.drop();
  const bool lost = setup_.session.kept.path.empty() && state_->facts && state_->measures.shots > 0;
  const std::filesystem::path path = lost ? rescueName(".unshot") : std::filesystem::path();
  const std::uint64_t saves = state_->saves;
  if (lost) session_.save(path);
  finish();
  if (state_->saves == saves) return error;
  return Error(error.kind(), error.what(), error.where(),
               "unshot view " + state_->facts->scene_path.string() + " --resume " + path.string() +
                   ", which goes on from what was shot");
}

}  // namespace unshot
