// The viewer's picking: clicks and actions on the one side, rays through the picture on the other.
#include <imgui.h>

#include "base/atomic_file.h"
#include "viewer/panels/sections.h"
#include "viewer/teaching.h"
#include "viewer/viewer.h"

namespace unshot {
namespace {

constexpr float kStill = 4;  // a click moves the mouse by less, at scale 1 [px]

}  // namespace

/// Takes what was clicked or asked for, in a frame that knows the size of the picture.
void Viewer::pickClicked() {
  const SceneSplit split = splitScene(scene_width_, state_->rival.has_value());
  if (!sceneStands() || scene_height_ <= 0 || split.left <= 0) return;
  if (pick_wanted_) pickAt(scene_.cameraOf(wanted()), split.left, *pick_wanted_);
  pick_wanted_.reset();
  const ImGuiIO& io = ImGui::GetIO();
  const float still = kStill * static_cast<float>(scale_);
  // A click that closes a list is for that alone.
  if (!io.MouseReleased[ImGuiMouseButton_Left] || io.WantCaptureMouse ||
      io.MouseDownOwned[ImGuiMouseButton_Left] ||
      io.MouseDragMaxDistanceSqr[ImGuiMouseButton_Left] > still * still)
    return;
  const ImVec2 mouse = io.MouseClickedPos[ImGuiMouseButton_Left];
  if (const auto place = placeUnder({mouse.x, mouse.y})) pickAt(markedCamera(), place->width, place->at);
}

std::optional<Viewer::PicturePlace> Viewer::placeUnder(const glm::dvec2& mouse) const {
  const SceneSplit split = splitScene(scene_width_, state_->rival.has_value());
  const bool second = split.right > 0 && mouse.x >= split.right_at;
  const int left = second ? split.right_at : 0, width = second ? split.right : split.left;
  if (width <= 0 || scene_height_ <= 0) return std::nullopt;
  const glm::dvec2 at((mouse.x - left) / width, mouse.y / scene_height_);
  if (!(at.x >= 0 && at.x <= 1 && at.y >= 0 && at.y <= 1)) return std::nullopt;
  return PicturePlace{width, at};
}

void Viewer::pickAt(const Camera& camera, int width, const glm::dvec2& at) {
  const double aspect = static_cast<double>(width) / scene_height_;
  const Mesh& mesh = *state_->snapshot->mesh;
  const Sight sight = sightAt(camera, aspect, {mesh.bounds_min, mesh.bounds_max}, at);
  const bool first = !picking_.picked();
  picking_.pick(*state_, sight.from, sight.along);
  if (first && picking_.picked()) openSection(ui_, "picked", true);
  if (const auto& point = picking_.picked())
    ui_.material = state_->snapshot->mesh->surfaces[point->pick.surface].material;
  input();
}

void Viewer::lookUnderMouse() {
  const ImGuiIO& io = ImGui::GetIO();
  const ViewOptions& view = ui_.settings.view;
  const DisplayMode& mode = displayMode(view.display);
  const bool busy = io.WantCaptureMouse || ImGui::IsAnyMouseDown() || !ImGui::IsMousePosValid();
  const bool looks = mode.false_colour && ValueProbe::reads(mode.quantity) && view.light.all() && !busy &&
                     sceneStands() && !state_->rival && shownSnapshot();
  const auto place = looks ? placeUnder({io.MousePos.x, io.MousePos.y}) : std::nullopt;
  if (!place) return value_probe_.rest();
  const Mesh& mesh = *shownSnapshot()->mesh;
  const Sight sight = sightAt(markedCamera(), static_cast<double>(place->width) / scene_height_,
                              {mesh.bounds_min, mesh.bounds_max}, place->at);
  value_probe_.look({shownSnapshot(), mode.quantity, view.ambient, sight.from, sight.along});
}

Camera Viewer::markedCamera() const {
  // A GPU draws the scene in the frame that the marks are for.
  return renderer().hardware ? scene_.cameraOf(wanted()) : scene_.shownCamera();
}

void Viewer::pick(const glm::dvec2& at) {
  if (!state_->snapshot)
    throw Error(ErrorKind::kUsage, "there is no scene to look at yet", {}, "wait for it first: wait shots 1");
  pick_wanted_ = at;
}

void Viewer::unpick() {
  pick_wanted_.reset();
  picking_.unpick();
}

void Viewer::saveProbes(std::filesystem::path path) {
  const std::string text = picking_.csv(*state_);
  if (path.empty()) path = newFileName(".csv");
  writeWholeFile(path, text);
  notice("written: " + path.string());
}

void Viewer::copyValues() {
  ImGui::SetClipboardText(picking_.text(*state_).c_str());
  passingNotice("copied");
}

void Viewer::focusPicked() { navigator_.lookAt(picking_.required().pick.position); }

/// Tells what a lecture shows of what is picked, and takes what there is to show.
void Viewer::followTeaching() {
  const std::optional<PickedPoint>& point = picking_.picked();
  ViewOptions& view = ui_.settings.view;
  if (teaching_->follow(session_, *state_, point ? point->pick.patch : kNone, view.display)) input();
  const Insight* insight = teaching_->insight();
  const PatchInsight* patch = teaching_->patch();
  const bool of_picked = patch && point && patch->patch == point->pick.patch;
  view.form_factors = of_picked ? patch->sent_over : nullptr;
  view.last_shot = insight && insight->shot ? insight->shot->added : nullptr;
}

}  // namespace unshot
