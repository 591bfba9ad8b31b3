// How the viewer's camera moves: by mouse and keys, and to places that actions name.
#include <imgui.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <glm/geometric.hpp>
#include <iterator>
#include <utility>

#include "base/clock.h"
#include "base/text.h"
#include "session/pick.h"
#include "viewer/viewer.h"

namespace unshot {
namespace {

Bounds boundsOf(const Mesh& mesh) { return {mesh.bounds_min, mesh.bounds_max}; }

}  // namespace

void Viewer::navigate(double seconds) {
  const ImGuiIO& io = ImGui::GetIO();
  // What the mouse moved in the frame of a click, it moved before.
  const bool clicked = std::any_of(std::begin(io.MouseClicked), std::end(io.MouseClicked), std::identity());
  if (clicked) endHint();
  if (!io.WantCaptureMouse && !clicked && (io.MouseDelta.x != 0 || io.MouseDelta.y != 0)) {
    const glm::dvec2 motion(io.MouseDelta.x, io.MouseDelta.y);
    if (io.MouseDown[ImGuiMouseButton_Middle] || (io.MouseDown[ImGuiMouseButton_Left] && io.KeyShift)) {
      navigator_.pan(motion, scene_height_);
    } else if (io.MouseDown[ImGuiMouseButton_Left]) {
      navigator_.orbit(motion, scene_height_);
    } else if (io.MouseDown[ImGuiMouseButton_Right]) {
      navigator_.look(motion, scene_height_);
    }
  }
  if (!io.WantCaptureMouse && io.MouseWheel != 0) {
    if (io.MouseDown[ImGuiMouseButton_Right]) {
      navigator_.scaleSpeed(std::pow(1.25, io.MouseWheel));
      passingNotice("flying " + std::string(io.MouseWheel > 0 ? "faster" : "slower") + ": " +
                    figureText(navigator_.speedFactor()) + " times the usual speed");
    } else {
      zoomAtMouse(io.MouseWheel);
    }
  }
  glm::dvec3 direction(0.0);
  if (!io.WantTextInput && !io.KeyCtrl && !io.KeyAlt && !io.KeySuper) {
    const auto axis = [&](int plus, int minus) {
      return (io.KeysDown[plus] ? 1.0 : 0.0) - (io.KeysDown[minus] ? 1.0 : 0.0);
    };
    direction = {axis('D', 'A'), axis('E', 'Q'), axis('W', 'S')};
  }
  navigator_.fly(direction, io.KeyShift);
  navigator_.advance(seconds);
  pickClicked();
  lookUnderMouse();
  // By actions, too.
  if (const Camera before = std::exchange(seen_camera_, navigator_.camera()); before != seen_camera_)
    noteMotion();
}

/// To what is under the mouse; where nothing is, as far as the point looked at.
void Viewer::zoomAtMouse(double notches) {
  const ImVec2 position = ImGui::GetIO().MousePos;
  const glm::dvec2 mouse(position.x, position.y);
  const std::optional<PicturePlace> place = placeUnder(mouse);
  if (!sceneStands() || !place) return navigator_.zoom(notches);
  const Camera& camera = navigator_.camera();
  const glm::dvec3 forward = viewBasis(camera).forward;
  const bool same = zoom_target_ && zoom_target_->mouse == mouse && zoom_target_->camera == camera &&
                    (camera.orthographic || glm::dot(zoom_target_->point - camera.eye, forward) > 0);
  if (!same) {
    const Mesh& mesh = *state_->snapshot->mesh;
    const double aspect = static_cast<double>(place->width) / scene_height_;
    const Sight sight = sightAt(scene_.cameraOf(wanted()), aspect, boundsOf(mesh), place->at);
    const std::optional<Pick> found = pickAlong(mesh, sight.from, sight.along);
    const double way = glm::dot(camera.at - sight.from, forward) / glm::dot(sight.along, forward);
    zoom_target_ = {mouse, camera, found ? found->position : sight.from + way * sight.along};
  }
  navigator_.zoom(notches, zoom_target_->point);
  zoom_target_->camera = navigator_.camera();
}

/// The scene was read again, and may have another frame and other bounds: the camera stays where it was.
void Viewer::followFrame(const SessionState& before) {
  if (!before.snapshot || !state_->snapshot) return;
  const Mesh &old = *before.snapshot->mesh, &mesh = *state_->snapshot->mesh;
  const glm::dvec3 shift = old.frame_origin - mesh.frame_origin;
  if (shift == glm::dvec3(0.0)) return;
  const auto moved = [&](Camera camera) {
    camera.eye += shift;
    camera.at += shift;
    return camera;
  };
  if (found_camera_) found_camera_ = moved(*found_camera_);
  navigator_.reset(moved(navigator_.camera()), boundsOf(mesh));
}

void Viewer::frameScene() { wantFrame(false); }

void Viewer::wantFrame(bool from_memory) {
  frame_wanted_ = true;
  camera_from_memory_ = from_memory;
  view_wanted_at_ = wallSeconds();
}

void Viewer::followShape(int width, int height, double now) {
  constexpr double kShapeRests = 0.3;  // [s], so that nothing jumps while an edge is dragged
  const double aspect = static_cast<double>(width) / std::max(height, 1);
  if (aspect != std::exchange(window_aspect_, aspect)) shape_rests_at_ = now + kShapeRests;
}

/// A camera that was found by itself, and not moved since, is found again for a window of another shape.
void Viewer::fitToShape(double now) {
  if (now < shape_rests_at_ || !sceneStands() || !screenshots_.empty()) return;
  shape_rests_at_ = kNever;
  if (framed_aspect_ == window_aspect_ || navigator_.camera() != found_camera_) return;
  frameScene();
  input();
}

/// Of one of the pictures, where there are two; those that are higher than wide show as much as square ones.
double Viewer::pictureAspect() const {
  const bool race = state_->rival.has_value();
  const double aspect =
      static_cast<double>(std::max(splitScene(scene_width_, race).left, 1)) / std::max(scene_height_, 1);
  return race ? std::max(aspect, 1.0) : aspect;
}

const Mesh& Viewer::requiredMesh() const {
  if (!state_->snapshot)
    throw Error(ErrorKind::kUsage, "there is no scene to look at yet", {}, "wait for it first: wait shots 1");
  return *state_->snapshot->mesh;
}

void Viewer::placeCamera(const Camera& camera) {
  navigator_.reset(camera, boundsOf(requiredMesh()));
  frame_wanted_ = false;
  framed_scene_ = state_->facts->scene_path;
}

void Viewer::setCamera(const glm::dvec3& eye, const glm::dvec3& at, std::optional<double> fov_deg) {
  const glm::dvec3& origin = requiredMesh().frame_origin;
  Camera camera = navigator_.camera();
  camera.eye = eye - origin;
  camera.at = at - origin;
  if (fov_deg) camera.fov_deg = *fov_deg;
  placeCamera(camera);
}

void Viewer::viewAlong(const AxisView& view) {
  placeCamera(axisCamera(view, boundsOf(requiredMesh()), navigator_.camera(), pictureAspect()));
}

std::optional<Camera> Viewer::cameraInFile() const {
  if (!state_->snapshot) return std::nullopt;
  Camera camera = navigator_.camera();
  camera.eye += state_->snapshot->mesh->frame_origin;
  camera.at += state_->snapshot->mesh->frame_origin;
  return camera;
}

std::optional<Bounds> Viewer::boundsInFile() const {
  if (!state_->snapshot) return std::nullopt;
  const Mesh& mesh = *state_->snapshot->mesh;
  return Bounds{mesh.bounds_min + mesh.frame_origin, mesh.bounds_max + mesh.frame_origin};
}

void Viewer::copyCamera(bool options) {
  requiredMesh();
  const Camera camera = *cameraInFile();
  ImGui::SetClipboardText((options ? cameraOptions(camera) : cameraLines(camera)).c_str());
  if (options && camera.orthographic)
    return notice("copied; unshot solve has no options for orthographic cameras");
  passingNotice("copied");
}

}  // namespace unshot
