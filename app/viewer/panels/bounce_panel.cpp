#include "viewer/panels/bounce_panel.h"

#include <algorithm>
#include <cmath>

#include "base/text.h"
#include "viewer/comparison.h"
#include "viewer/panels/race_panel.h"
#include "viewer/panels/widgets.h"

namespace unshot {
namespace {

// Bars are logarithmic, over so many decades below all of the light emitted.
constexpr int kBarDecades = 4;
constexpr float kBarsHeight = 6;  // of the bars, in font sizes

const ImVec4 kChannelColours[3] = {
    {0.86f, 0.36f, 0.3f, 1}, {0.45f, 0.72f, 0.33f, 1}, {0.36f, 0.55f, 0.9f, 1}};

double sum(const glm::dvec3& x) { return x.x + x.y + x.z; }

/// Which bounces are shown: from `first` on, up to `last`; all light where that is 0.
struct ShownBounces {
  std::uint32_t first = 0, last = 0;
  bool has(std::size_t k) const { return last == 0 || (first <= k && k <= last); }
};

/// Bars of the three channels side by side, each of its own emission; dim where the bounce is not shown.
void bounceBars(const std::vector<glm::dvec3>& power, ImVec2 at, float slot, float height,
                const ShownBounces& shown) {
  ImDrawList& list = *ImGui::GetWindowDrawList();
  for (std::size_t k = 0; k < power.size(); ++k) {
    const float alpha = shown.has(k) ? 1.0f : 0.3f;
    const float left = at.x + static_cast<float>(k) * slot, bar = std::floor((slot - 2) / 3);
    for (int c = 0; c < 3; ++c) {
      if (power[0][c] <= 0 || power[k][c] <= 0) continue;
      const double share = 1 + std::log10(power[k][c] / power[0][c]) / kBarDecades;
      if (share <= 0) continue;
      const float x = std::round(left) + static_cast<float>(c) * bar;
      const auto top = static_cast<float>(height * (1 - std::min(share, 1.0)));
      list.AddRectFilled(
          {x, at.y + std::min(top, height - 1)}, {x + bar, at.y + height},
          ImGui::GetColorU32({kChannelColours[c].x, kChannelColours[c].y, kChannelColours[c].z, alpha}));
    }
    if (k % 2 != 0 && power.size() > 9) continue;
    const std::string number = std::to_string(k);
    const float half = ImGui::CalcTextSize(number.c_str()).x / 2;
    // The last one stays within the bars.
    const float end = at.x + slot * static_cast<float>(power.size()) - 2 * half;
    list.AddText({std::floor(std::min(left + slot / 2 - half - 1, end)), at.y + height + 1},
                 ImGui::GetColorU32(ImGuiCol_TextDisabled), number.c_str());
  }
}

void bounceGrid(ImVec2 at, float left, float width, float height) {
  ImDrawList& list = *ImGui::GetWindowDrawList();
  for (int decade = 0; decade <= kBarDecades; ++decade) {
    const float y = std::round(at.y + height * static_cast<float>(decade) / kBarDecades);
    list.AddRectFilled({at.x + left, y}, {at.x + width, y + 1},
                       ImGui::GetColorU32(ImGuiCol_Text, decade == kBarDecades ? 0.35f : 0.12f));
    if (decade % 2 != 0) continue;
    const std::string text = percentText(std::pow(10.0, -decade));
    const ImVec2 size = ImGui::CalcTextSize(text.c_str());
    list.AddText({at.x + left - size.x - 5, y - (decade == 0 ? 0.25f : 0.5f) * size.y},
                 ImGui::GetColorU32(ImGuiCol_TextDisabled), text.c_str());
  }
}

void bounceChart(Viewer& viewer, const BounceLight& light, const ShownBounces& shown) {
  const float em = ImGui::GetFontSize(), height = kBarsHeight * em;
  const float width = std::floor(ImGui::GetContentRegionAvail().x), left = 3.4f * em;
  const ImVec2 at = ImGui::GetCursorScreenPos();
  const float slot = std::min((width - left) / static_cast<float>(light.power.size()), 2.4f * em);
  ImGui::InvisibleButton("##bounces", {width, height + 1.1f * em});
  const bool hovered = ImGui::IsItemHovered(), clicked = ImGui::IsItemClicked();
  bounceGrid(at, left, width, height);
  bounceBars(light.power, {at.x + left + 1, at.y}, slot, height, shown);
  if (!hovered) return;
  const float place = (ImGui::GetMousePos().x - at.x - left) / slot;
  if (place < 0 || place >= static_cast<float>(light.power.size())) return;
  const auto k = static_cast<std::size_t>(place);
  const bool known = k >= 1 && k <= light.received.size();
  tooltip(bounceText(light.power, k) +
          (known ? "\nClick: only the light up to this bounce. With Shift: this bounce alone" : ""));
  if (!clicked || !known) return;
  const bool alone = ImGui::GetIO().KeyShift;
  const bool off = shown.last == k && (shown.first == k) == alone;
  viewer.perform(alone ? "bounce-alone" : "bounces", off ? "all" : std::to_string(k));
}

void ratioLine(const SessionState& state, const std::vector<glm::dvec3>& power) {
  const glm::dvec3 now = power.back(), before = power[power.size() - 2];
  double ratio = 0;
  for (int c = 0; c < 3; ++c) ratio = std::max(ratio, before[c] > 0 ? now[c] / before[c] : 0);
  const auto largest = [](const glm::dvec3& x) { return std::max({x.x, x.y, x.z}); };
  std::string text = figureText(ratio);
  if (state.radius_upper.x < kNoBound) {
    text += " (radius " + figureText(largest(state.radius_lower)) + " to " +
            figureText(largest(state.radius_upper)) + ")";
  }
  line("Last ratio", text,
       "\u2211 A B_k / \u2211 A B_(k\u22121) of the last bounce k, its power over that of the one before, in "
       "the channel where it falls least. It "
       "tends to "
       "the spectral radius of M, which bounds bracket: what each further bounce leaves of the light");
}

void chooseBounces(Viewer& viewer, std::size_t known, std::uint32_t shown) {
  const bool alone = viewer.settings().view.light.oneBounce();
  label("Light",
        "Only the light of up to so many bounces, E + M E + ... + M^n E, where one is direct light; or of "
        "that bounce alone, M^n E [W/m\u00b2]");
  const int all = static_cast<int>(known) + 1;
  int n = shown == 0 ? all : static_cast<int>(shown);
  const std::string text = n == all ? "all light"
                           : alone  ? "bounce " + countText(shown) + " alone"
                                    : "up to " + countedText(shown, "bounce");
  if (ImGui::SliderInt("##bounces-shown", &n, 1, all, text.c_str(), ImGuiSliderFlags_NoInput))
    viewer.perform(alone ? "bounce-alone" : "bounces", n == all ? "all" : std::to_string(n));
  bool one = alone;
  ImGui::BeginDisabled(shown == 0);
  if (ImGui::Checkbox("This bounce alone", &one))
    viewer.perform(one ? "bounce-alone" : "bounces", std::to_string(shown));
  ImGui::EndDisabled();
  tooltip(
      "M^n E = B_n \u2212 B_(n\u22121) [W/m\u00b2], without what came before it, exposed for itself (L keeps "
      "an "
      "exposure). The slider, or a click on a bar with Shift, chooses the bounce");
}

}  // namespace

double bounceRatio(const std::vector<glm::dvec3>& power, std::size_t k) {
  const double before = sum(power[k - 1]);
  return before > 0 ? sum(power[k]) / before : 0;
}

std::string bounceText(const std::vector<glm::dvec3>& power, std::size_t k) {
  if (k == 0)
    return "B_0 = E, the light emitted: \u2211 A E = " + figureText(sum(power[0])) +
           " W over the three channels";
  const double emitted = sum(power[0]);
  const std::string n = std::to_string(k);
  return "Bounce " + n + ", B_" + n + (k == 1 ? " = M E: " : " = M" + superscript(k) + " E: ") +
         "\u2211 A B_" + n + " is " + percentText(emitted > 0 ? sum(power[k]) / emitted : 0) +
         " of the light emitted, " + figureText(bounceRatio(power, k)) + " times " +
         (k == 1 ? "E" : "bounce " + std::to_string(k - 1));
}

void bouncesSection(Viewer& viewer) {
  if (sectionOfLeft("Bounces", viewer.state())) bouncesContent(viewer);
}

void bouncesContent(Viewer& viewer) {
  const SessionState& state = viewer.state();
  if (!state.snapshot) {
    ImGui::TextDisabled("nothing yet");
    return;
  }
  const Snapshot& snapshot = *state.snapshot;
  const std::uint32_t shown = shownBounces(snapshot, viewer.ui().settings.view.light);
  const bool known = snapshot.bounce_light && snapshot.bounce_light->power.size() > 1;
  if (known) {
    const bool alone = viewer.settings().view.light.oneBounce();
    bounceChart(viewer, *snapshot.bounce_light, {alone ? shown : 0, shown});
    ratioLine(state, snapshot.bounce_light->power);
  }
  if (known && !snapshot.bounce_light->received.empty()) {
    chooseBounces(viewer, snapshot.bounce_light->received.size(), shown);
    return;
  }
  const std::string wait = bounceWaitText(state);
  dimmed(wait.empty() ? "Worked out when the solve rests" : wait + ".");
  if (wait.empty() || snapshot.bounce_wait.no_room) return;
  if (ImGui::Button("Compute them at rest")) viewer.perform("complete-bounces");
  tooltip("Computes what is missing once the solve rests, then the light of each bounce");
}

}  // namespace unshot
