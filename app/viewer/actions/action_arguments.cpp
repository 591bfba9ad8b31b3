#include "viewer/actions/action_arguments.h"

#include <algorithm>
#include <limits>

#include "solver/bounce_series.h"

namespace unshot {
namespace {

/// What stands before the last space, and after it.
std::pair<std::string, std::string> nameAndLast(const std::string& text) {
  const std::size_t space = text.rfind(' ');
  if (space == std::string::npos) return {{}, text};
  return {std::string(trimmed(std::string_view(text).substr(0, space))), text.substr(space + 1)};
}

std::string checkColour(const std::string& text, double most) {
  const auto [name, colour] = nameAndLast(text);
  const std::vector<double> n = numbersOf(colour);
  const bool fits =
      n.size() == 3 && std::all_of(n.begin(), n.end(), [&](double x) { return x >= 0 && x <= most; });
  if (name.empty() || !fits)
    return "'" + text + "' is no name of a material and r,g,b from 0 on" + (most == 1 ? " to 1" : "");
  return {};
}

}  // namespace

std::uint64_t whole(const std::string& text) { return static_cast<std::uint64_t>(*parseNumber(text)); }

std::string checkSwitch(const std::string& text) {
  return text.empty() || text == "on" || text == "off" ? "" : "'" + text + "' is neither on nor off";
}

void setSwitch(bool& value, const std::string& text) { value = text.empty() ? !value : text == "on"; }

std::pair<std::string, std::string> keyAndSwitch(const std::string& text) {
  const std::size_t space = std::min(text.find(' '), text.size());
  return {text.substr(0, space), std::string(trimmed(std::string_view(text).substr(space)))};
}

std::string checkDo(const std::string& text) {
  const auto [key, on] = keyAndSwitch(text);
  const std::string wrong = checkKey(planRows(), false, key);
  return wrong.empty() ? checkSwitch(on) : wrong;
}

void setDo(DoAnyway& done, const std::string& text) {
  const auto [key, on] = keyAndSwitch(text);
  bool wanted = !leavesOut(done, key);
  setSwitch(wanted, on);
  std::erase(done, key);
  if (wanted) done.push_back(key);
}

std::string checkReflectance(const std::string& text) { return checkColour(text, 1); }

std::string checkEmission(const std::string& text) {
  return checkColour(text, std::numeric_limits<double>::max());
}

std::pair<std::string, glm::dvec3> materialAndColour(const std::string& text) {
  const auto [name, colour] = nameAndLast(text);
  const std::vector<double> n = numbersOf(colour);
  return {name, {n[0], n[1], n[2]}};
}

std::string checkLight(const std::string& text) {
  const auto [name, on] = nameAndLast(text);
  return !name.empty() && (on == "on" || on == "off")
             ? ""
             : "'" + text + "' is no name of a material and on or off";
}

std::pair<std::string, bool> materialAndSwitch(const std::string& text) {
  const auto [name, on] = nameAndLast(text);
  return {name, on == "on"};
}

std::string checkUnit(const std::string& text) {
  const std::optional<double> number = parseNumber(text);
  if (text == "watts" || (number && *number > 0 && *number <= 1e6)) return {};
  return "'" + text + "' is neither watts nor lumens per watt, above 0";
}

std::string checkFraction(const std::string& text) {
  const std::optional<double> number = parseNumber(text);
  return number && *number > 0 && *number < 1 ? "" : "'" + text + "' does not lie between 0 and 1";
}

std::string checkShare(const std::string& text) {
  const std::optional<double> number = parseNumber(text);
  return number && *number >= 0 && *number <= 1 ? "" : "'" + text + "' is no number from 0 to 1";
}

std::string checkNumber(const std::string& text) {
  const std::optional<double> number = parseNumber(text);
  return number && std::abs(*number) <= 100 ? "" : "'" + text + "' is no number from -100 to 100";
}

std::optional<PlotAxis> plotAxis(const std::string& text) {
  if (text == "seconds") return PlotAxis::kSeconds;
  if (text == "shots") return PlotAxis::kShots;
  return text == "rows" ? std::optional(PlotAxis::kRows) : std::nullopt;
}

std::string checkBounces(const std::string& text) {
  if (text == "all") return {};
  const std::string wrong = checkWhole<1, BounceSeries::kMost>(text);
  return wrong.empty() ? wrong : wrong + ", nor 'all'";
}

std::string checkScale(const std::string& text) {
  const std::optional<double> number = parseNumber(text);
  return number && *number >= 0.5 && *number <= 4 ? "" : "'" + text + "' is no number from 0.5 to 4";
}

std::optional<std::pair<int, int>> sizeOf(const std::string& text) {
  const std::vector<std::string_view> parts = splitParts(text, 'x');
  if (parts.size() != 2) return std::nullopt;
  const std::optional<double> width = parseNumber(parts[0]), height = parseNumber(parts[1]);
  const auto fits = [](const std::optional<double>& x) {
    return x && *x >= 200 && *x <= 8192 && *x == std::floor(*x);
  };
  if (!fits(width) || !fits(height)) return std::nullopt;
  return std::pair{static_cast<int>(*width), static_cast<int>(*height)};
}

std::string checkSize(const std::string& text) {
  return sizeOf(text) ? "" : "'" + text + "' is no size WIDTHxHEIGHT from 200 to 8192 pixels";
}

std::vector<double> numbersOf(const std::string& text) {
  std::vector<double> numbers;
  for (const std::string_view part : splitParts(text, ',')) {
    const std::optional<double> number = parseNumber(part);
    if (!number || !std::isfinite(*number)) return {};
    numbers.push_back(*number);
  }
  return numbers;
}

std::string checkPlace(const std::string& text) {
  const std::vector<double> n = numbersOf(text);
  const bool fits = n.size() == 2 && n[0] >= 0 && n[0] <= 1 && n[1] >= 0 && n[1] <= 1;
  return fits ? "" : "'" + text + "' is no place X,Y in the picture: from 0,0 (left, top) to 1,1";
}

std::string checkAngle(const std::string& text) {
  const std::optional<double> number = parseNumber(text);
  return number && *number >= 1 && *number <= 170 ? "" : "'" + text + "' is no angle from 1 to 170 degrees";
}

std::string checkSpeed(const std::string& text) {
  constexpr double kMost = Navigator::kSpeedRange;
  const std::optional<double> number = parseNumber(text);
  return number && *number >= 1 / kMost && *number <= kMost ? ""
                                                            : "'" + text + "' is no number from 0.01 to 100";
}

std::string checkCamera(const std::string& text) {
  const std::vector<double> n = numbersOf(text);
  if (n.size() != 6 && n.size() != 7) return "'" + text + "' is no camera ex,ey,ez,ax,ay,az[,fov]";
  if (n[0] == n[3] && n[1] == n[4] && n[2] == n[5]) return "the eye is at the point that it looks at";
  if (n.size() == 7 && !(n[6] >= 1 && n[6] <= 170)) return "the angle of view must be from 1 to 170 degrees";
  return {};
}

}  // namespace unshot
