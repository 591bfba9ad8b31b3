// The frames of the viewer: when there is something to draw, how much of it at a time, and drawing it.
#include <imgui_internal.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "base/clock.h"
#include "base/srgb.h"
#include "viewer/comparison.h"
#include "viewer/panels/false_colour_panel.h"
#include "viewer/panels/hemicube_panel.h"
#include "viewer/panels/lecture_panel.h"
#include "viewer/panels/panels.h"
#include "viewer/panels/reference_picture_panel.h"
#include "viewer/panels/status_line.h"
#include "viewer/teaching.h"
#include "viewer/viewer.h"

namespace unshot {
namespace {

constexpr double kFrameSeconds = 1.0 / 60;
constexpr double kSnapshotSeconds = 1.0 / 30;
// New light is drawn so seldom that the solver keeps most of a machine whose CPU draws.
constexpr double kSoftwareShare = 4;  // times the cost of a frame
constexpr double kRestSeconds = 0.2;  // without motion, before the picture is sharpened
// While the camera moves, a picture that would take longer is drawn coarser.
constexpr double kFluentSeconds = 0.025;
constexpr int kCoarseDivisor = 2;
// In software the window hears nothing for a slice of this length.
constexpr double kSliceSeconds = 0.004;
// However many inputs come, a picture in the making has this long between two frames.
constexpr double kSceneSeconds = 0.01;
// And while the mouse moves the camera, what else changes waits to be painted with it, so long at most.
constexpr double kPaintSeconds = 0.05;
// A window that waits for something shows how far it is.
constexpr double kProgressSeconds = 0.1;
// The difference from a reference picture is found no more often than so, and not while the camera moves.
constexpr double kMeasureSeconds = 0.5;
constexpr float kRoomy = 32;  // of a window, in letters' heights

bool idle(SessionPhase phase) { return phase != SessionPhase::kRunning && phase != SessionPhase::kLoading; }

/// Whether something is typed, or done with the mouse over the window.
bool userActs() {
  const ImGuiIO& io = ImGui::GetIO();
  const auto down = [](bool held) { return held; };
  return io.MouseDelta.x != 0 || io.MouseDelta.y != 0 || io.MouseWheel != 0 ||
         std::any_of(std::begin(io.MouseDown), std::end(io.MouseDown), down) ||
         std::any_of(std::begin(io.KeysDown), std::end(io.KeysDown), down);
}

/// The GUI is laid out in pixels of the framebuffer, as the scene is, whatever unit the window system counts
/// in: the host's sizes and places become pixels.
void layOutInPixels(ImGuiIO& io) {
  const ImVec2 scale = io.DisplayFramebufferScale;
  if (!(scale.x > 0 && scale.y > 0) || (scale.x == 1 && scale.y == 1)) return;
  io.DisplaySize = {io.DisplaySize.x * scale.x, io.DisplaySize.y * scale.y};
  // ImGui has a place that is no place.
  if (ImGui::IsMousePosValid(&io.MousePos)) io.MousePos = {io.MousePos.x * scale.x, io.MousePos.y * scale.y};
  io.DisplayFramebufferScale = {1, 1};
}

}  // namespace

double Viewer::nextFrame(double now) const {
  return closing() ? now : std::min(nextPaint(), nextSceneWork());
}

/// When the window itself waits for a frame.
double Viewer::nextPaint() const {
  const bool poses = screenshots_.posing() && (!screenshots_.panelsStand() || screenshotStands());
  if (gui_frames_ == 0 && !poses && !navigator_.moving()) {
    const bool waits = waitsForFiles() || looksForView() || scene_.waits(wanted()) || state_->saving ||
                       state_->editing || state_->refining || state_->phase == SessionPhase::kLoading ||
                       teaching_->preparing().has_value();
    return std::min(waits ? last_frame_ + kProgressSeconds : kNever, nextMeasure());
  }
  const double soon = last_frame_ + kFrameSeconds;
  const bool unlit = screenshots_.posing() && !screenshots_.lit();
  const bool making =
      scene_.framing() || screenshots_.drawing() || unlit || (sceneStands() && scene_.outdated(wanted()));
  return making && !renderer().hardware ? std::max(soon, last_frame_end_ + kSceneSeconds) : soon;
}

/// When the picture of the scene is to be gone on with.
double Viewer::nextSceneWork() const {
  if (scene_.framing() || screenshots_.drawing() || coming_picture_ ||
      (sceneStands() && scene_.outdated(wanted())))
    return last_scene_work_;
  if (screenshots_.posing() && !screenshots_.lit()) return last_scene_work_;
  const double soon = last_scene_work_ + kFrameSeconds;
  if ((sceneStands() && scene_.gliding()) || looksForView()) return soon;
  const double fine = coarse_ ? last_motion_ + kRestSeconds : kNever;
  if (hasNewSnapshot()) return std::min(nextSnapshot(), fine);
  if (coarse_) return fine;
  // In software a picture is sharpened slice upon slice: nobody moves, and each lasts a few milliseconds.
  const double next = renderer().hardware ? soon : last_scene_work_;
  return mayBeSharpened(kNever) ? std::max(next, last_motion_ + kRestSeconds) : kNever;
}

double Viewer::nextSnapshot() const {
  const double share = renderer().hardware ? 1 : kSoftwareShare;
  return last_picture_ + std::max(kSnapshotSeconds, share * frame_cost_);
}

bool Viewer::mayBeSharpened(double now) const {
  return idle(state_->phase) && !scene_.empty() && !scene_.sharp() && !scene_.framing() &&
         screenshots_.empty() && !navigator_.moving() && now >= last_motion_ + kRestSeconds;
}

/// Looks for a camera, where one is wanted. Returns whether it was found.
bool Viewer::frame() {
  if (recallCamera()) return true;
  if (frame_wanted_ && scene_.snapshot() == state_->snapshot && state_->snapshot &&
      (state_->measures.shots > 0 || idle(state_->phase))) {
    frame_wanted_ = false;
    framed_scene_ = state_->facts->scene_path;
    framed_aspect_ = window_aspect_;
    scene_.startFraming(static_cast<double>(std::max(scene_width_, 1)) / std::max(scene_height_, 1));
  }
  const std::optional<Camera> camera = scene_.continueFraming(kSliceSeconds);
  if (!camera) return false;
  const Mesh& mesh = *scene_.snapshot()->mesh;
  const Bounds bounds{mesh.bounds_min, mesh.bounds_max};
  navigator_.reset(
      navigator_.camera().orthographic ? parallelCamera(*camera, bounds, pictureAspect()) : *camera, bounds);
  found_camera_ = navigator_.camera();
  scene_.snapExposure();
  last_motion_ = last_frame_;
  input();
  return true;
}

/// A scene without its camera is not shown: the picture of the one before stays.
bool Viewer::sceneStands() const {
  return !scene_.empty() && !scene_.framing() && state_->facts && framed_scene_ == state_->facts->scene_path;
}

SceneDisplay::Wanted Viewer::wanted() const {
  const int samples = renderer().hardware ? 2 : 1;
  if (screenshots_.posing()) {
    const Screenshots::Subject& subject = screenshots_.subject();
    return {subject.camera, subject.settings, scene_width_, scene_height_, samples};
  }
  return {navigator_.camera(), ui_.settings, scene_width_,
          scene_height_,       samples,      coarse_ ? kCoarseDivisor : 1};
}

/// Pictures of a camera that moves are coarse where fine ones take long; at rest all of them are fine.
void Viewer::noteMotion() {
  last_motion_ = last_frame_;
  coarse_ = !renderer().hardware && fine_cost_ > kFluentSeconds;
}

void Viewer::followRest(double now) {
  if (coarse_ && !navigator_.moving() && now >= last_motion_ + kRestSeconds) coarse_ = false;
}

std::shared_ptr<const Snapshot> Viewer::rivalSnapshot() const {
  return state_->rival ? state_->rival->snapshot : nullptr;
}

bool Viewer::hasNewSnapshot() const {
  return !snapshotRefused() && !scene_.has(state_->snapshot, rivalSnapshot());
}

void Viewer::takeSnapshot(double now) {
  // A screenshot is of one state from its beginning to its end.
  if (screenshots_.drawing() || (screenshots_.posing() && screenshots_.lit())) return;
  const bool poses = screenshots_.posing();
  if (poses && !hasNewSnapshot()) screenshots_.setLit();
  if (!hasNewSnapshot()) return;
  // What is half drawn is of one state; the next picture shows the new one.
  const bool same_mesh =
      state_->snapshot && scene_.snapshot() && state_->snapshot->mesh->cut == scene_.snapshot()->mesh->cut;
  if (same_mesh && sceneStands() && scene_.drawing()) return;
  // A picture that is drawn for another reason shows the newest.
  const bool drawn_anyway = sceneStands() && scene_.outdated(wanted());
  if (now < nextSnapshot() && !drawn_anyway && !frame_wanted_ && !poses) return;
  if (poses) screenshots_.setLit();
  try {
    scene_.setSnapshots(state_->snapshot, rivalSnapshot());
  } catch (const Error& error) {  // too large for the driver: the picture before stays
    refused_snapshot_ = state_->snapshot;
    fail(error);
  }
}

bool Viewer::prepare() {
  const double now = wallSeconds();
  const bool paint = nextPaint() <= now;
  if (paint && !renderer().hardware) return true;
  takeSnapshot(now);
  const bool framed = frame();
  // A GPU draws all of it in the frame.
  const bool shown = sceneStands() && (renderer().hardware || drawScene(now, now + kSliceSeconds));
  if (screenshots_.drawing()) drawScreenshot(wallSeconds() + kSliceSeconds);
  if (coming_picture_) sendReferencePicture(wallSeconds() + kSliceSeconds);
  last_scene_work_ = wallSeconds();
  if (drew_scene_) picture_cost_ += last_scene_work_ - now;
  return paint || shown || framed;
}

/// Goes on with the picture of the scene until about `deadline`. Returns whether there is another one to
/// show.
bool Viewer::drawScene(double now, double deadline) {
  const double passed = std::min(now - std::exchange(last_scene_, now), 0.1);
  const double seconds = screenshots_.posing() ? -1 : passed;  // its exposure does not glide
  if (scene_.draw(wanted(), seconds, deadline)) {
    drew_scene_ = true;
    return !scene_.drawing();
  }
  if (!mayBeSharpened(now)) return false;
  const auto before = scene_.version();
  scene_.sharpen(renderer().hardware ? 3 : 2, deadline);
  return scene_.version() != before;
}

bool Viewer::draw(GLuint framebuffer, int width, int height) {
  const double now = wallSeconds();
  const double seconds = std::min(now - last_frame_, 0.1);
  last_frame_ = now;
  if (gui_frames_ > 0) --gui_frames_;
  followShape(width, height, now);
  const BesideScene beside = besideScene(*this, width);
  scene_width_ = width - beside.panel - beside.lecture;
  scene_height_ = height;
  measureReference(now);
  const bool stands = screenshotStands();
  layOutInPixels(ImGui::GetIO());
  ImGui::NewFrame();
  if (std::exchange(close_popups_, false)) ImGui::ClosePopupToLevel(0, false);
  if (userActs() && notice_.userActs(now)) input();
  navigate(seconds);
  const bool covered = beside.over > 0;
  const float bottom =
      static_cast<float>(height) - (ui_.clean || covered ? 0 : buildStatusLine(*this, scene_width_));
  // What is to be read stands beside a panel that lies over the scene, where there is room.
  const int uncovered = scene_width_ - beside.over;
  const bool beside_panel = covered && uncovered >= beside.over;
  LowerEdge edge(static_cast<float>(beside_panel ? uncovered : scene_width_), belowNames(*this), bottom);
  if (!ui_.clean) buildSidePanel(*this, width - beside.panel - beside.over);
  // Where there is little room a list or the help would lie over legends.
  const bool crowded =
      (ui_.prompt.open() || ui_.help) && static_cast<float>(height) < kRoomy * ImGui::GetFontSize();
  if ((!ui_.clean || ui_.clean_legend) && !covered && !crowded) buildFalseColourLegend(*this, edge);
  if (!ui_.clean && !covered && !crowded) {
    buildReferencePicture(*this, bottom, edge);
    buildLegend(*state_, ui_.settings.view, edge);
    buildLectureMarks(*this, scene_width_);
    buildLecture(*this, scene_width_, beside.lecture);
    buildHemicube(*this, edge);
  }
  const bool looks = looksForView() && now >= view_wanted_at_ + Task::kMoment;
  buildOverlays(*this, edge, covered, !stands, looks);
  ImGui::Render();

  if (renderer().hardware) {
    takeSnapshot(now);
    if (sceneStands()) drawScene(now, SceneDisplay::kAtOnce);
  }
  if (screenshots_.posing()) screenshots_.noteFrame();
  if (stands) {  // this frame is for the file, which shows no notices
    keepScreenshot(width, height);
    input();
    last_frame_end_ = wallSeconds();
    return false;
  }
  const PaintedLook look{framebuffer, width, height, scene_.version(), fingerprint(*ImGui::GetDrawData())};
  const bool differs = painted_ != look;
  const bool changed = differs && !waitsForPicture(now);
  if (changed) {
    painted_ = look;
    painted_camera_ = scene_.shownCamera();
    unpainted_since_.reset();
    paint(framebuffer, width, height);
  } else if (differs) {
    if (!unpainted_since_) unpainted_since_ = now;
    gui_frames_ = std::max(gui_frames_, 1);
  }
  gl::checkErrors(setup_.display->functions(), "drawing a frame of the viewer");
  if (!changed) last_frame_end_ = wallSeconds();
  return changed;
}

/// Whether a frame of the same view is not worth its time: the camera has moved, with the mouse over the
/// scene, and a renderer in software that paints the window draws the scene later by as much.
bool Viewer::waitsForPicture(double now) const {
  return !renderer().hardware && !ImGui::GetIO().WantCaptureMouse && sceneStands() && painted_ &&
         painted_camera_ == scene_.shownCamera() && now < last_motion_ + kRestSeconds &&
         now < unpainted_since_.value_or(now) + kPaintSeconds &&
         (scene_.drawing() || scene_.outdated(wanted()));
}

void Viewer::damaged() {
  painted_.reset();
  input();
}

void Viewer::presented() {
  last_frame_end_ = wallSeconds();
  if (!std::exchange(drew_scene_, false)) return;
  picture_cost_ += last_frame_end_ - last_frame_;
  if (scene_.drawing()) return;
  last_picture_ = last_frame_end_;
  const double cost = std::exchange(picture_cost_, 0);
  if (!scene_.drawnAnew()) return;
  if (!scene_.coarse()) fine_cost_ = cost;
  costs_.note(cost);
  frame_cost_ = costs_.usual();
  // What would not be shown need not be made.
  const double share = renderer().hardware ? 1 : kSoftwareShare;
  session_.setPublishInterval(std::max(kSnapshotSeconds, share * frame_cost_));
}

const ReferencePicture* Viewer::referencePicture() const {
  const bool shown = reference_picture_ && !state_->rival && ReferencePicture::comparable(ui_.settings.view);
  return shown ? reference_picture_.get() : nullptr;
}

ReferencePicture::Look Viewer::referenceLook() const {
  return {ui_.settings.view, scene_.exposure(), ui_.wipe, ui_.picture_difference};
}

/// When the picture is to be compared with the reference again; infinity where that is done.
double Viewer::nextMeasure() const {
  if (!referencePicture() || !sceneStands() || coarse_ ||
      !reference_picture_->unmeasured(scene_, scene_width_, scene_height_, referenceLook()))
    return kNever;
  return std::max(last_measured_ + kMeasureSeconds, last_motion_ + kRestSeconds);
}

void Viewer::measureReference(double now) {
  if (now < nextMeasure()) return;
  last_measured_ = now;
  reference_picture_->measure(scene_, scene_width_, scene_height_, referenceLook());
}

void Viewer::paint(GLuint framebuffer, int width, int height) {
  const gl::Functions& fn = setup_.display->functions();
  fn.BindFramebuffer(GL_FRAMEBUFFER, framebuffer);
  if (!renderer().hardware && !std::exchange(copies_rehearsed_, true)) scene_.rehearseCopies();
  fn.Viewport(0, 0, width, height);
  const float background = static_cast<float>(srgbFromLinear(kBackground));
  fn.ClearColor(background, background, background, 1);
  fn.Clear(GL_COLOR_BUFFER_BIT);
  const auto copy_scene = [this](int columns) { scene_.copyTo(columns); };
  copy_scene(scene_width_);
  if (referencePicture())
    reference_picture_->draw(copy_scene, framebuffer, scene_width_, height, referenceLook());
  gui_.draw(*ImGui::GetDrawData(), width, height);
}

}  // namespace unshot
