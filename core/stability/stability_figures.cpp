#include "stability/stability_figures.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <utility>

namespace unshot {
namespace {

constexpr const char* kChannels[] = {"red", "green", "blue"};
constexpr double kNoNumber = std::numeric_limits<double>::quiet_NaN();

/// An element that counts, with what it receives [W/m^2].
struct Lit {
  double area;
  const Side& side;
  glm::dvec3 irradiance;
};

template <class Visit>
void forElements(const Snapshot& s, const SideFilter& filter, Visit visit) {
  const Mesh& mesh = *s.mesh;
  for (std::size_t e = 0; e < mesh.element_count; ++e) {
    const Side& side = mesh.sides[mesh.element_side[e]];
    if (filter(mesh, side)) visit(Lit{mesh.element_area[e], side, glm::dvec3(s.element_irradiance[e])});
  }
}

glm::dvec3 radiosityOf(const Lit& lit) { return lit.side.emission + lit.side.reflectance * lit.irradiance; }

template <class Value>
glm::dvec3 meanOf(const Snapshot& s, const SideFilter& filter, Value value) {
  glm::dvec3 sum(0.0);
  double area = 0;
  forElements(s, filter, [&](const Lit& lit) {
    sum += lit.area * value(lit);
    area += lit.area;
  });
  return area > 0 ? sum / area : glm::dvec3(kNoNumber);
}

}  // namespace

double Figure::error() const { return expected == 0 ? std::abs(got) : std::abs(got / expected - 1); }

bool Figure::within() const {
  if (at_most) return got >= 0 && got <= expected;
  return error() <= tolerance;
}

double Figure::strain() const {
  if (!std::isfinite(got)) return std::numeric_limits<double>::infinity();
  if (at_most) return within() ? got / expected : std::numeric_limits<double>::infinity();
  if (error() == 0) return 0;
  return tolerance > 0 ? error() / tolerance : std::numeric_limits<double>::infinity();
}

SideFilter everySide() {
  return [](const Mesh&, const Side&) { return true; };
}

SideFilter ofMaterial(std::string_view name) {
  return [name = std::string(name)](const Mesh& mesh, const Side& side) {
    return mesh.materials[mesh.surfaces[side.surface].material].name == name;
  };
}

SideFilter frontOf(std::string_view name) {
  return [material = ofMaterial(name)](const Mesh& mesh, const Side& side) {
    return !side.back && material(mesh, side);
  };
}

double sidesOf(const Solve& solve, const SideFilter& filter) {
  const Mesh& mesh = solve.mesh();
  return static_cast<double>(std::count_if(mesh.sides.begin(), mesh.sides.end(),
                                           [&](const Side& side) { return filter(mesh, side); }));
}

glm::dvec3 meanRadiosity(const Solve& solve, const SideFilter& filter) {
  return meanOf(solve.snapshot(), filter, radiosityOf);
}

glm::dvec3 meanIrradiance(const Solve& solve, const SideFilter& filter) {
  return meanOf(solve.snapshot(), filter, [](const Lit& lit) { return lit.irradiance; });
}

glm::dvec3 meanDirectIrradiance(const Solve& solve, const SideFilter& filter) {
  Snapshot direct = solve.snapshot();
  if (!direct.element_direct) return glm::dvec3(0.0);
  direct.element_irradiance = *direct.element_direct;
  return meanOf(direct, filter, [](const Lit& lit) { return lit.irradiance; });
}

std::vector<Figure> meanFigures(const Solve& solve, const std::string& what, const SideFilter& filter,
                                const glm::dvec3& expected, double tolerance) {
  const glm::dvec3 mean = meanRadiosity(solve, filter);
  std::vector<Figure> out;
  for (int c = 0; c < 3; ++c)
    out.push_back({what + ", " + kChannels[c], mean[c], expected[c], expected[c] == 0 ? 0 : tolerance});
  return out;
}

std::vector<Figure> evenFigures(const Solve& solve, const glm::dvec3& expected, double of_mean,
                                double of_rms) {
  std::vector<Figure> out = meanFigures(solve, "mean B", everySide(), expected, of_mean);
  double error = 0, reflected = 0;
  forElements(solve.snapshot(), everySide(), [&](const Lit& lit) {
    for (int c = 0; c < 3; ++c) {
      const double off = (radiosityOf(lit)[c] - expected[c]) / expected[c],
                   part = 1 - lit.side.emission[c] / expected[c];
      error += lit.area * off * off;
      reflected += lit.area * part * part;
    }
  });
  out.push_back({"nRMSE of B", reflected > 0 ? std::sqrt(error / reflected) : kNoNumber, 0, of_rms});
  return out;
}

Figure exactFigure(const Solve& solve, const std::string& what, const SideFilter& filter,
                   const glm::dvec3& expected) {
  Figure figure{what, kNoNumber, expected.x};
  double farthest = -1;
  forElements(solve.snapshot(), filter, [&](const Lit& lit) {
    for (int c = 0; c < 3; ++c) {
      const double value = radiosityOf(lit)[c], off = std::abs(value - expected[c]);
      if (off <= farthest) continue;
      farthest = off;
      figure.got = value;
      figure.expected = expected[c];
    }
  });
  return figure;
}

Figure saidFigure(const Solve& solve, std::string_view code) {
  const Diagnostics& said = solve.diagnostics();
  const bool found =
      std::any_of(said.begin(), said.end(), [&](const Diagnostic& d) { return d.code == code; });
  return {"says " + std::string(code), found ? 1.0 : 0.0, 1};
}

bool stateIsSound(const Solve& solve) {
  const Snapshot s = solve.snapshot();
  // On its way a mode may be below: the sweeps of gmres go either way.
  const bool solved = solve.state() == SolveState::kConverged;
  const auto sound = [&](const glm::vec3& h) {
    for (int c = 0; c < 3; ++c) {
      if (!std::isfinite(h[c]) || (solved && h[c] < 0)) return false;
    }
    return true;
  };
  return std::all_of(s.element_irradiance.begin(), s.element_irradiance.end(), sound) &&
         std::all_of(s.irradiance.begin(), s.irradiance.end(), sound);
}

void append(std::vector<Figure>& all, std::vector<Figure> more) {
  all.insert(all.end(), std::make_move_iterator(more.begin()), std::make_move_iterator(more.end()));
}

}  // namespace unshot
