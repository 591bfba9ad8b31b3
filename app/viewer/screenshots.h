// Screenshots: what the window shows when they are asked for, drawn once more without hurry between the
// window's own frames, and written on a thread.
//
// One at a time. First the window draws its own picture of what is wanted, so that scene and panels are of
// the same moment (posing). The panels are then kept as they are, and the scene is drawn again, finer, while
// the window goes on as it likes (drawing). At last both are put together and written (writing).
#pragma once

#include <cstdint>
#include <deque>
#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <vector>

#include "viewer/background.h"
#include "viewer/gui_renderer.h"
#include "viewer/reference_picture.h"
#include "viewer/scene_area.h"

namespace unshot {

/// All calls on the thread where the context is current.
class Screenshots {
 public:
  /// `wake`: has Viewer::update called once a file is written.
  Screenshots(gl::Context& context, GuiRenderer& gui, std::function<void()> wake)
      : context_(context), gui_(gui), wake_(std::move(wake)) {}

  void ask(std::filesystem::path path, bool with_panels) { asked_.push_back({std::move(path), with_panels}); }
  bool empty() const { return asked_.empty(); }
  /// Whether one of them is to become this file.
  bool promised(const std::filesystem::path& path) const;

  // The first of them.

  /// What the scene is seen with.
  struct Subject {
    Camera camera;
    DisplaySettings settings;
  };
  bool toBegin() const { return !asked_.empty() && !shot_; }
  /// From now on the window is to show this, with its newest light, until keep().
  void begin(Subject subject, double now);
  bool posing() const { return shot_ && shot_->stage == Stage::kPosing; }
  /// While it poses.
  const Subject& subject() const { return shot_->subject; }
  /// Whether the window has taken the light that the picture is to show.
  bool lit() const { return shot_->lit; }
  void setLit() { shot_->lit = true; }
  /// ImGui shows a new window one frame late.
  void noteFrame();
  bool panelsStand() const { return shot_->frames_left == 0; }

  struct Layout {
    int width = 0, height = 0, scene_width = 0;  ///< [px]
  };
  /// A picture that is laid over that of the scene, or none.
  struct Over {
    std::shared_ptr<ReferencePicture> picture;
    ReferencePicture::Look look;
  };
  /// Takes the panels as they are; the scene is to be drawn from now on (SceneArea::beginFiner). Throws Error
  /// (kEnvironment).
  void keep(const Layout& layout, const ImDrawData& panels, Over over);
  bool drawing() const { return shot_ && shot_->stage == Stage::kDrawing; }
  /// Takes the scene, which is whole, and begins to write. Throws Error (kEnvironment).
  void write(const SceneArea& scene);

  /// The file that was written, once; none where that still takes a while. Throws Error where it could not
  /// be written, and Cancelled; either way it is the next one's turn.
  std::optional<std::filesystem::path> written();
  /// It leaves no file, unless that is there already.
  void giveUp();
  /// All that are not being written.
  void drop();

  const std::filesystem::path& path() const { return asked_.front().path; }
  /// Since when it is being made (infinite: from now on); none where it is not, or is given up.
  std::optional<double> began() const;
  double done(const SceneArea& scene) const;

 private:
  enum class Stage { kPosing, kDrawing, kWriting };
  struct Asked {
    std::filesystem::path path;
    bool with_panels = true;
  };
  struct Shot {
    Subject subject;
    double began = 0;
    Stage stage = Stage::kPosing;
    int frames_left = 0;
    bool lit = false;
    Layout layout;
    std::vector<std::uint8_t> panels;  // RGBA, light times coverage, lowest row first; empty: without
    Over over;
    std::unique_ptr<Background<bool>> writing;
  };
  void next();

  gl::Context& context_;
  GuiRenderer& gui_;
  std::function<void()> wake_;
  std::deque<Asked> asked_;
  std::unique_ptr<Shot> shot_;  // of the first of asked_
};

}  // namespace unshot
