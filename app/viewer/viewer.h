// The viewer, whatever window it is in: a live session, the picture of its newest state, the camera and the
// panels.
//
// A host (window.h, offscreen.h) owns the contexts and the inputs: it feeds ImGui's IO, calls update() when
// something may have happened, and when nextFrame() says so prepare() and, where that asks for it, draw().
// All calls come from the main thread.
//
// In software a picture of the scene takes longer than a window may be deaf. It is made in slices of
// prepare(), between which the host looks for inputs; what these change is drawn over the picture before at
// once.
#pragma once

#include <imgui.h>

#include <deque>
#include <filesystem>
#include <functional>
#include <limits>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "session/session.h"
#include "viewer/background.h"
#include "viewer/camera_views.h"
#include "viewer/gui_renderer.h"
#include "viewer/material_edits.h"
#include "viewer/memory.h"
#include "viewer/messages.h"
#include "viewer/navigator.h"
#include "viewer/pace.h"
#include "viewer/picking.h"
#include "viewer/prompt.h"
#include "viewer/reference_picture.h"
#include "viewer/scene_area.h"
#include "viewer/scene_watch.h"
#include "viewer/screenshots.h"
#include "viewer/script.h"
#include "viewer/tasks.h"
#include "viewer/value_probe.h"

namespace unshot {

class Teaching;

struct ViewerSetup {
  gl::Context* display = nullptr;  ///< current on the main thread; outlives the viewer
  SessionSetup session;
  std::filesystem::path scene;
  std::filesystem::path resume;                ///< a saved solve of the scene, to go on from; empty: none
  bool error_given = false;                    ///< by `options`: it holds, and not that of `resume`
  std::vector<std::filesystem::path> bundled;  ///< scenes that the panel offers
  SolveOptions options;
  DisplaySettings settings;
  std::filesystem::path memory;  ///< the folder of what is remembered; empty: nothing is
  bool watch = false;            ///< looks whether the scene's files change
  std::vector<ScriptLine> script;
  std::string script_name;
  /// Asks the window for another size [px]; may be empty.
  std::function<void(int, int)> resize;
  /// Makes the window fill its screen or go back to its place (none: the other of both); null where there is
  /// no window.
  std::function<void(std::optional<bool>)> full_screen;
  /// What is printed on a key, as GLFW numbers and names it; null where that is not known. May be empty.
  std::function<const char*(int key)> key_name;
  /// Gives the window another title; may be empty.
  std::function<void(const std::string&)> title;
  /// Whether the program is to end, such as by Ctrl-C: the window closes. May be empty.
  std::function<bool()> interrupted;
  /// Has the host woken when that is so, for as long as what it returns lives. May be empty.
  std::function<std::shared_ptr<void>(std::function<void()> wake)> watch_interrupts;
};

/// What the curve runs against.
enum class PlotAxis { kSeconds, kShots, kRows };

/// What the panels show and actions change, besides the session.
struct ViewerState {
  SolveOptions options;  ///< of the present or the next solve
  DisplaySettings settings;
  bool panel = true;
  bool panel_over = false;    ///< over the scene, where it has no room beside it
  bool status = true;         ///< with the panel: the line at the bottom of the scene
  bool clean = false;         ///< nothing but the scene, whatever else is on
  bool clean_legend = false;  ///< and then the legend of false colours
  bool help = false;
  bool notes = false;      ///< those on the scene, in full
  bool left_out = false;   ///< what the solve leaves out, in full
  bool materials = false;  ///< to be changed
  bool hint = false;       ///< what to do first
  /// Sections of the panel to be opened or closed (none: the other way) when it is built next.
  std::vector<std::pair<std::string, std::optional<bool>>> section_changes;
  Prompt prompt;
  std::vector<std::filesystem::path> recent;  ///< scenes, as of when the list was opened
  std::size_t material = 0;                   ///< the one chosen
  PlotAxis plot_axis = PlotAxis::kSeconds;
  double wipe = 0.5;                ///< where the reference picture begins: 0 left, 1 right
  bool picture_difference = false;  ///< the difference from the reference picture, instead
};

/// Shots and columns a second, over about the last second.
struct Rates {
  double shots = 0, columns = 0;
};

/// A time that does not come [s].
inline constexpr double kNever = std::numeric_limits<double>::infinity();

class Viewer {
 public:
  explicit Viewer(ViewerSetup setup);
  ~Viewer();
  Viewer(const Viewer&) = delete;
  Viewer& operator=(const Viewer&) = delete;

  // For hosts. Times are wallSeconds().

  /// Takes the session's newest state and runs what the script has next.
  void update(double now);
  /// When prepare() is wanted: at most `now` for at once, infinity for not before something happens.
  double nextFrame(double now) const;
  /// Goes on with the picture of the scene for a few milliseconds, unless the window waits for a frame.
  /// Returns whether draw() is to follow.
  bool prepare();
  /// When update() is wanted without an event.
  double nextUpdate() const;
  /// Builds the GUI from ImGui's IO (in whatever unit its framebuffer scale says) and draws the window's
  /// content into `framebuffer`. Returns false where that looks as it did before: then nothing was drawn, and
  /// what is on the screen stays there.
  bool draw(GLuint framebuffer, int width, int height);
  /// What draw() drew is on the screen.
  void presented();
  /// What was on the screen is lost: the next frame is drawn, however it looks.
  void damaged();
  /// Something was typed or moved: the next frames react.
  void input() { gui_frames_ = kFramesAfterInput; }
  /// A key of keyOfActions() went down that no text field wants.
  void key(int key, bool ctrl);
  /// Of the screen, for a GUI of the usual size: 1 is a font of 15 px.
  void setScreenScale(double scale);
  /// Not before the screenshots that were asked for are written, and what is to be saved is: the window shows
  /// how far that is, and it can be given up.
  bool closing() const { return ending() && (session_.closed() || !mayStillSave()); }
  /// Ends the session, once nothing more is to be shown: waits for one step at most, and for what is still to
  /// be saved. Only exitCode() may be called afterwards.
  void finish();
  /// finish() where the window cannot go on, such as after a reset of the driver: saves a solve that is not
  /// kept anyway. Returns the error with the way on.
  Error rescue(const Error& error);
  bool scriptDone() const { return script_at_ >= script_.size() && !waitsForFiles() && !pick_wanted_; }
  /// 0, or the exit code of the first thing that failed in the script, or of why there is no scene.
  int exitCode() const { return exit_code_; }

  // For actions and panels.

  /// Performs an action of the table; what fails is shown as a message.
  void perform(std::string_view action, const std::string& argument = {});
  ViewerState& ui() { return ui_; }
  const ViewerState& ui() const { return ui_; }
  const DisplaySettings& settings() const { return ui_.settings; }
  const SessionState& state() const { return *state_; }
  /// Whether it holds what was asked for so far.
  bool upToDate() const { return session_.sent() == state_->commands; }
  const gl::ContextInfo& renderer() const { return setup_.display->info(); }
  const std::vector<std::filesystem::path>& bundledScenes() const { return setup_.bundled; }
  const Camera& camera() const { return navigator_.camera(); }
  /// Of the scene as it is shown, which a slow renderer draws over several frames.
  const Camera& shownCamera() const { return scene_.shownCamera(); }
  const std::shared_ptr<const Snapshot>& shownSnapshot() const { return scene_.snapshot(); }
  /// Of what is shown in false colours, where the mouse is over the scene.
  const std::optional<double>& valueUnderMouse() const { return value_probe_.value(); }
  bool drawingScene() const { return scene_.drawing(); }
  /// With fewer pixels than its part of the window, as while the camera moves.
  bool coarseScene() const { return scene_.coarse(); }
  /// The letter on a key that goes by its place: `key` itself where none is known.
  char printedOn(char key) const;
  double scale() const { return scale_; }
  /// Size of the GUI; a screen of another scale changes it with itself.
  void setScale(double scale);
  Memory& memory() { return memory_; }
  /// Opens and closes the panel's sections as they were, and remembers how they are now.
  void followSections(ImGuiStorage& sections);
  double exposure() const { return scene_.exposure(); }
  const std::optional<LuminanceHistogram>& histogram() const { return scene_.histogram(); }
  Rates rates() const;
  double frameMilliseconds() const { return 1000 * frame_cost_; }

  /// Reads a scene and solves it, or goes on from a saved solve of the present scene.
  void open(const std::filesystem::path& scene);
  /// The present scene as its files are now; the camera stays.
  void reload();
  /// Whether they have changed since they were read, as far as they are watched.
  bool sceneChanged() const { return watch_.changed(); }
  /// Goes on with what was read.
  void keepScene();
  void watchScene(bool on);
  bool watchingScene() const { return watching_; }
  /// Gives up what is being loaded, if anything is: the scene before stays.
  void giveUpLoading();
  /// Solves again from the start with ui().options.
  void restart();
  /// The same with the form factors at hand.
  void shootAgain() { session_.shootAgain(); }
  void setMode(const std::string& key);
  void setError(double error);
  /// Changes materials; the solve goes on with them.
  void edit(const std::function<void(MaterialEdits&)>& change);
  Teaching& teaching() { return *teaching_; }
  const Teaching& teaching() const { return *teaching_; }
  const MaterialEdits& edits() const { return edits_; }
  /// When the mouse button that is held went down; none where none is.
  std::optional<double> gesture() const;
  /// Writes them as MTL. An empty path: a new name in the working folder.
  void saveMaterials(std::filesystem::path path);
  void pauseOrResume();
  void pause() { session_.pause(); }
  void resume() { session_.resume(); }
  /// Whether the solve runs or is paused: else there is nothing to pause or to step.
  bool solveGoesOn() const;
  /// Whether a step of what has ended begins it anew: where that is soon where it was.
  bool stepsFromNothing() const;
  /// Where the solve has ended nothing is shot, and a notice says so.
  void step(std::uint64_t shots);
  /// Shows the light of up to so many bounces, or of that bounce alone, working them out where that takes
  /// more form factors; none: all.
  void setBounces(std::optional<std::uint32_t> bounces, bool alone = false);
  void completeBounces() { session_.completeBounces(); }
  /// The present solve against another one in the mode `key`, both from nothing; no key: ends the race.
  void race(const std::optional<std::string>& key);
  /// What the display mode `difference` compares with: what is shown now; a solution in a file; direct light.
  void remember();
  void loadReference(const std::filesystem::path& file);
  void forget();
  /// A picture over that of the scene (reference_picture.h). Both are read beside the window.
  void loadReferencePicture(const std::filesystem::path& file);
  void giveUpReferencePicture();
  void forgetReferencePicture();
  /// A display mode whose edges or colours are still to be found.
  void giveUpDisplay();
  /// Null where there is none, or where the display mode shows nothing to compare with it.
  const ReferencePicture* referencePicture() const;
  /// Finds the automatic camera again.
  void frameScene();
  /// In the coordinates of the scene's file; projection and upwards stay.
  void setCamera(const glm::dvec3& eye, const glm::dvec3& at, std::optional<double> fov_deg);
  /// All of the scene along an axis.
  void viewAlong(const AxisView& view);
  /// In the coordinates of the scene's file; nothing without a scene.
  std::optional<Camera> cameraInFile() const;
  std::optional<Bounds> boundsInFile() const;
  /// To the clipboard: as lines of a script, or as options of unshot solve.
  void copyCamera(bool options);
  Navigator& navigator() { return navigator_; }
  void resizeWindow(int width, int height);
  void fillScreen(std::optional<bool> on);
  const Picking& picking() const { return picking_; }
  /// Picks in the next frame what is at this place in the picture of the present solve, in units of its width
  /// and height from left and top, [0, 1]; unpicks where there is nothing.
  void pick(const glm::dvec2& at);
  void unpick();
  void pinProbe() { picking_.pin(*state_); }
  void unpinProbe(std::size_t number) { picking_.unpin(number); }
  void clearProbes() { picking_.clearProbes(); }
  /// Writes the pinned probes as `unshot solve --probe-out` does. An empty path: a new name in the working
  /// folder.
  void saveProbes(std::filesystem::path path);
  /// What is picked, to the clipboard.
  void copyValues();
  /// Looks at what is picked, and orbits around it.
  void focusPicked();
  /// Of the picture that marks are drawn over.
  Camera markedCamera() const;
  /// Writes what the window shows, with its panels or without, beside what else it does. An empty path: a new
  /// name in the working folder.
  void screenshot(std::filesystem::path path, bool with_panels);
  /// Saves the present solve, which goes on, at its next pause between two steps. An empty path: a new name
  /// in the working folder.
  void saveSolve(std::filesystem::path path);
  /// A line that stays until it was read; one for a moment, which only echoes a key or a button.
  void notice(std::string text);
  void passingNotice(std::string text);
  void showError(const Error& error, bool of_solve = false);
  const std::optional<Error>& error() const { return notice_.error(); }
  const Messages& messages() const { return notice_; }
  void noteMessagesRead() { notice_.readAll(); }
  void dismissNotices();
  /// A list of all actions, or of a folder's files (none: where the last one was), with a text to begin with.
  void searchActions(const std::string& text);
  void browse(const std::filesystem::path& folder);
  /// What takes its time, of what is under way.
  std::vector<Task> tasks();
  void giveUp(const Task& task);
  /// Gives up one of them, from 0 on; whether there is one.
  bool giveUp(std::size_t number);
  /// The first that is shown.
  bool giveUpShown();
  /// Closes what lies over the scene: the message, else the help, else gives up a task that is shown, else
  /// notices, else what is picked.
  void dismiss();
  void close() { closing_ = true; }

 private:
  static constexpr int kFramesAfterInput = 3;  // ImGui needs a second frame to settle

  /// All that a frame looks by.
  struct PaintedLook {
    GLuint framebuffer;
    int width, height;
    std::uint64_t scene;  ///< SceneArea::version
    std::size_t gui;      ///< fingerprint
    bool operator==(const PaintedLook&) const = default;
  };
  /// A place in one of the pictures of the scene, in units of its size.
  struct PicturePlace {
    int width;  ///< of the picture [px]
    glm::dvec2 at;
  };
  /// What is remembered of the panel.
  struct PanelLook {
    double scale = 1;
    std::vector<bool> switches;
    std::vector<std::pair<ImGuiID, int>> sections;
    bool operator==(const PanelLook&) const = default;
  };
  struct RatePoint {
    double time;
    std::uint64_t shots, rows;
  };

  void takeState(double now);
  void noteRates(double now);
  void takeMaterials();
  void keepEdits();
  void noteSky();
  void noteDarkness();
  void resumeSaved(const std::filesystem::path& file);
  void noteResumed();
  void runScript(double now);
  void runScriptLines(double now);
  bool waitIsOver(const ScriptLine& line, double now);
  bool settled() const;
  void followTeaching();
  void forgetOldLight();
  void fail(const Error& error, bool of_solve = false);
  void navigate(double seconds);
  void zoomAtMouse(double notches);
  void placeCamera(const Camera& camera);
  double pictureAspect() const;
  const Mesh& requiredMesh() const;
  std::optional<PicturePlace> placeUnder(const glm::dvec2& mouse) const;
  void pickClicked();
  void lookUnderMouse();
  void pickAt(const Camera& camera, int width, const glm::dvec2& at);
  bool mayBeSharpened(double now) const;
  double nextPaint() const;
  double nextSceneWork() const;
  double nextSnapshot() const;
  bool hasNewSnapshot() const;
  bool snapshotRefused() const { return refused_snapshot_ && state_->snapshot == refused_snapshot_; }
  void takeSnapshot(double now);
  bool sceneStands() const;
  SceneDisplay::Wanted wanted() const;
  std::shared_ptr<const Snapshot> rivalSnapshot() const;
  bool frame();
  void wantFrame(bool from_memory);
  /// Whether a camera is looked for, or will be once there is light to judge it by.
  bool looksForView() const {
    return scene_.framing() || (frame_wanted_ && state_->snapshot && !snapshotRefused());
  }
  void followFrame(const SessionState& before);
  void applyScale();
  void followShape(int width, int height, double now);
  void fitToShape(double now);
  bool recallCamera();
  void rememberCamera(const SessionState& state);
  double nextCameraKept() const;
  double nextKeeping() const;
  void keepWhatRests(double now);
  void followHint(double now);
  void endHint();
  void recallPanel();
  void rememberPanel();
  PanelLook panelLook() const;
  ReferencePicture::Look referenceLook() const;
  double nextMeasure() const;
  void measureReference(double now);
  void noteMotion();
  void followRest(double now);
  void followLoads();
  void sendReferencePicture(double deadline);
  /// Whether some are read or written that were asked for.
  bool waitsForFiles() const {
    return !screenshots_.empty() || reference_load_.underWay() || picture_load_.underWay() || coming_picture_;
  }
  bool drawScene(double now, double deadline);
  bool waitsForPicture(double now) const;
  void paint(GLuint framebuffer, int width, int height);
  void followScreenshots(double now);
  bool screenshotStands() const;
  void keepScreenshot(int width, int height);
  void drawScreenshot(double deadline);
  void failScreenshot(const Error& error);
  void noteSaved(const SessionState& before);
  bool ending() const { return closing_ && screenshots_.empty(); }
  bool mayStillSave() const { return state_->saving || !setup_.session.kept.path.empty() || !upToDate(); }
  std::filesystem::path newFileName(const std::string& ending,
                                    const std::filesystem::path& folder = {}) const;
  std::filesystem::path rescueName(const std::string& ending) const;

  ViewerSetup setup_;
  struct GuiContext {
    GuiContext();
    ~GuiContext();
  } gui_context_;
  GuiRenderer gui_;
  SceneArea scene_;
  Navigator navigator_;
  Screenshots screenshots_;
  Session session_;
  std::shared_ptr<const SessionState> state_;
  ViewerState ui_;
  MaterialEdits edits_;
  bool edited_by_hand_ = false;               // not by the script alone
  std::optional<std::uint64_t> opening_ = 0;  // another scene than edits_ are of: the epoch before it
  double scale_ = 0, screen_scale_ = 1, relative_scale_ = 1;

  SceneWatch watch_;
  bool watching_ = false;

  Memory memory_;
  std::optional<Camera> found_camera_;            // the automatic one, which need not be remembered
  std::optional<Camera> kept_camera_;             // of those that were written, the last
  bool camera_from_memory_ = true;                // where there is one, for the scene that is framed next
  double window_aspect_ = 0, framed_aspect_ = 0;  // now, and when found_camera_ was looked for
  double shape_rests_at_ = kNever;                // when a window of another shape is taken as it is
  bool sections_restored_ = false;
  double hint_until_ = 0;  // 0: the scene is not there yet
  std::vector<std::pair<ImGuiID, int>> sections_;
  PanelLook panel_seen_;
  double panel_changed_at_ = kNever;  // from what is written

  // Frames.
  int gui_frames_ = kFramesAfterInput;
  double last_frame_ = 0, last_frame_end_ = 0, last_motion_ = 0;
  double last_picture_ = 0;                      // when a picture of the scene was shown
  double last_scene_ = 0, last_scene_work_ = 0;  // begin and end of the last work on the scene
  int scene_width_ = 0, scene_height_ = 0;       // [px]
  double frame_cost_ = 0;                        // of a picture of the scene and the frame that shows it [s]
  PictureCosts costs_;                           // of the last ones
  double fine_cost_ = 0;                         // of the last one with all its pixels
  double picture_cost_ = 0;                      // of the one being drawn, so far
  std::uint64_t changes_sent_ = 0;               // Session::sent() after the last action that sent anything
  bool coarse_ = false;                          // pictures are, while the camera moves
  bool close_popups_ = false;                    // Esc closes the list that is open
  Camera seen_camera_;                           // that of the last frame
  std::optional<PaintedLook> painted_;
  Camera painted_camera_;                  // of the picture of the scene in it
  std::optional<double> unpainted_since_;  // what has changed since then waits for the next picture
  bool drew_scene_ = false;                // since the last frame
  bool copies_rehearsed_ = false;

  Picking picking_;
  ValueProbe value_probe_;
  std::optional<glm::dvec2> pick_wanted_;
  /// What the wheel goes to, as long as only the wheel moves.
  struct ZoomTarget {
    glm::dvec2 mouse;
    Camera camera;
    glm::dvec3 point;
  };
  std::optional<ZoomTarget> zoom_target_;
  std::shared_ptr<ReferencePicture> reference_picture_, coming_picture_;  // shown, and on its way there
  FileLoad<ReferencePicture::Content> picture_load_;
  FileLoad<std::shared_ptr<const ReferenceLight>> reference_load_;
  double last_measured_ = 0;  // reference_picture_
  std::unique_ptr<Teaching> teaching_;

  // The scene shown.
  std::filesystem::path framed_scene_;  // the camera is for this one
  bool frame_wanted_ = true;
  double view_wanted_at_ = 0;                         // when that began, until the camera is found
  std::shared_ptr<const Snapshot> refused_snapshot_;  // one that the driver has no room for
  std::deque<RatePoint> rate_points_;

  // Messages.
  Messages notice_;
  std::uint64_t problems_seen_ = 0;

  // Script.
  std::vector<ScriptLine> script_;
  std::size_t script_at_ = 0;
  std::optional<Session::Hold> hold_;  // while lines of the script run, and before the first
  double wait_began_ = -1;
  int exit_code_ = 0;
  bool closing_ = false;
};

}  // namespace unshot
