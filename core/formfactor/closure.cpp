#include "formfactor/closure.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "formfactor/emitter_share.h"
#include "formfactor/transport.h"

namespace unshot {
namespace {

// A row that needs more than this is of a point that sees next to nothing, such as one in a gap of no width.
constexpr double kMostScale = 4;
// Weight of a base vertex at which the refined mesh's vertex is the same.
constexpr float kSame = 0.999f;
// Share of its view from which what a refined vertex sees by itself is scaled by itself.
constexpr double kGoodPart = 0.1;
// Of a patch; single precision holds no more. And rounds that take it there.
constexpr double kClosedRow = 1e-9;
constexpr int kMostRounds = 100;

// What emitters reflect, of what the scene absorbs, from which their columns are scaled too.
constexpr double kMuchByEmitters = 0.2;

// The sky's, those of emitters that the light's shadows hang on, and those of all emitters where they reflect
// little: their light comes straight, with shadows that no scaling may blur.
std::vector<std::uint8_t> exactColumns(const Mesh& mesh, std::size_t sources) {
  double by_emitters = 0, absorbed = 0;
  for (std::uint32_t q = 0; q < mesh.patch_count; ++q) {
    const glm::dvec3& rho = mesh.sides[mesh.patch_side[q]].reflectance;
    absorbed += mesh.patch_area[q] * (3 - rho.x - rho.y - rho.z);
    if (mesh.emits(q)) by_emitters += mesh.patch_area[q] * (rho.x + rho.y + rho.z);
  }
  const bool all = by_emitters < kMuchByEmitters * absorbed;
  const EmitterShare share(mesh);
  std::vector<std::uint8_t> out;
  for (std::uint32_t q = 0; q < sources; ++q) {
    const bool sky = q >= mesh.patch_count;
    out.push_back(
        sky || (mesh.emits(q) && (all || share.isLarge(mesh.sides[mesh.patch_side[q]], mesh.patch_area[q]))));
  }
  return out;
}

struct RowSums {
  std::vector<double> exact, scaled;
};

RowSums sumRows(const Transport& transport, const std::vector<std::uint8_t>& exact) {
  RowSums out{std::vector<double>(transport.receiverCount(), 0.0),
              std::vector<double>(transport.receiverCount(), 0.0)};
  for (std::uint32_t q = 0; q < transport.patchCount(); ++q) {
    std::vector<double>& sum = exact[q] ? out.exact : out.scaled;
    transport.kept(q)->forEach([&](std::uint32_t v, double k) { sum[v] += k; });
  }
  return out;
}

// Of each receiver on the base the refined mesh's receiver at the same place, kNone where there is none.
std::vector<std::uint32_t> twinsOf(const Receivers& receivers) {
  std::vector<std::uint32_t> out(receivers.size(), kNone);
  const SparseRows& rows = receivers.from_base;
  for (std::uint32_t v = 0; v < receivers.base_first; ++v) {
    for (std::uint32_t k = rows.start[v]; k < rows.start[v + 1]; ++k) {
      if (rows.weight[k] > kSame) out[rows.index[k]] = v;
    }
  }
  return out;
}

// Of a vertex of the refined mesh: what its own columns must sum to, beside what it has of the base's around
// it, where they are a good part of it; else it goes with the base.
void scaleRefined(const Receivers& receivers, const RowSums& sums, std::span<const float> escape,
                  std::vector<float>& scale) {
  const SparseRows& rows = receivers.from_base;
  for (std::uint32_t v = 0; v < receivers.base_first; ++v) {
    double around = 0, escapes = 0, weights = 0, from_base = 0;
    for (std::uint32_t k = rows.start[v]; k < rows.start[v + 1]; ++k) {
      const std::uint32_t b = rows.index[k];
      const double w = rows.weight[k];
      weights += w;
      around += w * scale[b];
      escapes += escape.empty() ? 0 : w * escape[b];
      from_base += w * (sums.exact[b] + scale[b] * sums.scaled[b]);
    }
    if (weights <= 0) continue;
    const double own = (1 - escapes - sums.exact[v] - from_base) / std::max(sums.scaled[v], 1e-300);
    scale[v] =
        static_cast<float>(sums.scaled[v] > kGoodPart ? std::clamp(own, 0.0, kMostScale) : around / weights);
  }
}

// Patches: sum over a patch's receivers of both layers = its area less what escapes. Each patch in turn asks
// its base receivers for what it lacks (Kaczmarz), which takes a tenth or less at each round.
void closePatches(std::size_t patch_count, const Receivers& receivers, const RowSums& sums,
                  const std::vector<std::uint32_t>& twins, std::span<const float> escape,
                  std::vector<float>& scale) {
  std::vector<std::vector<PatchShare>> shares(patch_count);
  std::vector<char> known(patch_count, 1);
  std::vector<double> wanted(patch_count, 0.0), factor(scale.begin(), scale.end());
  for (const PatchShare& s : receivers.shares) {
    shares[s.patch].push_back(s);
    if (s.receiver < receivers.base_first) continue;
    if (!escape.empty() && twins[s.receiver] == kNone) known[s.patch] = 0;
    wanted[s.patch] += s.area * (1 - (escape.empty() ? 0.0 : static_cast<double>(escape[s.receiver])));
  }
  for (int round = 0; round < kMostRounds; ++round) {
    double worst = 0;
    for (std::uint32_t p = 0; p < patch_count; ++p) {
      double has = 0, room = 0;
      for (const PatchShare& s : shares[p]) {
        has += s.area * (sums.exact[s.receiver] + factor[s.receiver] * sums.scaled[s.receiver]);
        if (s.receiver >= receivers.base_first) room += s.area * sums.scaled[s.receiver];
      }
      // A patch that sees nothing but what is open has no room for any.
      if (!known[p] || room <= 0 || room < kGoodPart * wanted[p]) continue;
      worst = std::max(worst, std::abs(wanted[p] - has) / wanted[p]);
      for (const PatchShare& s : shares[p]) {
        if (s.receiver < receivers.base_first) continue;
        double& f = factor[s.receiver];
        f = std::clamp(f + (wanted[p] - has) / room, 0.0, kMostScale);
      }
    }
    if (worst < kClosedRow) break;
  }
  std::copy(factor.begin() + receivers.base_first, factor.end(), scale.begin() + receivers.base_first);
}

}  // namespace

double reflectionGain(const Mesh& mesh) {
  glm::dvec3 reflected(0.0), absorbed(0.0);
  for (std::uint32_t q = 0; q < mesh.patch_count; ++q) {
    const glm::dvec3& rho = mesh.sides[mesh.patch_side[q]].reflectance;
    reflected += mesh.patch_area[q] * rho;
    absorbed += mesh.patch_area[q] * (1.0 - rho);
  }
  double most = 0;
  for (int c = 0; c < 3; ++c) {
    if (reflected[c] <= 0) continue;
    most = std::max(most,
                    absorbed[c] > 0 ? reflected[c] / absorbed[c] : std::numeric_limits<double>::infinity());
  }
  return most;
}

RowClosure closeRows(const Mesh& mesh, const Transport& transport, std::span<const float> escape) {
  const Receivers& receivers = transport.receivers();
  RowClosure out;
  out.exact = exactColumns(mesh, transport.patchCount());
  out.scale.assign(transport.receiverCount(), 1.0f);
  const RowSums sums = sumRows(transport, out.exact);
  const std::vector<std::uint32_t> twins =
      receivers.layered() ? twinsOf(receivers) : std::vector<std::uint32_t>();
  double squares = 0, area = 0;
  for (std::uint32_t v = receivers.base_first; v < receivers.size(); ++v) {
    double exact = sums.exact[v], scaled = sums.scaled[v];
    if (receivers.layered()) {
      if (twins[v] == kNone) continue;
      exact += sums.exact[twins[v]];
      scaled += sums.scaled[twins[v]];
    }
    if (scaled <= 0) continue;
    const double wanted = 1 - exact - (escape.empty() ? 0.0 : static_cast<double>(escape[v]));
    out.scale[v] = static_cast<float>(std::clamp(wanted / scaled, 0.0, kMostScale));
    squares += receivers.area[v] * (wanted - scaled) * (wanted - scaled);
    area += receivers.area[v];
  }
  if (area > 0) out.rms_defect = std::sqrt(squares / area);
  if (receivers.layered()) {
    scaleRefined(receivers, sums, escape, out.scale);
    closePatches(mesh.patch_count, receivers, sums, twins, escape, out.scale);
  }
  return out;
}

RowClosure closeExactRows(const Mesh& mesh, const Transport& transport) {
  const Receivers& receivers = transport.receivers();
  RowClosure out;
  out.exact.assign(transport.patchCount(), 0);
  out.scale.assign(transport.receiverCount(), 1.0f);
  if (receivers.layered())
    closePatches(mesh.patch_count, receivers, sumRows(transport, out.exact), {}, {}, out.scale);
  return out;
}

}  // namespace unshot
