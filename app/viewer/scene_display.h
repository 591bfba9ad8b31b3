// The picture of the scene in the viewer: the newest snapshot from the camera, drawn again only when
// something has changed, with an exposure that glides; and the search for a first camera, a little in each
// frame.
//
// Where this takes longer than a window may be held up, it goes on in slices: the snapshot's upload,
// triangles, then rows of pixels, until the picture is whole. The one before is shown meanwhile. A camera
// that moves may have coarse pictures, which come sooner.
#pragma once

#include <cstdint>
#include <limits>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "render/automatic_camera.h"
#include "render/display_modes.h"
#include "render/histogram.h"
#include "render/scene_view.h"
#include "session/snapshot.h"
#include "viewer/background.h"
#include "viewer/pace.h"

namespace unshot {

/// What the picture is made with, besides snapshot and camera.
struct DisplaySettings {
  /// Display mode, exposure_ev, ambient, light, reference and, where it is given, automatic_exposure; the
  /// rest is chosen here.
  ViewOptions view;
  bool exposure_locked = false;  ///< keeps the present exposure, of what is shown then, whatever comes
  bool histogram = false;        ///< SceneDisplay::histogram() is wanted
};

/// All calls on the thread where the context is current.
class SceneDisplay {
 public:
  /// `wake` (may be empty) is called, on any thread, once draw() can go on that has waited for marks of the
  /// mesh.
  explicit SceneDisplay(gl::Context& context, std::function<void()> wake = nullptr);

  /// From now on pictures are of this one, which draw() uploads first. Null: nothing to show.
  void setSnapshot(std::shared_ptr<const Snapshot> snapshot);
  const std::shared_ptr<const Snapshot>& snapshot() const { return snapshot_; }
  bool empty() const { return !snapshot_; }

  /// Starts looking for a good camera for the present snapshot.
  void startFraming(double aspect);
  bool framing() const { return framing_.has_value(); }
  /// How much of it is done, from 0 to 1.
  double framingDone() const { return framing_ ? framing_->done() : 1; }
  /// The next continueFraming() returns the best of what was found so far.
  void hurryFraming() { framing_hurries_ = true; }
  /// Works on it for about `seconds`, or to its end (no value). Returns the camera once it is found.
  std::optional<Camera> continueFraming(std::optional<double> seconds);

  /// What a picture is of.
  struct Wanted {
    Camera camera;
    DisplaySettings settings;
    int width = 0, height = 0;  ///< [px]
    int samples = 1;            ///< along a pixel's side
    /// Pixels along the side of one that is drawn; a finer picture does too. Above 1, cells of large meshes
    /// are drawn several as one (render/merged_triangles.h), once it is known which.
    int divisor = 1;
  };
  /// Draws at once, however long it takes.
  static constexpr double kAtOnce = std::numeric_limits<double>::infinity();

  /// Works on the picture until wallSeconds() is about `deadline`; kAtOnce: to its end, from the beginning.
  /// One that was begun is finished first, as it was wanted then. `seconds` since the last call are for the
  /// glide of the exposure (negative: no glide). Returns whether there was anything to do.
  bool draw(const Wanted& wanted, double seconds, double deadline);
  /// Whether draw() would have something to do, not counting a glide of the exposure.
  bool outdated(const Wanted& wanted) const;
  /// Whether it waits for what shows the mesh itself (mesh_marks.h), which is found beside the window where
  /// the mesh is large. The display before stays meanwhile, and follows the camera.
  bool waits(const Wanted& wanted) const;
  /// Since when [wallSeconds()] something is waited for; none where nothing is.
  std::optional<double> waitingSince() const;
  /// No longer waits for it. It is looked for again when a picture is wanted that shows it.
  void giveUpWaiting() { marks_.reset(); }
  /// Key of the display mode of the picture shown; empty before the first.
  const std::string& shownDisplay() const { return shown_display_; }
  /// Whether a picture, or the upload for it, was begun and the picture is not yet shown.
  bool drawing() const { return making_ || view_.uploadBytes() > 0; }
  /// Whether the picture shown was drawn for itself, not only exposed anew.
  bool drawnAnew() const { return drawn_anew_; }
  /// Whether it has fewer pixels than its place in the window.
  bool coarse() const { return shown_.width != shown_.place_width; }
  /// The camera of the picture that is shown; that of the viewer may be ahead.
  const Camera& shownCamera() const { return shown_camera_; }
  /// Once the picture is up to date: draws it again in bands, with `samples` along a pixel's side, so that a
  /// software renderer smooths edges without holding the window up. To the end of a band or to `deadline`.
  void sharpen(int samples, double deadline);
  /// Whether nothing is left to sharpen.
  bool sharp() const { return !drawn_ || drawing() || coarse() || bands_.next >= kBands; }

  // The picture that is shown once more, finer, for a file. It stays of the camera and with the exposure of
  // the moment when it was begun, whatever is drawn meanwhile. Until it is whole or ended no other snapshot
  // may be set.

  /// `samples` along a pixel's side. Where no picture is shown there is none to be drawn.
  void beginFiner(int samples);
  /// Works on it until about `deadline`. Returns whether it is whole.
  bool continueFiner(double deadline);
  /// How much of it is drawn, from 0 to 1.
  double finerDone() const;
  /// As copyTo(), of this one.
  void copyFinerTo(int x, int width) const;
  /// It is no longer wanted: if it is whole and looks as the one shown does, it takes the place of that.
  void endFiner();

  /// Another number whenever the picture shown has changed.
  std::uint64_t version() const { return version_; }
  /// Copies the picture, or as much of it as fits into `width` columns, to the bottom of the bound draw
  /// framebuffer, from column `x` on [px].
  void copyTo(int x, int width) const;
  /// Copies something of a few pixels to the lower left, as copyTo() copies fine and coarse pictures. With
  /// the first copy of either kind a software renderer makes the code for it, some 40 ms: not with the first
  /// picture, nor when the camera first moves.
  void rehearseCopies() const;

  /// Factor from linear values to about 1 for white, before exposure_ev.
  double exposure() const { return exposure_; }
  bool gliding() const { return gliding_; }
  /// Of the picture shown; none where it was not wanted of that one.
  const std::optional<LuminanceHistogram>& histogram() const { return histogram_; }
  /// The next picture takes its own exposure at once, where it is not locked.
  void snapExposure() { snap_ = true; }

 private:
  static constexpr int kBands = 8;

  // Shown, or about to be.
  struct Picture {
    gl::Texture texture;
    gl::Framebuffer framebuffer;
    int width = 0, height = 0;              // [px]
    int place_width = 0, place_height = 0;  // in the window
  };
  struct Making {
    Wanted wanted;
    std::size_t piece = 0;  // the first that is not drawn
    int row = 0;            // the first that is not exposed
  };

  /// A picture that is drawn band by band, from the lowest on.
  struct Bands {
    LinearTarget target;
    int count = kBands;
    int next = 0;           // the first that is not drawn
    std::size_t piece = 0;  // of it, the first that is not drawn
    Pace pace;
  };
  struct Finer {
    Wanted wanted;
    double exposure;
    Picture picture;
    Bands bands;
  };

  bool differs(const Wanted& wanted) const;
  bool marksStand(const Wanted& wanted);
  void seekMerged();
  std::optional<Wanted> meanwhile(const Wanted& wanted) const;
  bool sampled(const Wanted& wanted) const;
  void begin(const Wanted& wanted);
  double extended(double deadline);
  bool upload(double deadline);
  bool drawSamples(double deadline);
  void expose();
  const std::vector<glm::vec4>& smallCopy();
  bool showRows(double deadline);
  bool drawPieces(const LinearTarget& target, const Wanted& wanted, const FrameWindow& window,
                  std::size_t& piece, Pace& pace, double deadline);
  bool drawBand(Bands& bands, const Wanted& finer, double exposure, const Picture& into, double deadline);
  static void copyPicture(const gl::Functions& fn, const Picture& picture, int x, int most);
  void allocate(Picture& picture, const Wanted& wanted) const;
  double nextExposure(double metered, double seconds);

  /// Marks of the mesh that are being found.
  struct MarksSearch {
    std::uint64_t cut;    ///< Mesh::cut
    std::string display;  ///< key of the mode that shows them
    double began;
    std::unique_ptr<Background<MeshMarks>> job;
  };

  gl::Context& context_;
  std::function<void()> wake_;
  SceneView view_;
  std::shared_ptr<const Snapshot> snapshot_;
  std::optional<MarksSearch> marks_;
  std::uint64_t merged_cut_ = 0;  // of the mesh whose triangles were merged, or are being so
  std::unique_ptr<Background<MergedTriangles>> merging_;
  std::optional<CameraSearch> framing_;
  bool framing_hurries_ = false;
  Picture shown_, next_;
  std::optional<Making> making_;
  LinearTarget samples_;
  std::optional<Wanted> sampled_, drawn_;        // what samples_ and shown_ hold of the present snapshot
  std::optional<std::vector<glm::vec4>> small_;  // copy of samples_, where it was looked at
  std::optional<double> metered_;                // of samples_
  std::optional<LuminanceHistogram> histogram_;  // of the picture shown
  Camera shown_camera_;
  std::string shown_display_;
  bool drawn_anew_ = false;
  std::uint64_t version_ = 0;
  Pace bytes_, pieces_, rows_;
  Bands bands_;  // of the picture shown
  std::optional<Finer> finer_;
  double exposure_ = 1, glide_seconds_ = 0;
  bool gliding_ = false, snap_ = true;
  std::string exposed_display_;    // exposure_ is for this display
  bool exposed_for_part_ = false;  // and from a part of the light
  /// What has an exposure of its own.
  struct ExposedKind {
    Quantity quantity;
    bool false_colour, alone;  // alone: one bounce
    bool operator==(const ExposedKind&) const = default;
  };
  struct Locked {
    ExposedKind kind;
    double exposure;
  };
  std::optional<ExposedKind> exposed_kind_;  // exposure_ is for it
  std::optional<Locked> locked_;             // where it is locked: the one that is kept
};

}  // namespace unshot
