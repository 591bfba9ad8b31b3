#include "session/gathered_matrix.h"

#include <algorithm>
#include <map>
#include <numeric>

#include "base/clock.h"
#include "formfactor/patch_groups.h"

namespace unshot {
namespace {

constexpr double kSliceSeconds = 0.004;
constexpr double kMostMissing = 0.1;  // of the lit area

std::size_t renumber(std::vector<std::uint32_t>& group) {
  std::map<std::uint32_t, std::uint32_t> numbers;
  for (std::uint32_t& g : group)
    g = numbers.try_emplace(g, static_cast<std::uint32_t>(numbers.size())).first->second;
  return numbers.size();
}

/// Groups of about so many patches each, emitters too.
std::vector<std::uint32_t> groupsOf(const Mesh& mesh, std::uint32_t patches) {
  const PatchGroups nodes(mesh, patches);
  std::vector<std::uint32_t> out(mesh.patch_count);
  // A patch that emits is a group by itself there.
  std::map<std::uint32_t, std::pair<std::uint32_t, std::uint32_t>> last_of_side;  // group, its patches
  for (std::uint32_t q = 0; q < mesh.patch_count; ++q) {
    out[q] = nodes.of(q);
    if (!mesh.emits(q)) continue;
    auto& [group, count] = last_of_side.try_emplace(mesh.patch_side[q], out[q], 0).first->second;
    if (count == patches) {
      group = out[q];
      count = 0;
    }
    out[q] = group;
    ++count;
  }
  return out;
}

/// The largest of the groups stay, the others are one for each key.
template <class Key>
void mergeSmallest(const Mesh& mesh, std::vector<std::uint32_t>& group, std::size_t stay, Key&& key) {
  const std::size_t count = renumber(group);
  std::vector<double> area(count, 0.0);
  for (std::uint32_t q = 0; q < mesh.patch_count; ++q) area[group[q]] += mesh.patch_area[q];
  std::vector<std::uint32_t> order(count);
  std::iota(order.begin(), order.end(), 0u);
  std::stable_sort(order.begin(), order.end(), [&](auto a, auto b) { return area[a] > area[b]; });
  std::vector<char> stays(count, 0);
  for (std::size_t k = 0; k < std::min(stay, count); ++k) stays[order[k]] = 1;
  std::map<std::uint32_t, std::uint32_t> merged;
  for (std::uint32_t q = 0; q < mesh.patch_count; ++q) {
    if (!stays[group[q]]) group[q] = merged.try_emplace(key(q), group[q]).first->second;
  }
}

}  // namespace

std::vector<std::uint32_t> patchGroups(const Mesh& mesh, std::size_t most) {
  std::vector<std::uint32_t> group;
  std::uint32_t patches = 1;
  do {
    group = groupsOf(mesh, patches);
    if (renumber(group) <= most) return group;
    patches *= 2;
  } while (patches / 2 < mesh.patch_count);
  mergeSmallest(mesh, group, most / 2, [&](std::uint32_t q) {
    return mesh.surfaces[mesh.sides[mesh.patch_side[q]].surface].material;
  });
  if (renumber(group) > most) {
    mergeSmallest(mesh, group, most - 1, [](std::uint32_t) { return 0u; });
    renumber(group);
  }
  return group;
}

double GatheredMatrix::rowSum(std::size_t i) const {
  double sum = 0;
  for (std::size_t j = 0; j < size(); ++j) sum += factor(i, j);
  return sum;
}

MatrixGatherer::MatrixGatherer(const Mesh& mesh, const Transport& transport, const RadiosityState& state)
    : mesh_(mesh), transport_(transport), state_(state) {}

MatrixGatherer::Columns MatrixGatherer::columns() const {
  return {transport_.keptColumns(), transport_.replaced(), !transport_.closure().scale.empty()};
}

/// Patches that hold light and send it, but whose columns are not at hand.
std::vector<std::uint32_t> MatrixGatherer::missing() const {
  std::vector<std::uint32_t> out;
  const glm::dvec3 none(0.0);
  for (std::uint32_t q = 0; q < state_.patchCount(); ++q) {
    const bool holds = state_.shot()[q] != none || state_.unshot()[q] != none;
    const bool sends = state_.emission()[q] != none || state_.reflectance()[q] != none;
    if (holds && sends && !transport_.isKept(q)) out.push_back(q);
  }
  return out;
}

bool MatrixGatherer::hasWork() const {
  if (of_ == columns() && (matrix_ || growing_)) return growing_ != nullptr;
  double area = 0;
  for (const std::uint32_t q : missing()) area += transport_.patchArea()[q];
  return area <= kMostMissing * mesh_.lit_area;
}

std::vector<std::uint32_t> MatrixGatherer::groups() const {
  if (matrix_) return matrix_->group;
  const bool sky = transport_.patchCount() > mesh_.patch_count;
  std::vector<std::uint32_t> out = patchGroups(mesh_, GatheredMatrix::kMostGroups - (sky ? 1 : 0));
  if (sky) out.push_back(out.empty() ? 0 : *std::max_element(out.begin(), out.end()) + 1);
  return out;
}

void MatrixGatherer::begin() {
  growing_ = std::make_shared<GatheredMatrix>();
  GatheredMatrix& m = *growing_;
  m.cut = mesh_.cut;
  m.group = groups();
  m.groups.resize(m.group.empty() ? 0 : *std::max_element(m.group.begin(), m.group.end()) + 1);
  for (std::uint32_t q = 0; q < m.group.size(); ++q) {
    GatheredMatrix::Group& group = m.groups[m.group[q]];
    group.sky = q >= mesh_.patch_count;
    if (!group.sky) {
      const std::uint32_t side = mesh_.patch_side[q];
      const std::uint32_t material = mesh_.surfaces[mesh_.sides[side].surface].material;
      if (group.patches == 0) {
        group.side = side;
        group.material = material;
      }
      if (group.side != side) group.side = kNone;
      group.several_materials = group.several_materials || group.material != material;
    }
    ++group.patches;
    const double area = transport_.patchArea()[q];
    group.area += area;
    group.emission += area * state_.emission()[q];
    group.reflectance += area * state_.reflectance()[q];
  }
  for (GatheredMatrix::Group& group : m.groups) {
    group.emission /= group.area;
    group.reflectance /= group.area;
  }
  m.factors.assign(m.size() * m.size(), 0.0);
  m.transport.assign(m.size() * m.size(), glm::dvec3(0.0));
  m.missing = missing().size();
  next_ = 0;
  of_ = columns();
}

std::optional<double> MatrixGatherer::done() const {
  if (!growing_ || growing_->group.empty()) return std::nullopt;
  return static_cast<double>(next_) / static_cast<double>(growing_->group.size());
}

bool MatrixGatherer::advance() {
  if (!hasWork()) return false;
  if (!growing_ || of_ != columns()) begin();
  GatheredMatrix& m = *growing_;
  const Receivers& receivers = transport_.receivers();
  const double end = wallSeconds() + kSliceSeconds;
  std::vector<double> factors(m.size());
  std::vector<glm::dvec3> transport(m.size());
  for (; next_ < m.group.size(); ++next_) {
    if (wallSeconds() > end) return false;
    const Column* column = transport_.kept(next_);
    if (!column) continue;
    ++m.columns;
    const std::uint32_t j = m.group[next_];
    m.groups[j].sends = true;
    std::fill(factors.begin(), factors.end(), 0.0);
    std::fill(transport.begin(), transport.end(), glm::dvec3(0.0));
    column->forEach([&](std::uint32_t v, double k) {
      for (std::uint32_t s = receivers.start[v]; s < receivers.start[v + 1]; ++s) {
        const PatchShare& share = receivers.shares[s];
        const std::uint32_t i = m.group[share.patch];
        factors[i] += share.area * k;
        transport[i] += share.area * k * state_.reflectance()[share.patch];
      }
    });
    for (std::size_t i = 0; i < m.size(); ++i) {
      m.factors[i * m.size() + j] += factors[i] / m.groups[i].area;
      m.transport[i * m.size() + j] += transport[i] / m.groups[i].area;
    }
  }
  matrix_ = std::exchange(growing_, nullptr);
  return true;
}

std::vector<glm::dvec3> MatrixGatherer::gathered(const std::vector<glm::dvec3>& per_patch) const {
  if (!matrix_) return {};
  std::vector<glm::dvec3> out(matrix_->size(), glm::dvec3(0.0));
  for (std::uint32_t q = 0; q < matrix_->group.size(); ++q) {
    const std::uint32_t i = matrix_->group[q];
    out[i] += transport_.patchArea()[q] / matrix_->groups[i].area * per_patch[q];
  }
  return out;
}

}  // namespace unshot
