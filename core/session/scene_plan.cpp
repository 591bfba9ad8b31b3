#include "session/scene_plan.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <iterator>
#include <set>

#include "base/colour.h"
#include "base/text.h"
#include "formfactor/methods.h"
#include "mesh/lit.h"

namespace unshot {
namespace {

constexpr std::string_view kNoLightLost =
    "none of the light is left out; elements and patches lie elsewhere, within the error asked for";

constexpr PlanRow kRows[] = {
    {{plan_keys::kOuterSides, "Sides that see nothing", "elements where nothing of the scene lies in front"},
     kNoLightLost},
    {{plan_keys::kDarkSides, "Sides that no light can reach",
      "elements where closed surfaces lie between them and every light"},
     kNoLightLost},
    {{plan_keys::kTriangles, "Borders inside flat surfaces",
      "cuts where polygons of one material join in one plane"},
     "the same surfaces; elements lie elsewhere, within the error asked for"},
    {{plan_keys::kOcclusion, "Tests of what occludes",
      "hemicubes and rays where nothing can stand between two points"},
     "exact: form factors are those of formulas"},
    {{plan_keys::kOccluders, "Walls that hide nothing",
      "shadow rays against surfaces that can stand between no two points"},
     "exact: they have all that light reaches on one side of their plane"},
    {{plan_keys::kEscape, "Looks for light that escapes", "rays and form factors that would find no way out"},
     "closed surfaces lie around every light: exact with exact form factors, and rows that rays would have "
     "left open for sides beyond are closed"},
    {{plan_keys::kHemicubes, "Hemicubes where rays are sooner", "OpenGL for the solution"},
     "within the error asked for; rays are nearer to the truth"},
    {{plan_keys::kEvenLight, "Fine elements where light is even",
      "elements that interpolation between coarser ones would fill with the same light"},
     "within the error asked for, by estimate"},
    {{plan_keys::kFineness, "Elements that the error does not ask for",
      "a mesh finer than a coarse one that was tried and is good enough"},
     "within the error asked for, by estimate"},
    {{plan_keys::kChannels, "Channels that are alike",
      "sums over patches and receivers for channels that are grey, in proportion to another, or dark"},
     "exact: the same sums to rounding, of grey light to the last bit"},
    {{plan_keys::kShots, "Shots one after the other",
      "shots along columns that are at hand: bounces among their patches are summed first, and sent once"},
     "within the error asked for, by the solver's bound: the same light, summed in another order"},
    {{plan_keys::kShooters, "Patches that need not shoot",
      "form factors of patches that are black, or whose light does not matter to the error asked for"},
     "within the error asked for, by the solver's bound; black patches have nothing to send"}};

const PlanRow& rowOf(std::string_view key) { return findChoice(planRows(), key, "decision of the plan"); }

PlanDecision decision(std::string_view key, std::string what, std::string why, std::string saving,
                      double bound = 0) {
  return {std::string(key), std::move(what), std::move(why), std::move(saving), bound};
}

std::size_t roomCount(const Mesh& mesh) {
  std::set<std::uint32_t> rooms;
  for (const Side& side : mesh.sides) rooms.insert(side.room);
  return rooms.size();
}

// Of sides without elements.
void addSides(const PlannedSolve& solve, std::vector<PlanDecision>& out) {
  const Mesh& mesh = solve.mesh;
  struct Left {
    std::size_t sides = 0, emit = 0;
    double area = 0;
  } outer, dark;
  std::size_t unlit = 0;
  for (const Surface& s : mesh.surfaces) {
    unlit += !isLit(s);
    for (int back = 0; back < 2; ++back) {
      if (s.side[back] != kNone) continue;
      Left& left = s.outer[back] ? outer : dark;
      ++left.sides;
      left.emit += mesh.materials[s.material].emits() && !(back && solve.emit_front_only);
      left.area += s.area;
    }
  }
  const auto add = [&](std::string_view key, const Left& left, std::string why) {
    if (left.sides == 0) return;
    const double share = left.area / (outer.area + dark.area + mesh.lit_area);
    out.push_back(decision(
        key,
        "elements on " + std::to_string(left.sides) + " of " + std::to_string(2 * mesh.surfaces.size()) +
            " surface sides",
        std::move(why), std::to_string(static_cast<int>(100 * share + 0.5)) + " % of the area", solve.error));
  };
  add(plan_keys::kOuterSides, outer,
      "nothing of the scene lies in front of them, so no light can reach them" +
          (outer.emit == 0 ? ""
                           : "; what " + std::to_string(outer.emit) + " of them emit" +
                                 (outer.emit == 1 ? "s" : "") + " meets nothing and is left out too"));
  add(plan_keys::kDarkSides, dark,
      "closed surfaces lie between them and every light" +
          (unlit == 0 ? ""
                      : "; " + countedText(unlit, "surface") + " without a lit side " +
                            (unlit == 1 ? "is" : "are") + " in pictures only"));
}

// Whether channel c is to channel `other` as everywhere, and reflected alike.
bool areAlike(const PlannedSolve& solve, int c, int other) {
  double ratio = solve.sky[c] / solve.sky[other];  // not a number where there is no sky
  const auto sameRatio = [&](const glm::dvec3& light) {
    if (light == glm::dvec3(0.0)) return true;
    if (std::isnan(ratio)) ratio = light[c] / light[other];
    return isInProportion(light, c, ratio, other);
  };
  return sameRatio(solve.sky) &&
         std::all_of(solve.mesh.sides.begin(), solve.mesh.sides.end(), [&](const Side& s) {
           return s.reflectance[c] == s.reflectance[other] && sameRatio(s.emission);
         });
}

// Of channels that need no sums of their own.
void addChannels(const PlannedSolve& solve, std::vector<PlanDecision>& out) {
  constexpr std::string_view kNames[] = {"red", "green", "blue"};
  const std::vector<Side>& sides = solve.mesh.sides;
  const auto every = [&](auto&& holds) { return std::all_of(sides.begin(), sides.end(), holds); };
  std::string dark, alike;
  int left_out = 0;
  std::vector<int> own;
  for (int c = 0; c < 3; ++c) {
    const auto like = std::find_if(own.begin(), own.end(), [&](int o) { return areAlike(solve, c, o); });
    if (solve.sky[c] == 0 && every([c](const Side& s) { return s.emission[c] == 0; })) {
      dark += (dark.empty() ? "" : " or ") + std::string(kNames[c]);
    } else if (like != own.end()) {
      alike += (alike.empty() ? "" : "; ") + std::string(kNames[c]) + " light is to " +
               std::string(kNames[*like]) + " as everywhere, and as much of it is reflected";
    } else {
      own.push_back(c);
      continue;
    }
    ++left_out;
  }
  if (left_out == 0 || own.empty()) return;
  if (isGrey(solve.sky) && every([](const Side& s) { return isGrey(s.reflectance) && isGrey(s.emission); }))
    alike = "all reflectances and emissions that light meets are grey, so channels are alike";
  if (!dark.empty()) dark = "nothing emits " + dark + (alike.empty() ? "" : "; ");
  out.push_back(decision(
      plan_keys::kChannels,
      std::string(left_out == 1 ? "one" : "two") + " of three channels in sums over patches and receivers",
      dark + alike, std::string(left_out == 1 ? "a third" : "two thirds") + " of these sums"));
}

}  // namespace

std::span<const PlanRow> planRows() { return kRows; }

std::string_view PlanDecision::sure() const { return rowOf(key).sure; }

DoAnyway doAll() {
  DoAnyway out;
  for (const PlanRow& row : kRows) {
    if (row.info.key != plan_keys::kShooters) out.emplace_back(row.info.key);
  }
  return out;
}

DoAnyway doAnyway(std::string_view list) {
  DoAnyway out;
  for (std::size_t first = 0; first <= list.size();) {
    const std::size_t end = std::min(list.find(',', first), list.size());
    out.emplace_back(rowOf(list.substr(first, end - first)).info.key);
    first = end + 1;
  }
  return out;
}

bool leavesOut(const DoAnyway& done, std::string_view key) {
  return std::find(done.begin(), done.end(), key) == done.end();
}

bool doesAll(const DoAnyway& done) {
  const DoAnyway all = doAll();
  return std::none_of(all.begin(), all.end(), [&](const std::string& key) { return leavesOut(done, key); });
}

std::vector<PlanDecision> makePlan(const PlannedSolve& solve) {
  const Mesh& mesh = solve.mesh;
  std::vector<PlanDecision> out;
  addSides(solve, out);
  const std::size_t polygons = solve.scene.polygons.size();
  if (polygons > mesh.surfaces.size() && leavesOut(solve.done, plan_keys::kTriangles)) {
    out.push_back(decision(
        plan_keys::kTriangles, "borders inside " + std::to_string(mesh.surfaces.size()) + " surfaces",
        std::to_string(polygons) + " polygons of the scene join into them: same plane and material",
        "elements as fine as the light needs, not as the input was cut", solve.error));
  }
  const std::size_t rooms = roomCount(mesh);
  const std::string apart =
      rooms < 2 ? "" : "; no light goes straight from one of " + std::to_string(rooms) + " rooms to another";
  if (solve.form_factors == "closed-form" && nothingCanOcclude(mesh)) {
    out.push_back(decision(plan_keys::kOcclusion, "occlusion tests, hemicubes and OpenGL for the solution",
                           "every surface has the whole " + std::string(rooms < 2 ? "scene" : "room") +
                               " on one side of its plane, so nothing can stand between two points" + apart,
                           "all pictures; the form factors are exact"));
  }
  const bool by_rays = solve.form_factors == "rays";
  const auto between = static_cast<std::size_t>(
      std::count_if(mesh.surfaces.begin(), mesh.surfaces.end(), [](const Surface& s) { return s.between; }));
  const auto lit = static_cast<std::size_t>(std::count_if(mesh.surfaces.begin(), mesh.surfaces.end(), isLit));
  if (by_rays && (between < lit || rooms > 1) && !mesh.all_tested) {
    out.push_back(decision(
        plan_keys::kOccluders,
        "shadow rays against " + countedText(lit - between, "surface") +
            (rooms < 2 ? "" : " and from room to room"),
        (rooms < 2 ? "these have all that light reaches on one side of their plane, so they can stand "
                     "between no two points"
                   : "these have all of their room on one side of their plane, so they can stand between no "
                     "two points of it") +
            apart,
        "tests against " + std::to_string(lit - between) + " of " + std::to_string(lit) + " surfaces"));
  }
  if (mesh.closed && (by_rays || solve.form_factors == "closed-form")) {
    out.push_back(decision(plan_keys::kEscape, "looks for light that escapes",
                           "closed surfaces lie around every light, so none of it leaves the scene",
                           by_rays
                               ? "144 rays from each of " + countedText(mesh.patch_count, "patch", "patches")
                               : "a row of form factors for each receiver",
                           by_rays ? solve.error : 0));
  }
  if (leavesOut(solve.done, plan_keys::kChannels)) addChannels(solve, out);
  return out;
}

PlanDecision withoutHemicubes(const Mesh& mesh, double error) {
  return decision(plan_keys::kHemicubes, "hemicubes and OpenGL for the solution",
                  "shadow rays see as much from " + std::to_string(mesh.vertices.size()) +
                      " vertices sooner and more exactly",
                  "all pictures", error);
}

PlanDecision withoutFineness(const Mesh& mesh, double error, const ErrorEstimate& found, double usual) {
  const auto percent = [](double x) { return figureText(100 * x) + " %"; };
  return decision(plan_keys::kFineness, "elements finer than the light needs",
                  "a mesh of " + std::to_string(mesh.element_count) +
                      " elements was solved at once, and by exact factors at " +
                      std::to_string(found.places) + " points its light is within about " +
                      percent(found.value) + " (" + percent(found.low) + " to " + percent(found.high) + ")",
                  std::to_string(mesh.element_count) + " elements instead of some " + figureText(usual),
                  error);
}

PlanDecision withoutEvenLight(const Mesh& mesh, double error) {
  // As fine everywhere as one in twenty elements: slivers, which cuts leave, do not count.
  std::vector<double> areas = mesh.element_area;
  const auto fine = areas.begin() + static_cast<std::ptrdiff_t>(areas.size() / 20);
  std::nth_element(areas.begin(), fine, areas.end());
  return decision(
      plan_keys::kEvenLight, "fine elements where direct light is even",
      "it is what interpolation makes of it there; other light takes the vertices of " +
          std::to_string(mesh.base->element_count) + " even elements",
      std::to_string(mesh.element_count) + " elements instead of some " + figureText(mesh.lit_area / *fine),
      error);
}

PlanDecision withoutShots(std::size_t at_hand, std::size_t patches, double error) {
  return decision(plan_keys::kShots, "shots one after the other along columns at hand",
                  "the columns of " + std::to_string(at_hand) + " of " + std::to_string(patches) +
                      " patches are kept, and among these a bounce is a small product",
                  "all but one of up to 24 bounces of " + std::to_string(at_hand) + " shots", error);
}

PlanDecision withoutAnyShots(std::size_t patches, double reflected, double error) {
  return decision(plan_keys::kShots, "shots one after the other",
                  "surfaces reflect " + figureText(100 * reflected) +
                      " % of the light, which then takes many bounces, and the columns of " +
                      countedText(patches, "patch", "patches") +
                      " are soon there: gmres solves for all together",
                  "a shot of each patch for each bounce", error);
}

PlanDecision withoutShooters(IdleShooters shooters, double error) {
  const std::size_t idle = shooters.idle.size(), faint = idle - shooters.black;
  std::string why;
  if (shooters.black > 0)
    why = countedText(shooters.black, "patch", "patches") + (shooters.black == 1 ? " is" : " are") + " black";
  if (faint > 0) {
    why += (why.empty() ? "" : "; ") + std::string("the error asked for was reached before the light of ") +
           std::to_string(faint) + " mattered: all that is unshot is " +
           figureText(100 * shooters.unshot_fraction) + " % of what was emitted";
  }
  const double share = static_cast<double>(idle) / static_cast<double>(shooters.patches);
  PlanDecision out = decision(
      plan_keys::kShooters,
      "form factors of " + std::to_string(idle) + " of " + std::to_string(shooters.patches) + " patches",
      std::move(why), std::to_string(static_cast<int>(100 * share + 0.5)) + " % of the patches",
      faint > 0 ? error : 0);
  out.patches = std::move(shooters.idle);
  return out;
}

}  // namespace unshot
