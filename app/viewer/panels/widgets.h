// Small pieces that the panels are made of.
#pragma once

#include <imgui.h>

#include <span>
#include <string>
#include <string_view>

namespace unshot {

/// The header of a part of the panel; false where it is closed.
bool section(const char* title);

/// Shown while the mouse is over the item before; nothing for an empty text.
void tooltip(std::string_view text);

/// A label on the left; what follows takes the rest of the line.
void label(const char* text, std::string_view tip = {});

/// A disc in the line's left end; text follows it.
void dot(const ImVec4& colour);

/// A whole number as an exponent: "\u00b9\u2070".
std::string superscript(std::size_t number);

/// Text on the left and text at the right border, below it where both do not fit.
void line(const char* name, const std::string& value, std::string_view tip = {});

/// As many digits as a column of figures holds: "0.0123", "1.23e-5", "1.2e-12"; and its width [px].
std::string channelText(double value);
float channelWidth();

/// Text at the right end of the room there is, such as a cell of a table.
void rightAligned(const std::string& text, bool dim = false);

/// Text over as many lines as it takes; `width` [px] is that of the room there is where it is 0.
void wrapped(const std::string& text, float width = 0);
void dimmed(const std::string& text, float width = 0);

/// A name on the left, and beside it text over as many lines as it takes.
void paragraph(const char* name, std::string_view text);

/// As much of the text as is no wider than this [px], with an ellipsis where that is not all.
std::string shortened(const std::string& text, float width);

/// ImGui::BeginCombo with `shown` in the closed box, shortened where it is too long for it; the tooltip then
/// has all of it.
bool beginCombo(const char* id, const std::string& shown);

/// The text broken into lines no wider than this [px]: between words, so that no number is torn apart; within
/// a word only where that alone is wider, such as a long path. Lines that it has stay.
std::string brokenText(std::string_view text, float width);

/// The title of a table's row; the key itself where there is none.
template <class Row>
std::string titleOf(std::span<const Row> table, std::string_view key) {
  for (const Row& row : table) {
    if (row.info.key == key) return std::string(row.info.title);
  }
  return std::string(key);
}

/// A choice from a table: `shown` is what stands in the closed box, `current` the key that is marked. Returns
/// the key chosen, or nothing.
template <class Row>
std::string choose(const char* id, std::span<const Row> table, const std::string& current,
                   const std::string& shown, const char* automatic) {
  std::string chosen;
  if (!beginCombo(id, shown)) return chosen;
  if (automatic) {
    if (ImGui::Selectable("Automatic", current == "auto")) chosen = "auto";
    tooltip(automatic);
  }
  for (const Row& row : table) {
    const std::string title(row.info.title);
    if (ImGui::Selectable(title.c_str(), current == row.info.key)) chosen = row.info.key;
    tooltip(row.info.help);
  }
  ImGui::EndCombo();
  return chosen;
}

}  // namespace unshot
