#include "viewer/viewer.h"

#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>

#include <algorithm>
#include <cmath>
#include <iostream>
#include <utility>

#include "base/atomic_file.h"
#include "base/clock.h"
#include "base/text.h"
#include "exit_codes.h"
#include "viewer/actions/actions.h"
#include "viewer/comparison.h"
#include "viewer/file_kinds.h"
#include "viewer/panels/panels.h"
#include "viewer/panels/theme.h"
#include "viewer/teaching.h"
#include "viewer/window_words.h"

namespace unshot {
namespace {

constexpr double kRateWindow = 1;
// Of the area, which no sky lights, where a room is closed: its inside is half of it or more.
constexpr double kDark = 0.4;
// A solve that took no longer may be begun anew by a step [s].
constexpr double kSoonAgain = 10;

}  // namespace

Viewer::GuiContext::GuiContext() {
  IMGUI_CHECKVERSION();
  ImGui::SetCurrentContext(ImGui::CreateContext());
  ImGui::GetIO().IniFilename = nullptr;
  ImGui::GetIO().LogFilename = nullptr;
}

Viewer::GuiContext::~GuiContext() { ImGui::DestroyContext(); }

Viewer::Viewer(ViewerSetup setup)
    : setup_(std::move(setup)),
      gui_(*setup_.display),
      scene_(*setup_.display, setup_.session.wake),
      screenshots_(*setup_.display, gui_, setup_.session.wake),
      session_(setup_.session),
      state_(session_.latest()),
      memory_(setup_.memory),
      teaching_(std::make_unique<Teaching>(*setup_.display, setup_.session.wake)),
      script_(setup_.script) {
  ui_.options = setup_.options;
  ui_.settings = setup_.settings;
  recallPanel();
  applyScale();
  if (!script_.empty()) hold_.emplace(session_);
  watching_ = setup_.watch;
  if (watching_ && !setup_.scene.empty()) watch_.opening(setup_.scene);
  if (setup_.scene.empty()) return;
  if (setup_.resume.empty()) {
    session_.open(setup_.scene, ui_.options);
  } else {
    session_.resumeSaved(setup_.scene, ui_.options, setup_.resume, setup_.error_given);
  }
}

Viewer::~Viewer() = default;

void Viewer::setScale(double scale) {
  relative_scale_ = scale / screen_scale_;
  applyScale();
}

void Viewer::setScreenScale(double scale) {
  screen_scale_ = scale;
  applyScale();
}

void Viewer::applyScale() {
  const double scale = std::clamp(screen_scale_ * relative_scale_, 0.5, 4.0);
  if (scale == scale_) return;
  scale_ = scale;
  applyTheme(ImGui::GetIO(), ImGui::GetStyle(), static_cast<float>(scale));
  gui_.setFonts(*ImGui::GetIO().Fonts);
  damaged();
}

// What happens.

void Viewer::update(double now) {
  if (setup_.interrupted && setup_.interrupted()) {
    exit_code_ = kExitInterrupted;
    closing_ = true;
    screenshots_.drop();
  }
  takeState(now);
  followRest(now);
  followTeaching();
  runScript(now);
  followLoads();
  followScreenshots(now);
  if (ending()) session_.beginClosing();
  if (watch_.look(now)) input();
  followHint(now);
  keepWhatRests(now);
  fitToShape(now);
  if (const std::string lost = memory_.takeComplaint(); !lost.empty()) notice(lost);
  if (notice_.expire(now)) input();
}

void Viewer::takeState(double now) {
  const std::shared_ptr<const SessionState> latest = session_.latest();
  if (latest->version == state_->version) return;
  if (latest->task_done != state_->task_done || latest->gathering != state_->gathering ||
      latest->completing != state_->completing)
    gui_frames_ = std::max(gui_frames_, 2);  // its window takes its size in the second
  const bool news = latest->phase != state_->phase || latest->problems != state_->problems;
  const bool another = latest->epoch != state_->epoch;
  if (another && opening_ && latest->snapshot && latest->snapshot->mesh->materials != edits_.materials())
    keepEdits();
  const std::shared_ptr<const SessionState> before = std::exchange(state_, latest);
  if (another) {
    rate_points_.clear();
    notice_.forgetErrorsOfSolve();
    if (script_.empty()) exit_code_ = 0;
    if (setup_.title) setup_.title(state_->facts->scene_name + " \u2013 Unshot");
    forgetOldLight();
    if (state_->resumed && opening_) noteResumed();
    if (state_->facts->scene_path != framed_scene_) {
      rememberCamera(*before);
      wantFrame(true);
      noteSky();
      memory_.noteScene(state_->facts->scene_path);
    } else {
      followFrame(*before);
    }
  }
  if ((news || another) && state_->phase == SessionPhase::kConverged) noteDarkness();
  takeMaterials();
  picking_.follow(*state_);
  noteRates(now);
  noteSaved(*before);
  if (state_->problems > problems_seen_ && state_->problem) {
    problems_seen_ = state_->problems;
    // Of a scene that cannot be read it is of interest when it is mended.
    if (!state_->facts || samePath(watch_.sceneOpening(), state_->facts->scene_path)) watch_.opened();
    // What was asked for is not to be had: the panel shows what is.
    if (state_->facts && session_.sent() == state_->commands) ui_.options = state_->facts->options;
    fail(*state_->problem, true);
  }
  gui_frames_ = std::max(gui_frames_, news || another ? kFramesAfterInput : 0);
}

/// Of a scene that emits nothing: the light in the picture is none of its own.
void Viewer::noteSky() {
  const Diagnostics& notes = state_->facts->diagnostics;
  const auto noteOf = [&](std::string_view code) {
    return std::find_if(notes.begin(), notes.end(), [&](const Diagnostic& d) { return d.code == code; });
  };
  const auto sky = noteOf("sky"), missing = noteOf("missing-mtl");
  if (sky == notes.end()) return;
  if (missing != notes.end()) {
    notice("No materials, so no light of its own: " +
           windowWords(missing->message + ". Try: " + missing->advice));
  } else {
    notice("No light of its own: " + windowWords(sky->message + ". To change it: " + sky->advice));
  }
}

/// Of a closed room that no lamp lights: the sky shines on its outside.
void Viewer::noteDarkness() {
  const Diagnostics& notes = state_->facts->diagnostics;
  const bool sky =
      std::any_of(notes.begin(), notes.end(), [](const Diagnostic& d) { return d.code == "sky"; });
  if (!sky || !state_->snapshot) return;
  const Mesh& mesh = *state_->snapshot->mesh;
  const std::vector<glm::vec3>& light = state_->snapshot->element_irradiance;
  double dark = 0, all = 0;
  for (std::uint32_t e = 0; e < mesh.element_count; ++e) {
    all += mesh.element_area[e];
    if (light[e] == glm::vec3(0.0f)) dark += mesh.element_area[e];
  }
  if (dark < kDark * all) return;
  notice(
      "It is dark inside: no face emits light, and the sky shines on the outside alone. Click a surface, "
      "then Make it a light, or give a material a Ke above 0 in the MTL file");
}

void Viewer::takeMaterials() {
  if (!state_->snapshot || session_.sent() != state_->commands) return;
  const std::vector<Material>& materials = state_->snapshot->mesh->materials;
  const std::optional<std::uint64_t> opened = std::exchange(opening_, std::nullopt);
  if (opened && state_->epoch > *opened) {
    edits_.begin(materials);
    edited_by_hand_ = false;
    // Watching may have been switched on while it was read.
    if (watching_ && watch_.sceneOpening() != state_->facts->scene_path)
      watch_.opening(state_->facts->scene_path);
    watch_.opened();
  } else if (edits_.materials() != materials) {
    edits_.adopt(materials);
  }
}

void Viewer::noteRates(double now) {
  rate_points_.push_back({now, state_->measures.shots, state_->measures.rows});
  while (rate_points_.size() > 2 && rate_points_[1].time < now - kRateWindow) rate_points_.pop_front();
}

Rates Viewer::rates() const {
  if (state_->phase != SessionPhase::kRunning || rate_points_.size() < 2) return {};
  const RatePoint &a = rate_points_.front(), &b = rate_points_.back();
  const double seconds = b.time - a.time;
  if (!(seconds > 0)) return {};
  return {static_cast<double>(b.shots - a.shots) / seconds, static_cast<double>(b.rows - a.rows) / seconds};
}

void Viewer::perform(std::string_view action, const std::string& argument) {
  try {
    const Action& row = findAction(action);
    if (ending() && action != "give-up" && action != "dismiss") return;  // it only ends what it has begun
    const std::string wrong = checkArgument(row, argument);
    if (!wrong.empty()) throw Error(ErrorKind::kUsage, wrong, {}, "H lists what can be done");
    const std::uint64_t sent = session_.sent();
    row.run(*this, argument);
    if (session_.sent() != sent) changes_sent_ = session_.sent();
    followTeaching();
  } catch (...) {
    fail(presentError());
  }
  input();
}

void Viewer::key(int key, bool ctrl) {
  endHint();
  // An open list has the keyboard, of which it takes Esc alone.
  if (ImGui::IsPopupOpen(nullptr, ImGuiPopupFlags_AnyPopup)) {
    close_popups_ = close_popups_ || key == GLFW_KEY_ESCAPE;
    return input();
  }
  if (ui_.prompt.open()) return;  // what is typed before its line is there is for it too
  if (const Action* action = actionOfKey(key, ctrl)) perform(action->key, action->argumentOfKey(key));
}

char Viewer::printedOn(char key) const {
  const char* const name = setup_.key_name ? setup_.key_name(key) : nullptr;
  const bool letter = name && name[0] >= 'a' && name[0] <= 'z' && name[1] == '\0';
  return letter ? static_cast<char>(name[0] - 'a' + 'A') : key;
}

/// Shown, said on the terminal, and remembered for the exit code where nobody may be looking.
void Viewer::fail(const Error& error, bool of_solve) {
  showError(error, of_solve);
  std::cerr << "unshot: " << error.fullText() << std::endl;
  if (exit_code_ == 0 && (!script_.empty() || state_->epoch == 0 || closing_))
    exit_code_ = exitCodeOf(error.kind());
}

void Viewer::showError(const Error& error, bool of_solve) {
  notice_.addError(inWindowWords(error), of_solve, wallSeconds());
  input();
}

void Viewer::dismiss() {
  if (error()) {
    notice_.dismissError();
  } else if (ui_.prompt.open()) {
    ui_.prompt.close();
  } else if (ui_.help) {
    ui_.help = false;
  } else if (giveUpShown()) {
    return;
  } else if (sceneChanged()) {
    keepScene();
  } else if (!notice_.dismissNotices()) {
    unpick();
  }
}

void Viewer::notice(std::string text) {
  notice_.add(std::move(text), wallSeconds());
  input();
}

void Viewer::passingNotice(std::string text) {
  notice_.addPassing(std::move(text), wallSeconds());
  input();
}

void Viewer::dismissNotices() {
  notice_.dismissNotices();
  input();
}

void Viewer::open(const std::filesystem::path& scene) {
  const FileKind* const kind = kindOfFile(scene);
  if (kind && kind->action != "open")
    throw Error(
        ErrorKind::kInput, "this is no scene but " + std::string(kind->what), scene.string(),
        std::string(kind->action.empty() ? kind->instead : "the action ") + std::string(kind->action));
  if (kind && !isScene(scene)) return resumeSaved(scene);
  if (watching_) watch_.opening(scene);
  session_.open(scene, ui_.options);
  opening_ = state_->epoch;
}

void Viewer::resumeSaved(const std::filesystem::path& file) {
  if (!state_->facts) {
    throw Error(ErrorKind::kUsage, "this is a saved solve: its scene has to be open", file.string(),
                "to open the scene first, or unshot view SCENE.obj --resume " + file.string());
  }
  const std::filesystem::path& scene = state_->facts->scene_path;
  if (watching_) watch_.opening(scene);
  session_.resumeSaved(scene, ui_.options, file, false);
  opening_ = state_->epoch;
}

/// What a solve goes on from decides on options, which the panel shows.
void Viewer::noteResumed() {
  ui_.options = state_->facts->options;
  const ResumedFrom& from = *state_->resumed;
  const std::string text = "goes on from " + from.path.string() + ": " + countedText(from.shots, "shot") +
                           " in " + figureText(from.seconds) + " s";
  std::cerr << "unshot: " << text << std::endl;
  notice(text);
}

void Viewer::giveUpLoading() {
  if (state_->phase != SessionPhase::kLoading) return;
  session_.giveUpLoading();
  if (state_->facts) ui_.options = state_->facts->options;  // the panel shows what stays
}

void Viewer::restart() {
  if (state_->epoch == 0) {
    open(setup_.scene);
  } else {
    session_.restart(ui_.options);
  }
}

void Viewer::edit(const std::function<void(MaterialEdits&)>& change) {
  // What is edited would be another scene's.
  if (opening_) throw Error(ErrorKind::kUsage, "a scene is being opened", {}, "to wait until it is there");
  const std::vector<Material> before = edits_.materials();
  change(edits_);
  if (edits_.materials() == before) return;
  edited_by_hand_ = edited_by_hand_ || !hold_;
  session_.edit(edits_.materials());
}

std::optional<double> Viewer::gesture() const {
  const ImGuiIO& io = ImGui::GetIO();
  return io.MouseDown[0] ? std::optional(io.MouseClickedTime[0]) : std::nullopt;
}

void Viewer::setMode(const std::string& key) {
  ui_.options.mode = key;
  session_.setMode(key);
}

void Viewer::setError(double error) {
  ui_.options.error = error;
  session_.setError(error);
}

void Viewer::pauseOrResume() {
  if (state_->phase == SessionPhase::kPaused) {
    session_.resume();
  } else {
    session_.pause();
  }
}

bool Viewer::solveGoesOn() const {
  return state_->phase == SessionPhase::kPaused || state_->phase == SessionPhase::kRunning;
}

bool Viewer::stepsFromNothing() const {
  return (state_->phase == SessionPhase::kConverged || state_->phase == SessionPhase::kStopped) &&
         state_->stopped_by != "no light" && state_->measures.seconds <= kSoonAgain;
}

void Viewer::step(std::uint64_t shots) {
  // A command under way may be what begins the solve anew; what a lecture asks to know is not.
  const bool up_to_date = changes_sent_ <= state_->commands;
  if (up_to_date && stepsFromNothing()) {
    const Session::Hold hold(session_);
    session_.shootAgain();
    session_.step(shots);
    return notice("step by step, from nothing shot; Resume goes on to the end");
  }
  if (up_to_date && state_->phase == SessionPhase::kConverged)
    notice(state_->stopped_by == "no light" ? "no light to shoot" : "converged; Again shoots it anew");
  if (up_to_date && state_->phase == SessionPhase::kStopped) notice("limit reached; Again shoots it anew");
  session_.step(shots);
}

void Viewer::setBounces(std::optional<std::uint32_t> bounces, bool alone) {
  ui_.settings.view.light = {true, bounces, bounces && alone};
  if (bounces) session_.completeBounces();
}

void Viewer::race(const std::optional<std::string>& key) {
  if (key) {
    session_.race(*key);
  } else {
    session_.endRace();
  }
}

void Viewer::remember() {
  ui_.settings.view.reference = rememberedLight(*state_, ui_.settings.view.light);
  passingNotice("remembered: " + ui_.settings.view.reference->name);
}

// Light of another mesh is no reference; bounces that were chosen are wanted of the new solve too.
void Viewer::forgetOldLight() {
  ViewOptions& view = ui_.settings.view;
  if (view.reference && view.reference->mesh->cut != state_->snapshot->mesh->cut) view.reference.reset();
  if (view.light.bounces) session_.completeBounces();
}

void Viewer::resizeWindow(int width, int height) {
  if (setup_.resize) setup_.resize(width, height);
}

void Viewer::fillScreen(std::optional<bool> on) {
  if (!setup_.full_screen) return passingNotice("without a window there is no screen to fill");
  setup_.full_screen(on);
}

double Viewer::nextUpdate() const {
  double next = ui_.hint && hint_until_ > 0 ? hint_until_ : kNever;
  next = std::min({next, notice_.nextExpiry(), watch_.nextLook(), nextKeeping(),
                   sceneStands() ? shape_rests_at_ : kNever});
  if (script_at_ < script_.size() && script_[script_at_].wait == WaitFor::kSeconds && wait_began_ >= 0)
    next = std::min(next, wait_began_ + script_[script_at_].amount);
  return next;
}

}  // namespace unshot
