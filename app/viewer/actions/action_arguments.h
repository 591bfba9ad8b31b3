// What actions take as their arguments: a check for each kind, which says what is wrong or nothing, and what
// the text means once it was checked.
#pragma once

#include <cmath>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "base/parse.h"
#include "viewer/viewer.h"

namespace unshot {

/// A whole number from `low` to `high`.
template <std::uint64_t low, std::uint64_t high>
std::string checkWhole(const std::string& text) {
  const std::optional<double> number = parseNumber(text);
  const bool fits = number && *number >= static_cast<double>(low) && *number <= static_cast<double>(high) &&
                    *number == std::floor(*number);
  return fits ? std::string()
              : "'" + text + "' is no whole number from " + std::to_string(low) + " to " +
                    std::to_string(high);
}
std::uint64_t whole(const std::string& text);

/// A key of a table.
template <class Row>
std::string checkKey(std::span<const Row> table, bool with_auto, const std::string& text) {
  std::string keys = with_auto ? "auto" : "";
  if (with_auto && text == "auto") return {};
  for (const Row& row : table) {
    if (row.info.key == text) return {};
    keys += (keys.empty() ? "" : ", ") + std::string(row.info.key);
  }
  return "there is no '" + text + "'; it is one of " + keys;
}

/// What all rows of a table have.
template <class Row, std::span<const Row> (*table)()>
std::vector<ChoiceInfo> rowsOf() {
  std::vector<ChoiceInfo> out;
  for (const Row& row : table()) out.push_back(row.info);
  return out;
}

std::string checkSwitch(const std::string& text);
/// "on", "off", or nothing: the other one.
void setSwitch(bool& value, const std::string& text);

/// "KEY on", "KEY off" or "KEY" alone.
std::pair<std::string, std::string> keyAndSwitch(const std::string& text);
/// A key of the plan and "on", "off", or nothing: the other one.
std::string checkDo(const std::string& text);
void setDo(DoAnyway& done, const std::string& text);

/// The name of a material, which may hold spaces, and r,g,b from 0 on; of reflectances to 1.
std::string checkReflectance(const std::string& text);
std::string checkEmission(const std::string& text);
std::pair<std::string, glm::dvec3> materialAndColour(const std::string& text);
/// The name of a material and "on" or "off".
std::string checkLight(const std::string& text);
std::pair<std::string, bool> materialAndSwitch(const std::string& text);

/// "watts", or a luminous efficacy [lm/W] for lux.
std::string checkUnit(const std::string& text);

std::string checkFraction(const std::string& text);
/// From 0 to 1.
std::string checkShare(const std::string& text);
std::string checkNumber(const std::string& text);
std::string checkBounces(const std::string& text);
std::string checkScale(const std::string& text);
/// Nothing for text that is none.
std::optional<PlotAxis> plotAxis(const std::string& text);

/// WIDTHxHEIGHT.
std::string checkSize(const std::string& text);
std::optional<std::pair<int, int>> sizeOf(const std::string& text);

/// X,Y, each from 0 to 1.
std::string checkPlace(const std::string& text);

/// An angle of view [degrees]; a factor of the speed of flight.
std::string checkAngle(const std::string& text);
std::string checkSpeed(const std::string& text);
/// ex,ey,ez,ax,ay,az[,fov].
std::string checkCamera(const std::string& text);
/// Numbers between commas; none where one of them is no number.
std::vector<double> numbersOf(const std::string& text);

}  // namespace unshot
