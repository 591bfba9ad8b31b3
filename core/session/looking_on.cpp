#include "session/looking_on.h"

#include <algorithm>
#include <glm/common.hpp>
#include <utility>

#include "base/clock.h"
#include "session/fields.h"
#include "session/solve_inside.h"
#include "solver/brightness.h"

namespace unshot {
namespace {

constexpr double kLookInterval = 0.25;  // between two looks while it runs [s]
constexpr std::size_t kSources = 8;

const glm::dvec3 kNothing(0.0);

double valueAt(const Column& column, std::uint32_t v) {
  if (column.receiver.empty()) {
    const std::uint32_t i = v - column.first;
    return v >= column.first && i < column.k.size() ? static_cast<double>(column.k[i]) : 0.0;
  }
  const auto at = std::lower_bound(column.receiver.begin(), column.receiver.end(), v);
  if (at == column.receiver.end() || *at != v) return 0;
  return static_cast<double>(column.k[static_cast<std::size_t>(at - column.receiver.begin())]);
}

/// `factor` times what arrives of the column, at the vertices.
std::shared_ptr<const VertexField> fieldOf(const Mesh& mesh, const Receivers& receivers, const Column& column,
                                           const glm::dvec3& factor) {
  std::vector<glm::dvec3> values(receivers.size(), kNothing);
  column.forEach([&](std::uint32_t v, double k) { values[v] = k * factor; });
  auto out = std::make_shared<VertexField>();
  out->cut = mesh.cut;
  out->values = makeField(mesh, receivers, values).vertices;
  return out;
}

}  // namespace

LookingOn::LookingOn(const Solve& solve)
    : mesh_(solve.mesh()),
      transport_(transportOf(solve)),
      state_(stateOf(solve)),
      measures_(solve.measures()),
      gatherer_(mesh_, transport_, state_) {}

void LookingOn::want(const InsightWanted& wanted) {
  wanted_ = wanted;
  if (wanted.cut != mesh_.cut || (wanted.patch && *wanted.patch >= mesh_.patch_count)) wanted_.patch.reset();
}

std::uint32_t LookingOn::nextPatch() const {
  return heaviest(mesh_.patch_count,
                  [&](std::uint32_t q) { return powerOf(state_.area()[q], state_.unshot()[q]); });
}

std::vector<glm::dvec3> LookingOn::radiosity() const {
  std::vector<glm::dvec3> out = state_.shot();
  for (std::size_t q = 0; q < out.size(); ++q) out[q] += state_.unshot()[q];
  return out;
}

void LookingOn::beforeStep() {
  shot_before_ = state_.shot();
  unshot_before_ = state_.unshot();
}

void LookingOn::afterStep() {
  const std::vector<glm::dvec3>& shot = state_.shot();
  auto out = std::make_shared<ShotInsight>();
  out->cut = mesh_.cut;
  out->shots = measures_.shots;
  for (std::uint32_t q = 0; q < mesh_.patch_count; ++q) {
    if (shot[q] == shot_before_[q]) continue;
    ++out->moved;
    out->patch = q;
  }
  const std::uint32_t q = out->patch;
  if (out->moved > 1) out->patch = kNone;
  const Column* column = out->moved == 1 ? transport_.kept(q) : nullptr;
  if (column) {
    const glm::dvec3 d = shot[q] - shot_before_[q];
    const Receivers& receivers = transport_.receivers();
    out->area = mesh_.patch_area[q];
    out->unshot_before = out->area * glm::abs(unshot_before_[q]);
    out->sent = out->area * d;
    out->escaped = column->escape * out->sent;
    out->defect = column->defect * out->sent;
    column->forEach([&](std::uint32_t v, double k) {
      for (std::uint32_t s = receivers.start[v]; s < receivers.start[v + 1]; ++s) {
        const PatchShare& share = receivers.shares[s];
        const glm::dvec3 arrives = share.area * k * d, rho = state_.reflectance()[share.patch];
        out->reflected += rho * arrives;
        out->absorbed += (1.0 - rho) * arrives;
      }
    });
    auto added = std::make_shared<VertexField>(*fieldOf(mesh_, receivers, *column, d));
    for (std::size_t v = 0; v < added->values.size(); ++v)
      added->values[v] *= glm::vec3(mesh_.sides[mesh_.vertices[v].side].reflectance);
    out->added = std::move(added);
  }
  shot_ = std::move(out);
}

bool LookingOn::hasWork() const { return wanted_.matrix && gatherer_.hasWork(); }

void LookingOn::findColumn(PatchInsight& out) {
  const Column* column = transport_.kept(out.patch);
  if (!column) return;
  const Receivers& receivers = transport_.receivers();
  std::vector<double> arrives(mesh_.patch_count, 0.0);
  column->forEach([&](std::uint32_t v, double k) {
    for (std::uint32_t s = receivers.start[v]; s < receivers.start[v + 1]; ++s)
      arrives[receivers.shares[s].patch] += receivers.shares[s].area * k;
  });
  for (const double a : arrives) out.sent.push_back(static_cast<float>(a / out.area));
  out.sent_over = fieldOf(mesh_, receivers, *column, glm::dvec3(1 / out.area));
  out.escape = column->escape;
  out.defect = column->defect;
  out.quality = column->quality;
}

void LookingOn::findRow(std::uint32_t patch) {
  row_.assign(transport_.patchCount(), 0.0f);
  missing_ = 0;
  for (std::uint32_t q = 0; q < row_.size(); ++q) {
    const Column* column = transport_.kept(q);
    if (!column) {
      if (state_.shot()[q] != kNothing || state_.unshot()[q] != kNothing) ++missing_;
      continue;
    }
    double sum = 0;
    for (const PatchShare& share : shares_) sum += share.area * valueAt(*column, share.receiver);
    row_[q] = static_cast<float>(sum / mesh_.patch_area[patch]);
  }
}

std::shared_ptr<const PatchInsight> LookingOn::lookAt(std::uint32_t patch) {
  const Found now{patch, transport_.computed(), transport_.replaced(), !transport_.closure().scale.empty()};
  if (found_.patch != patch) {
    shares_.clear();
    for (const PatchShare& share : transport_.receivers().shares) {
      if (share.patch == patch) shares_.push_back(share);
    }
  }
  if (found_ != now) {
    column_ = {};
    column_.cut = mesh_.cut;
    column_.patch = patch;
    column_.area = mesh_.patch_area[patch];
    findColumn(column_);
    findRow(patch);
    found_ = now;
  }
  auto out = std::make_shared<PatchInsight>(column_);
  const std::vector<glm::dvec3> b = radiosity();
  out->emission = state_.emission()[patch];
  out->reflectance = state_.reflectance()[patch];
  out->radiosity = b[patch];
  out->unshot = state_.unshot()[patch];
  for (const PatchShare& share : shares_) out->received += share.area * state_.irradiance()[share.receiver];
  out->received /= out->area;
  out->seen = row_;
  out->missing = missing_;
  for (std::uint32_t q = 0; q < row_.size(); ++q) {
    const auto factor = static_cast<double>(row_[q]);
    if (factor == 0) continue;
    out->row_sum += factor;
    out->gathered += factor * b[q];
    out->sources.push_back({q, factor, b[q]});
  }
  const auto weight = [](const PatchSource& s) {
    return s.factor * (s.radiosity.x + s.radiosity.y + s.radiosity.z);
  };
  const std::size_t shown = std::min(kSources, out->sources.size());
  std::partial_sort(out->sources.begin(), out->sources.begin() + static_cast<std::ptrdiff_t>(shown),
                    out->sources.end(), [&](const auto& a, const auto& c) { return weight(a) > weight(c); });
  out->sources.resize(shown);
  return out;
}

void LookingOn::refresh(bool at_once) {
  const double began = wallSeconds();
  if (!at_once && !pace_.due(began, kLookInterval)) return;
  auto out = std::make_shared<Insight>();
  out->next = nextPatch();
  out->shot = shot_;
  const std::uint32_t patch = wanted_.patch ? *wanted_.patch : wanted_.next ? out->next : kNone;
  if (patch != kNone) out->patch = lookAt(patch);
  if (wanted_.matrix && gatherer_.matrix()) {
    out->matrix = gatherer_.matrix();
    out->group_radiosity = gatherer_.gathered(radiosity());
  }
  shown_ = std::move(out);
  pace_.made(began, wallSeconds());
}

}  // namespace unshot
