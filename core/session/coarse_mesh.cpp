#include "session/coarse_mesh.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <limits>
#include <utility>

#include "formfactor/direct_light.h"
#include "formfactor/methods.h"
#include "formfactor/transport.h"
#include "session/fields.h"
#include "session/local_pass.h"
#include "solver/patch_solve.h"
#include "solver/state.h"

namespace unshot {
namespace {

// The first trial has this share of the usual elements, or that where light straight from emitters is even,
// the last at most that. Of rooms lit by a wall the first is mostly the last.
constexpr double kFirst = 1.0 / 9, kFirstOfEven = 1.0 / 64, kLast = 1.0 / 2;
// Of a surface's width: so far off its borders it is looked at, and in the middle.
constexpr double kOffBorders = 0.05;
// From one trial to the next, times as many at least and at most.
constexpr double kLeastStep = 2, kMostStep = 10;
// The error falls with at least the first of these powers of their number, as walls that meet hold it up, and
// usually with about the second. A trial aims at this share of what is allowed.
constexpr double kLeastOrder = 0.5, kOrder = 0.75, kAim = 0.85;
// The upper end of an estimate's interval over the error asked for: besides the spread over places it allows
// for occluders and coarse patches (1.8). In rooms without either errors were up to 1.4 times the estimate.
constexpr double kTrusted = 1.5;
// Where more than so many times the last trial's elements seem to be needed, no more are made.
constexpr double kHopeless = 1.1;
// Of an emitter, at least, over the edge of an element of the first trial.
constexpr double kWidth = 0.5;
// That end over the estimate itself, about, and with more places.
constexpr double kSpread = 2.4, kNarrowed = 2.1;
// At so many places, and where they leave open whether it is enough, at so many in all.
constexpr std::size_t kPlaces = 64, kMorePlaces = 256;
// Of the solution of the patches, which is to add nothing.
constexpr double kTolerance = 1e-5;
constexpr int kMostProducts = 200;
constexpr std::size_t kAnyMemory = std::size_t{1} << 30;  // [bytes]

// Whether light straight from emitters is the same all over each surface, but for this share of the mean.
bool isLitEvenly(const Mesh& coarsest, double share, std::uint64_t seed) {
  DirectLight light(coarsest, false, seed);
  double sum = 0, count = 0, widest = 0;
  for (std::uint32_t s = 0; s < coarsest.sides.size(); ++s) {
    if (coarsest.sides[s].reflectance == glm::dvec3(0.0)) continue;
    const Surface& surface = coarsest.surfaces[coarsest.sides[s].surface];
    glm::dvec3 low(std::numeric_limits<double>::infinity()), high(0.0);
    for (const glm::dvec2 at :
         {glm::dvec2(0.5), glm::dvec2(kOffBorders), glm::dvec2(1 - kOffBorders),
          glm::dvec2(kOffBorders, 1 - kOffBorders), glm::dvec2(1 - kOffBorders, kOffBorders)}) {
      const glm::dvec3 found = light.at(surface.point(at * surface.extent), s, 0);
      low = glm::min(low, found);
      high = glm::max(high, found);
      sum += found.x + found.y + found.z;
      ++count;
    }
    const glm::dvec3 off = high - low;
    widest = std::max(widest, off.x + off.y + off.z);
  }
  return count == 0 || widest <= share * sum / count;
}

// Beside elements of a mesh of so many.
bool emittersAreWide(const Mesh& coarsest, double elements) {
  const double size = std::sqrt(coarsest.lit_area / elements);
  return std::all_of(coarsest.sides.begin(), coarsest.sides.end(), [&](const Side& side) {
    const Surface& surface = coarsest.surfaces[side.surface];
    return side.emission == glm::dvec3(0.0) ||
           surface.area >= kWidth * size * std::max(surface.extent.x, surface.extent.y);
  });
}

}  // namespace

bool mayBeCoarse(const Mesh& coarsest, double usual) {
  return coarsest.element_count <= kFirstOfEven * usual + 2 * static_cast<double>(coarsest.sides.size()) &&
         emittersAreWide(coarsest, kFirst * usual);
}

CoarseMesh findCoarseMesh(const Mesh& coarsest, const CoarseTrial& trial, const CancelToken& cancel) {
  const double last = kLast * trial.usual, enough = kTrusted * trial.error;
  const bool even =
      emittersAreWide(coarsest, kFirstOfEven * trial.usual) && isLitEvenly(coarsest, trial.error, trial.seed);
  const double first = even ? kFirstOfEven : kFirst;
  std::uint32_t tried = 0;  // elements
  for (double elements = first * trial.usual; elements <= last;) {
    std::shared_ptr<const Mesh> mesh = trial.make(elements);
    if (std::exchange(tried, mesh->element_count) == mesh->element_count) {
      elements *= kLeastStep;
      continue;
    }
    SolvedAtOnce solved = solveAtOnce(*mesh, enough, trial.seed, trial.fewer_channels, cancel);
    const ErrorEstimate found = solved.error;
    if (found.places == 0) break;
    if (found.high <= enough) return {std::move(mesh), std::move(solved)};
    const double over = kSpread * found.value / enough;
    if (elements * std::pow(over, 1 / kLeastOrder) > kHopeless * last) break;
    const double over_aim = found.high / (kAim * enough);
    const double step = std::clamp(std::pow(over_aim, 1 / kOrder), kLeastStep, kMostStep);
    // What is hardly more than the last trial may have is tried with that.
    elements = elements < last ? std::min(step * elements, last) : step * elements;
  }
  return {};
}

SolvedAtOnce solveAtOnce(const Mesh& mesh, double enough, std::uint64_t seed, bool fewer_channels,
                         const CancelToken& cancel) {
  FormFactorSetup setup;
  setup.mesh = &mesh;
  setup.cancel = cancel;
  setup.receivers = std::make_shared<const Receivers>(makeReceivers(mesh, ReceiverKind::kVertices, cancel));
  Transport transport(makeClosedForm(setup), *setup.receivers, mesh.patch_area, kAnyMemory);
  std::vector<glm::dvec3> emission, reflectance;
  for (const std::uint32_t side : mesh.patch_side) {
    emission.push_back(mesh.sides[side].emission);
    reflectance.push_back(mesh.sides[side].reflectance);
  }
  RadiosityState state(transport, emission, reflectance);
  PatchMatrix matrix(transport.receivers(), transport.patchArea(), kAnyMemory);
  state.allowFewerChannels(fewer_channels);
  matrix.allowFewerChannels(fewer_channels);
  for (std::uint32_t q = 0; q < mesh.patch_count; ++q) {
    cancel.check();
    matrix.set(q, transport.column(q));
  }
  const std::vector<glm::dvec3> shot = solvePatches(matrix, reflectance, emission, kTolerance, kMostProducts);
  for (std::uint32_t q = 0; q < mesh.patch_count; ++q) {
    if (shot[q] != glm::dvec3(0.0)) state.shoot(q, shot[q], transport.column(q));
  }
  SolvedAtOnce out;
  std::vector<glm::dvec3> shown = state.irradiance();
  if (transport.receivers().layered()) {
    LocalPass local_pass(mesh, transport.receivers(), false);
    for (int k = 0; k < LocalPass::kPasses; ++k) {
      local_pass.begin(state, makeField(mesh, transport.receivers(), shown));
      while (local_pass.running()) {
        cancel.check();
        local_pass.advance(transport);
      }
      out.local_irradiance = local_pass.irradiance();
      shown = state.irradiance();
      for (std::size_t v = 0; v < shown.size(); ++v) shown[v] += out.local_irradiance[v];
    }
  }
  Residuals residuals(mesh, transport.receivers(), false, seed);
  const MeshField field = makeField(mesh, transport.receivers(), shown);
  for (std::size_t places : {kPlaces, kMorePlaces - kPlaces}) {
    residuals.add(places, field);
    out.error = residuals.estimate(state, matrix, field, false).both;
    // More places narrow the interval about the value.
    if (out.error.high <= enough || out.error.value * kNarrowed > enough) break;
  }
  out.places = residuals.takePlaces();
  out.values = state.values();
  for (std::uint32_t q = 0; q < mesh.patch_count; ++q) out.columns.push_back(*transport.take(q, false));
  return out;
}

}  // namespace unshot
