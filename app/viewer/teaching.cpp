#include "viewer/teaching.h"

#include <algorithm>
#include <array>

#include "base/clock.h"

namespace unshot {
namespace {

constexpr double kLookSeconds = 0.25;     // between two looks, or two paintings, while the solve runs
constexpr std::size_t kOutlines = 8;      // kept
constexpr std::size_t kMostLit = 30'000;  // triangles that are filled; a place of more is framed alone

/// The edges around display triangles that `inside` has, each run along once.
template <class Inside>
std::vector<std::pair<glm::vec3, glm::vec3>> outlineAround(const Mesh& mesh, Inside&& inside) {
  std::vector<std::pair<std::uint32_t, std::uint32_t>> edges;
  for (std::uint32_t t = 0; t < mesh.triangle_element.size(); ++t) {
    if (!inside(mesh.element_patch[mesh.triangle_element[t]])) continue;
    for (std::uint32_t k = 0; k < 3; ++k)
      edges.push_back(
          std::minmax(mesh.triangle_vertices[3 * t + k], mesh.triangle_vertices[3 * t + (k + 1) % 3]));
  }
  std::sort(edges.begin(), edges.end());
  std::vector<std::pair<glm::vec3, glm::vec3>> out;
  for (std::size_t i = 0, end; i < edges.size(); i = end) {
    for (end = i + 1; end < edges.size() && edges[end] == edges[i];) ++end;
    if (end > i + 1) continue;
    out.emplace_back(mesh.vertices[edges[i].first].position, mesh.vertices[edges[i].second].position);
  }
  return out;
}

/// The corners of these display triangles; none where they are too many to be drawn in each frame.
template <class Inside>
std::vector<glm::vec3> trianglesIn(const Mesh& mesh, Inside&& inside) {
  std::vector<glm::vec3> out;
  for (std::uint32_t t = 0; t < mesh.triangle_element.size(); ++t) {
    if (!inside(mesh.element_patch[mesh.triangle_element[t]])) continue;
    for (std::uint32_t k = 0; k < 3; ++k)
      out.push_back(mesh.vertices[mesh.triangle_vertices[3 * t + k]].position);
    if (out.size() > 3 * kMostLit) return {};
  }
  return out;
}

}  // namespace

std::span<const LecturePageRow> lecturePages() {
  static constexpr std::array<LecturePageRow, 4> table = {{
      {{"matrix", "Matrix", "M = R G gathered to groups of patches, its powers and partial sums"},
       LecturePage::kMatrix},
      {{"equation", "Equation", "B_i = E_i + R_i \u2211 G_ij B_j with the numbers of the picked patch"},
       LecturePage::kEquation},
      {{"shots", "Shots", "one shot after the other: what it sends where"}, LecturePage::kShots},
      {{"effects", "Effects", "what radiosity shows, and what it does not"}, LecturePage::kEffects},
  }};
  return table;
}

Teaching::Teaching(gl::Context& context, std::function<void()> wake)
    : context_(context), looks_(std::move(wake)), crosses_{gl::Texture(context), gl::Texture(context)} {}

InsightWanted Teaching::wanted(std::string_view display) const {
  const bool shots = choices.lecture && choices.page == LecturePage::kShots;
  const bool equation = choices.lecture && choices.page == LecturePage::kEquation;
  const bool hemicube = choices.hemicube || shots;
  InsightWanted out;
  if ((hemicube || equation || display == "form-factors") && picked_ != kNone) {
    out.cut = snapshot_->mesh->cut;
    out.patch = picked_;
  }
  out.next = !out.patch && hemicube;
  out.matrix = choices.lecture && choices.page == LecturePage::kMatrix;
  return out;
}

bool Teaching::follow(Session& session, const SessionState& state, std::uint32_t picked,
                      std::string_view display) {
  bool news = insight_ != state.insight;
  insight_ = state.insight;
  running_ = state.phase == SessionPhase::kRunning;
  snapshot_ = state.snapshot;
  picked_ = snapshot_ ? picked : kNone;
  stands_on_ = kNone;
  if (!snapshot_) return news;
  const bool hemicube = choices.hemicube || (choices.lecture && choices.page == LecturePage::kShots);
  const bool in_use =
      choices.hemicube || choices.lecture || display == "form-factors" || display == "last-shot";
  const InsightWanted now = wanted(display);
  if (asked_ ? now != sent_ : in_use) {
    session.lookInto(now);
    sent_ = now;
    asked_ = true;
  }
  if (!hemicube) return news;
  const Insight* known = insight();
  const bool stepped = !running_ && known && known->shot && known->shot->patch != kNone;
  const bool told = stepped && choices.lecture && choices.page == LecturePage::kShots;
  if (picked_ != kNone && !told) {
    stands_on_ = picked_;
  } else if (known) {
    stands_on_ = stepped ? known->shot->patch : known->next;
  }
  if (stands_on_ != kNone && stands_on_ < snapshot_->mesh->patch_count) lookFrom(stands_on_, running_);
  if (const auto latest = looks_.latest(); latest != look_) {
    look_ = latest;
    shares_ = look_ ? look_->shares() : std::vector<double>();
    news = true;
  }
  return news;
}

void Teaching::lookFrom(std::uint32_t patch, bool running) {
  const std::pair<std::uint64_t, std::uint32_t> place{snapshot_->mesh->cut, patch};
  behind_ = place != looked_at_;
  if (!behind_) return;
  const double now = wallSeconds();
  if (running && now < last_look_ + kLookSeconds) {
    if (look_ && look_->mesh->cut == place.first) stands_on_ = looked_at_.second;
    return;
  }
  looks_.want(snapshot_->mesh, patch);
  looked_at_ = place;
  last_look_ = now;
  behind_ = false;
}

void Teaching::giveUpLooking() {
  choices.hemicube = false;
  if (choices.page == LecturePage::kShots) choices.lecture = false;
  looks_.giveUp();
  looked_at_ = {0, kNone};  // to be looked at again where it is opened again
}

bool Teaching::settled() const { return !looks_.pending() && !behind_; }

const Insight* Teaching::insight() const {
  if (!insight_ || !snapshot_) return nullptr;
  const auto fits = [this](const auto& part) { return !part || part->cut == snapshot_->mesh->cut; };
  return fits(insight_->patch) && fits(insight_->shot) && fits(insight_->matrix) ? insight_.get() : nullptr;
}

const gl::Texture* Teaching::cross() {
  if (!look() || !snapshot_ || look_->mesh->cut != snapshot_->mesh->cut) return nullptr;
  const bool lit =
      choices.picture == HemicubeColours::kLight || choices.picture == HemicubeColours::kMaterials;
  const Painted wanted{look_, lit ? snapshot_ : nullptr, choices.picture};
  const double now = wallSeconds();
  const bool same_place = painted_.look == wanted.look && painted_.colours == wanted.colours;
  if (painted_ == wanted || (running_ && same_place && now < last_painted_ + kLookSeconds))
    return &crosses_[cross_];
  const std::vector<std::uint8_t> pixels = paintCross(*look_, choices.picture, *snapshot_);
  cross_ = 1 - cross_;
  const gl::Functions& fn = context_.functions();
  const auto size = static_cast<GLsizei>(crossSize(look_->layout));
  fn.BindTexture(GL_TEXTURE_2D, crosses_[cross_].id());
  fn.TexImage2D(GL_TEXTURE_2D, 0, GL_RGBA8, size, size, 0, GL_RGBA, GL_UNSIGNED_BYTE, pixels.data());
  fn.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_LINEAR);
  fn.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_NEAREST);
  fn.BindTexture(GL_TEXTURE_2D, 0);
  painted_ = wanted;
  last_painted_ = now;
  return &crosses_[cross_];
}

double Teaching::reflectance(std::size_t i) const {
  const double own = insight()->matrix->groups[i].reflectance[choices.channel];
  if (!choices.allow_divergence) return own;
  return choices.alike ? choices.reflectance : choices.factor * own;
}

double Teaching::transport(std::size_t i, std::size_t j) const {
  const GatheredMatrix& m = *insight()->matrix;
  if (!choices.allow_divergence) return m.at(i, j)[choices.channel];
  return choices.alike ? choices.reflectance * m.factor(i, j) : choices.factor * m.at(i, j)[choices.channel];
}

MatrixSeries& Teaching::series() {
  const GatheredMatrix& m = *insight()->matrix;
  SeriesOf of{insight()->matrix, choices.channel, 1, {}};
  if (choices.allow_divergence && choices.alike) of.reflectance = choices.reflectance;
  if (choices.allow_divergence && !choices.alike) of.factor = choices.factor;
  if (of == series_of_) return series_;
  std::vector<double> matrix;
  matrix.reserve(m.size() * m.size());
  for (std::size_t i = 0; i < m.size(); ++i) {
    for (std::size_t j = 0; j < m.size(); ++j) matrix.push_back(transport(i, j));
  }
  series_ = MatrixSeries(std::move(matrix), m.size());
  series_of_ = of;
  return series_;
}

std::vector<double> Teaching::emission() const {
  std::vector<double> out;
  for (const GatheredMatrix::Group& group : insight()->matrix->groups)
    out.push_back(group.emission[choices.channel]);
  return out;
}

std::vector<double> Teaching::solution() const {
  std::vector<double> out;
  for (const glm::dvec3& b : insight()->group_radiosity) out.push_back(b[choices.channel]);
  return out;
}

template <class Of>
void Teaching::mark(std::uint64_t key, bool source, bool lit, Of&& of) {
  const Mesh& mesh = *snapshot_->mesh;
  key = 4 * key + (source ? 1 : 0) + (lit ? 2 : 0);
  const auto same = [&](const Outline& o) { return o.cut == mesh.cut && o.key == key; };
  auto at = std::find_if(outlines_.begin(), outlines_.end(), same);
  if (at == outlines_.end()) {
    if (outlines_.size() >= kOutlines) outlines_.erase(outlines_.begin());
    auto made = std::make_shared<Mark>();
    made->outline = outlineAround(mesh, of);
    if (lit) made->lit = trianglesIn(mesh, of);
    made->source = source;
    outlines_.push_back({mesh.cut, key, std::move(made)});
    at = outlines_.end() - 1;
  }
  wanted_marks_.push_back(at->mark);
}

void Teaching::markPatch(std::uint32_t patch, bool source, bool lit) {
  mark(2 * std::uint64_t{patch}, source, lit, [patch](std::uint32_t q) { return q == patch; });
}

void Teaching::markGroup(std::uint32_t group, bool source) {
  const std::vector<std::uint32_t>& of = insight()->matrix->group;
  mark(2 * std::uint64_t{group} + 1, source, true, [&](std::uint32_t q) { return of[q] == group; });
}

}  // namespace unshot
