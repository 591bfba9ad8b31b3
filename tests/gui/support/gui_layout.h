// What lies where in a frame of the GUI: windows and letters, as ImGui has laid them out, and what of it is
// wrong.
#pragma once

#include <imgui.h>
#include <imgui_internal.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <map>
#include <set>
#include <string>
#include <utility>
#include <vector>

namespace unshot::testing_support {

struct Letter {
  ImRect box;
  ImVec4 clip;
  std::string text;
  bool trimmed = false;  ///< a part of it is cut off
};

/// Finds letters in draw lists by their places in the texture of the font.
class Letters {
 public:
  explicit Letters(const ImFontAtlas& fonts) {
    for (const ImFont* font : fonts.Fonts) {
      for (const ImFontGlyph& glyph : font->Glyphs) {
        if (glyph.Visible) glyphs_[{glyph.U0, glyph.V0}] = &glyph;
      }
    }
    for (const auto& [corner, glyph] : glyphs_) by_row_[glyph->V0].push_back(glyph);
  }

  std::vector<Letter> of(const ImDrawList& list) const {
    std::vector<Letter> out;
    for (const ImDrawCmd& command : list.CmdBuffer) {
      for (unsigned k = 0; k + 6 <= command.ElemCount; ++k) {
        const ImDrawIdx* index = list.IdxBuffer.Data + command.IdxOffset + k;
        // The two triangles of a rectangle.
        if (index[3] != index[0] || index[4] != index[2]) continue;
        const ImDrawVert* vertices = list.VtxBuffer.Data + command.VtxOffset;
        const ImDrawVert &a = vertices[index[0]], &b = vertices[index[2]];
        bool whole = false;
        const ImFontGlyph* glyph = find(a.uv, b.uv, whole);
        if (!glyph) continue;
        out.push_back({{a.pos, b.pos}, command.ClipRect, textOf(*glyph), !whole});
        k += 5;
      }
    }
    return out;
  }

 private:
  const ImFontGlyph* find(const ImVec2& low, const ImVec2& high, bool& whole) const {
    const auto exact = glyphs_.find({low.x, low.y});
    if (exact != glyphs_.end() && exact->second->U1 == high.x && exact->second->V1 == high.y) {
      whole = true;
      return exact->second;
    }
    if (!(low.x < high.x && low.y < high.y)) return nullptr;
    for (const auto& [row, glyphs] : by_row_) {
      for (const ImFontGlyph* g : glyphs) {
        if (low.x >= g->U0 && low.y >= g->V0 && high.x <= g->U1 && high.y <= g->V1) return g;
      }
    }
    return nullptr;
  }
  static std::string textOf(const ImFontGlyph& glyph) {
    char bytes[5] = {};
    ImTextCharToUtf8(bytes, glyph.Codepoint);
    return bytes;
  }

  std::map<std::pair<float, float>, const ImFontGlyph*> glyphs_;
  std::map<float, std::vector<const ImFontGlyph*>> by_row_;
};

/// All that is wrong with the frame that was laid out last, a line each.
class LayoutCheck {
 public:
  explicit LayoutCheck(const ImVec2& screen) : screen_(screen), letters_(*ImGui::GetIO().Fonts) {}

  /// Whether one of both may lie over the other.
  static bool mayLieOver(const ImGuiWindow& one, const ImGuiWindow& other) {
    using Names = std::set<std::string>;
    // What asks to be read first, but not over each other; and the line of a wipe.
    static const Names first = {"message", "help", "prompt"}, beside = {"panel", "lecture"};
    // What is under way, in the middle of the scene.
    static const Names middle = {"tasks", "framing", "empty", "dark"};
    static const Names edge = {"hemicube",          "legend",    "false colours",
                               "reference picture", "wipe-ours", "wipe-theirs"};
    const std::string a = one.Name, b = other.Name;
    for (const char* passing : {"##Tooltip", "##Combo", "##Popup"}) {
      if (a.starts_with(passing) || b.starts_with(passing)) return true;
    }
    const auto between = [&](const Names& these, const Names& those) {
      return (these.contains(a) && those.contains(b)) || (these.contains(b) && those.contains(a));
    };
    // A panel that covers the scene, and a lecture that leaves no room for a word beside it.
    const ImGuiWindow& wide = beside.contains(a) ? one : other;
    if (beside.contains(a) || beside.contains(b)) return wide.Pos.x < 12 * ImGui::GetFontSize();
    if (between(first, first)) return false;
    // Where there is no room above them.
    const bool small = ImGui::GetIO().DisplaySize.y < 30 * ImGui::GetFontSize();
    if (between({"notice"}, edge) || between({"notice"}, {"race-left", "race-right"})) return small;
    return first.contains(a) || first.contains(b) || a == "wipe" || b == "wipe" || between(middle, edge);
  }

  std::set<std::string> problems() const {
    std::set<std::string> out;
    std::vector<const ImGuiWindow*> roots;
    for (const ImGuiWindow* window : ImGui::GetCurrentContext()->Windows) {
      if (!window->Active || window->Hidden || window->DrawList->CmdBuffer.empty()) continue;
      if (std::string(window->Name).starts_with("Debug##")) continue;
      if (!(window->Flags & ImGuiWindowFlags_ChildWindow)) roots.push_back(window);
      lettersOf(*window, out);
      // What is beyond leaves no letters behind.
      const float room = window->SizeFull.x - 2 * window->WindowPadding.x - window->ScrollbarSizes.x;
      if (window->ContentSize.x > room + 1)
        out.insert(nameOf(*window) + " is too narrow for what is in it, " +
                   std::to_string(window->ContentSize.x) + " on " + std::to_string(room));
    }
    tables(out);
    for (std::size_t k = 0; k < roots.size(); ++k) {
      const ImRect box = roots[k]->Rect();
      if (box.Min.x < -1 || box.Min.y < -1 || box.Max.x > screen_.x + 1 || box.Max.y > screen_.y + 1)
        out.insert(nameOf(*roots[k]) + " goes beyond the screen: " + text(box));
      for (std::size_t i = 0; i < k; ++i) overlap(*roots[i], *roots[k], out);
    }
    return out;
  }

 private:
  static std::string text(const ImRect& r) {
    char bytes[96];
    std::snprintf(bytes, sizeof bytes, "%.0f,%.0f to %.0f,%.0f", static_cast<double>(r.Min.x),
                  static_cast<double>(r.Min.y), static_cast<double>(r.Max.x), static_cast<double>(r.Max.y));
    return bytes;
  }
  static std::string nameOf(const ImGuiWindow& window) { return std::string("window '") + window.Name + "'"; }

  static void overlap(const ImGuiWindow& a, const ImGuiWindow& b, std::set<std::string>& out) {
    ImRect common = a.Rect();
    if (!common.Overlaps(b.Rect())) return;
    common.ClipWith(b.Rect());
    if (common.GetWidth() <= 1 || common.GetHeight() <= 1) return;
    if (mayLieOver(a, b)) return;
    out.insert(nameOf(a) + " and " + nameOf(b) + " lie over each other: " + text(common));
  }

  /// Columns of tables that are narrower than a cell in them.
  static void tables(std::set<std::string>& out) {
    ImGuiContext& gui = *ImGui::GetCurrentContext();
    for (int k = 0; k < gui.Tables.GetMapSize(); ++k) {
      ImGuiTable* const table = gui.Tables.TryGetMapData(k);
      if (!table || table->LastFrameActive != gui.FrameCount) continue;
      for (int n = 0; n < table->ColumnsCount; ++n) {
        const ImGuiTableColumn& column = table->Columns[n];
        const float widest = std::max(column.ContentMaxXUnfrozen, column.ContentMaxXFrozen) - column.WorkMinX;
        const float room = column.WorkMaxX - column.WorkMinX;
        if (column.IsEnabled && widest > room + 1)
          out.insert(nameOf(*table->OuterWindow) + ": column " + std::to_string(n) +
                     " of a table is too narrow for what is in it, " + std::to_string(widest) + " on " +
                     std::to_string(room));
      }
    }
  }

  /// The words around a letter, for people.
  static std::string around(const std::vector<Letter>& letters, std::size_t at) {
    std::string out;
    for (std::size_t k = at < 12 ? 0 : at - 12; k < std::min(at + 6, letters.size()); ++k)
      out += (k == at ? "[" : "") + letters[k].text + (k == at ? "]" : "");
    return out;
  }

  void lettersOf(const ImGuiWindow& window, std::set<std::string>& out) const {
    const std::vector<Letter> letters = letters_.of(*window.DrawList);
    std::map<int, std::vector<std::size_t>> in_band;  // the letters that reach into each, in order
    for (std::size_t k = 0; k < letters.size(); ++k) {
      const Letter& a = letters[k];
      if (!visible(a)) continue;
      const bool cut =
          a.box.Max.x > std::min(a.clip.z, screen_.x) + 1 || a.box.Min.x < std::max(a.clip.x, 0.0f) - 1;
      if (cut || a.trimmed) out.insert(nameOf(window) + ": cut off: " + around(letters, k));
      for (int band = bandOf(a.box.Min.y); band <= bandOf(a.box.Max.y); ++band) {
        for (const std::size_t i : in_band[band]) {
          if (i + 1 < k && over(letters[i], a))
            out.insert(nameOf(window) + ": " + around(letters, i) + " under " + around(letters, k));
        }
        in_band[band].push_back(k);
      }
    }
  }
  /// Of the horizontal bands that a window is looked at in.
  static int bandOf(float y) { return static_cast<int>(std::floor(y / 16)); }
  /// Whether it is seen, at least half of its height.
  static bool visible(const Letter& letter) {
    const float middle = letter.box.GetCenter().y;
    return middle > letter.clip.y && middle < letter.clip.w && letter.box.Max.x > letter.clip.x &&
           letter.box.Min.x < letter.clip.z;
  }
  /// Letters over each other, but for the same one as a shadow.
  static bool over(const Letter& a, const Letter& b) {
    const float width = std::min(a.box.Max.x, b.box.Max.x) - std::max(a.box.Min.x, b.box.Min.x);
    const float height = std::min(a.box.Max.y, b.box.Max.y) - std::max(a.box.Min.y, b.box.Min.y);
    if (width <= 1.5f || height <= 1.5f) return false;
    return a.text != b.text || std::abs(a.box.Min.x - b.box.Min.x) > 3 ||
           std::abs(a.box.Min.y - b.box.Min.y) > 3;
  }

  ImVec2 screen_;
  Letters letters_;
};

}  // namespace unshot::testing_support
