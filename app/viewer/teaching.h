// What the viewer shows for a lecture: the hemicube of a patch, the matrix gathered to groups, the equation
// with a patch's numbers, and single shots. Keeps what it takes, and asks the session for it.
#pragma once

#include <cstdint>
#include <functional>
#include <glm/vec2.hpp>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "gl/objects.h"
#include "session/insight.h"
#include "session/session.h"
#include "viewer/hemicube_cross.h"
#include "viewer/hemicube_looks.h"
#include "viewer/matrix_series.h"

namespace unshot {

enum class LecturePage { kMatrix, kEquation, kShots, kEffects };

struct LecturePageRow {
  ChoiceInfo info;
  LecturePage page;
};
std::span<const LecturePageRow> lecturePages();

/// What actions change.
struct TeachingChoices {
  bool hemicube = false;
  HemicubeColours picture = HemicubeColours::kLight;
  bool lecture = false;
  LecturePage page = LecturePage::kMatrix;
  std::size_t power = 2;  ///< k of M^k and I + ... + M^k
  bool sums = false;      ///< the partial sum instead of the power
  int channel = 1;        ///< 0 red, 1 green, 2 blue
  /// Whether the reflectance of the matrix may be changed, to 1 and above: each group's own times a factor,
  /// or one for all.
  bool allow_divergence = false;
  bool alike = false;
  double factor = 1, reflectance = 1;
  /// What is marked besides what the mouse is over: row and column of the matrix, from 0 on; a place in the
  /// cross of the hemicube, from 0,0 (left, top) to 1,1.
  std::optional<std::pair<std::size_t, std::size_t>> cell;
  std::optional<glm::dvec2> pixel;
};

/// All calls on the main thread, with the context current.
class Teaching {
 public:
  /// `wake` as SessionSetup has it.
  Teaching(gl::Context& context, std::function<void()> wake);

  TeachingChoices choices;

  /// What stands where in the scene, of one kind.
  struct Mark {
    std::vector<std::pair<glm::vec3, glm::vec3>> outline;
    std::vector<glm::vec3> lit;  ///< corners of its triangles, three each; none where it is only framed
    bool source = false;         ///< sends light, rather than receives it
  };

  /// Takes what is new and asks for what is wanted now, by what the actions have chosen, the display mode and
  /// the picked patch (kNone: none is). Returns whether there is something new to show.
  bool follow(Session& session, const SessionState& state, std::uint32_t picked, std::string_view display);
  /// Whether nothing is on its way that was asked for.
  bool settled() const;

  /// The insight, where it is of the present mesh; null else.
  const Insight* insight() const;
  const PatchInsight* patch() const { return insight() ? insight()->patch.get() : nullptr; }
  /// The patch that the hemicube stands on; kNone: there is none. Whether it was picked.
  std::uint32_t hemicubePatch() const { return stands_on_; }
  bool hemicubeIsPicked() const { return picked_ != kNone && stands_on_ == picked_; }
  /// The newest look from it; null where there is none yet.
  const HemicubeLook* look() const { return look_ && look_->patch == stands_on_ ? look_.get() : nullptr; }
  const std::vector<double>& shares() const { return shares_; }  ///< of look()
  std::optional<Error> problem() const { return looks_.problem(); }
  /// HemicubeLooks::preparing.
  std::optional<double> preparing() const { return looks_.preparing(); }
  /// Closes the hemicube, and the lecture where that needs it.
  void giveUpLooking();
  /// The cross as a texture, as chosen; null before the first look.
  const gl::Texture* cross();

  /// R_i of a group and R_i G_ij of two, in the channel and with the reflectance that are chosen.
  double reflectance(std::size_t i) const;
  double transport(std::size_t i, std::size_t j) const;
  /// Of the matrix of these; made once.
  MatrixSeries& series();
  /// Its right side E and, where the reflectance is the groups' own, the solve's B: one a group.
  std::vector<double> emission() const;
  std::vector<double> solution() const;

  /// Patches to be marked in the next frame; what was asked for in the frame before is forgotten.
  void beginMarks() { marked_ = std::exchange(wanted_marks_, {}); }
  /// `lit`: filled as well as framed.
  void markPatch(std::uint32_t patch, bool source, bool lit);
  /// Lit.
  void markGroup(std::uint32_t group, bool source);
  const std::vector<std::shared_ptr<const Mark>>& marks() const { return marked_; }

 private:
  InsightWanted wanted(std::string_view display) const;
  void lookFrom(std::uint32_t patch, bool running);
  template <class Of>
  void mark(std::uint64_t key, bool source, bool lit, Of&& of);

  gl::Context& context_;
  HemicubeLooks looks_;
  std::shared_ptr<const Snapshot> snapshot_;
  std::shared_ptr<const Insight> insight_;
  InsightWanted sent_;
  bool asked_ = false;  // for anything, so far
  std::uint32_t picked_ = kNone, stands_on_ = kNone;
  bool behind_ = false;  // a look is due that was put off

  // The hemicube.
  std::pair<std::uint64_t, std::uint32_t> looked_at_{0, kNone};  // cut and patch asked for last
  double last_look_ = 0;
  std::shared_ptr<const HemicubeLook> look_;
  std::vector<double> shares_;
  struct Painted {
    std::shared_ptr<const HemicubeLook> look;
    std::shared_ptr<const Snapshot> snapshot;
    HemicubeColours colours = HemicubeColours::kLight;
    bool operator==(const Painted&) const = default;
  } painted_;
  double last_painted_ = 0;
  gl::Texture crosses_[2];  // in turns, so that a frame with another one looks different
  int cross_ = 0;
  bool running_ = false;

  // The matrix.
  struct SeriesOf {
    std::shared_ptr<const GatheredMatrix> matrix;
    int channel = -1;
    double factor = 1;
    std::optional<double> reflectance;
    bool operator==(const SeriesOf&) const = default;
  } series_of_;
  MatrixSeries series_;

  struct Outline {
    std::uint64_t cut = 0, key = 0;
    std::shared_ptr<const Mark> mark;
  };
  std::vector<Outline> outlines_;  // of late
  std::vector<std::shared_ptr<const Mark>> marked_, wanted_marks_;
};

}  // namespace unshot
