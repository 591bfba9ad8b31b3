#include "viewer/panels/plot.h"

#include <algorithm>
#include <cmath>

#include "viewer/panels/plot_axes.h"
#include "viewer/panels/plot_labels.h"

namespace unshot {
namespace {

// Numbers from their axis, in font sizes.
constexpr float kNumbersAway = 0.55f;
constexpr float kNumbersBelow = 0.25f;

/// The colour of a place in the style, as strong as `alpha`.
ImU32 styled(ImGuiCol place, float alpha = 1) { return ImGui::GetColorU32(place, alpha); }

float wholePixels(float value) { return std::max(1.0f, std::round(value)); }

/// One frame's picture of the curve.
class LogPlot {
 public:
  LogPlot(std::span<const PlotPoint> points, const PlotStyle& style, ImVec2 min, ImVec2 max);
  void draw(ImDrawList& list);
  /// The nearest point to the mouse, marked and described.
  void hover(ImDrawList& list, ImVec2 mouse) const;

 private:
  void arrange();
  void placeLabels();
  void placeInnerLabels();
  /// At the first of the places where no curve runs through it.
  struct Place {
    ImVec2 at, align;
  };
  void placeInside(const std::string& text, std::span<const Place> places, ImU32 colour);
  bool crosses(const std::vector<ImVec2>& curve, const PlotLabels::Label& label) const;
  ImU32 secondColour() const;
  void drawGrid(ImDrawList& list) const;
  void drawGoal(ImDrawList& list) const;
  void drawArea(ImDrawList& list) const;
  void drawLine(ImDrawList& list, const std::vector<ImVec2>& curve, ImU32 colour, float thickness) const;
  void drawSecond(ImDrawList& list) const;
  void drawBand(ImDrawList& list) const;
  void drawMarker(ImDrawList& list, ImVec2 at, ImU32 colour) const;

  float xOf(double x) const {
    const double part =
        (std::clamp(x, x_range_.low, x_range_.high) - x_range_.low) / (x_range_.high - x_range_.low);
    return static_cast<float>(left_ + part * (right_ - left_));
  }
  /// `at` is a logarithm.
  float yOf(double at) const {
    const double part = (at - y_range_.low) / (y_range_.high - y_range_.low);
    return static_cast<float>(bottom_ - part * (bottom_ - top_));
  }
  ImVec2 pixelOf(const PlotPoint& point) const { return {xOf(point.x), yOf(std::log10(point.y))}; }
  bool hasGoal() const { return style_.goal && isShown({0, *style_.goal}); }

  std::span<const PlotPoint> points_;
  const PlotStyle& style_;
  ImVec2 min_, max_;
  float em_ = ImGui::GetFontSize();
  float hair_ = wholePixels(em_ / 16);
  const PlotPoint* last_ = nullptr;  // that is shown
  AxisRange x_range_, y_range_;
  std::vector<Tick> x_ticks_, y_ticks_;
  std::vector<ImVec2> curve_, second_;  // in pixels
  // Of the area with the curve, on whole pixels.
  float left_ = 0, right_ = 0, top_ = 0, bottom_ = 0;
  PlotLabels labels_, inner_labels_;
};

std::vector<PlotPoint> together(std::span<const PlotPoint> a, std::span<const PlotPoint> b) {
  std::vector<PlotPoint> all(a.begin(), a.end());
  all.insert(all.end(), b.begin(), b.end());
  return all;
}

LogPlot::LogPlot(std::span<const PlotPoint> points, const PlotStyle& style, ImVec2 min, ImVec2 max)
    : points_(points),
      style_(style),
      min_(min),
      max_(max),
      x_range_(positionRange(together(points, style.second.points))),
      y_range_(valueRange(together(points, style.second.points), style.goal)),
      labels_(min, max, 0.2f * em_),
      inner_labels_(min, max, 0.2f * em_) {
  for (const PlotPoint& point : points) {
    if (isShown(point)) last_ = &point;
  }
  arrange();
  std::vector<ImVec2> pixels;
  pixels.reserve(points.size());
  for (const PlotPoint& point : points) {
    if (isShown(point)) pixels.push_back(pixelOf(point));
  }
  curve_ = thinnedOut(pixels);
  pixels.clear();
  for (const PlotPoint& point : style.second.points) {
    if (isShown(point)) pixels.push_back(pixelOf(point));
  }
  second_ = thinnedOut(pixels);
  placeLabels();
  placeInnerLabels();
}

void LogPlot::arrange() {
  // From top to bottom: a line of text, the area, the numbers of the axis, its label.
  const float below = (*style_.x_label ? 2.35f : 1.25f) * em_;
  top_ = std::floor(min_.y + 1.75f * em_);
  bottom_ = std::floor(std::max(top_ + 1, max_.y - below));
  y_ticks_ = valueTicks(y_range_, style_.percent, bottom_ - top_, em_);
  float numbers = 0;
  for (const Tick& tick : y_ticks_) numbers = std::max(numbers, ImGui::CalcTextSize(tick.text.c_str()).x);
  if (numbers > 0.5f * (max_.x - min_.x)) numbers = 0;
  left_ = std::floor(min_.x + numbers + kNumbersAway * em_);
  right_ = std::floor(std::max(left_ + 1, max_.x - 0.8f * em_));
  if (last_) {
    x_ticks_ = positionTicks(
        x_range_, {style_.x_unit, areWhole(points_)}, right_ - left_, 1.4 * em_,
        [](const std::string& text) { return static_cast<double>(ImGui::CalcTextSize(text.c_str()).x); });
  }
}

void LogPlot::placeLabels() {
  const ImU32 faint = styled(ImGuiCol_TextDisabled);
  labels_.place(style_.y_label, min_, {0, 0}, styled(ImGuiCol_Text));
  if (last_) {
    labels_.place(valueText(last_->y, style_.percent, 3), {max_.x, min_.y}, {1, 0},
                  styled(ImGuiCol_PlotLines));
  }
  const float numbers_right = left_ - kNumbersAway * em_;
  for (bool major : {true, false}) {
    for (const Tick& tick : y_ticks_) {
      if (tick.major != major) continue;
      labels_.place(tick.text, {numbers_right, yOf(tick.at)}, {1, 0.5f},
                    styled(ImGuiCol_TextDisabled, major ? 1 : 0.7f));
    }
  }
  for (const Tick& tick : x_ticks_) {
    // The first keeps clear of the numbers to its left.
    const float half = 0.5f * ImGui::CalcTextSize(tick.text.c_str()).x;
    const float x = std::max(xOf(tick.at), left_ - 0.3f * em_ + half);
    labels_.place(tick.text, {x, bottom_ + kNumbersBelow * em_}, {0.5f, 0}, faint);
  }
  labels_.place(style_.x_label, {0.5f * (left_ + right_), max_.y}, {0.5f, 1}, faint);
}

// Whether a curve runs through a text.
bool LogPlot::crosses(const std::vector<ImVec2>& curve, const PlotLabels::Label& label) const {
  for (std::size_t i = 1; i < curve.size(); ++i) {
    const ImVec2 a = curve[i - 1], b = curve[i];
    const float from = std::max(a.x, label.min.x - 0.4f * em_), to = std::min(b.x, label.max.x + 0.4f * em_);
    if (from > to) continue;
    const auto height = [&](float x) {
      return b.x > a.x ? a.y + (b.y - a.y) * (x - a.x) / (b.x - a.x) : b.y;
    };
    const auto [high, low] = std::minmax({height(from), height(to), b.x > a.x ? height(to) : a.y});
    if (high < label.max.y + 0.2f * em_ && low > label.min.y - 0.2f * em_) return true;
  }
  return false;
}

void LogPlot::placeInside(const std::string& text, std::span<const Place> places, ImU32 colour) {
  const float goal = hasGoal() ? yOf(std::log10(*style_.goal)) : -1;
  for (const Place& place : places) {
    const PlotLabels::Label label = inner_labels_.arranged(text, place.at, place.align, 0);
    const bool on_goal = hasGoal() && label.min.y < goal && label.max.y > goal;
    if (on_goal || crosses(curve_, label) || crosses(second_, label)) continue;
    if (inner_labels_.place(text, place.at, place.align, colour)) return;
  }
}

void LogPlot::placeInnerLabels() {
  inner_labels_ = PlotLabels({left_, top_}, {right_, bottom_}, 0);
  if (second_.size() > 1)
    inner_labels_.place(style_.second.label, {second_[0].x + 0.4f * em_, second_[0].y - 0.1f * em_}, {0, 1},
                        secondColour());
  const float away = 0.18f * em_;
  if (hasGoal()) {
    const float y = yOf(std::log10(*style_.goal));
    const float from_left = left_ + 0.6f * em_, from_right = right_ - 0.9f * em_;
    const Place places[] = {{{from_left, y - away}, {0, 1}},
                            {{from_left, y + away}, {0, 0}},
                            {{from_right, y - away}, {1, 1}},
                            {{from_right, y + away}, {1, 0}}};
    placeInside("goal " + shortValueText(*style_.goal, style_.percent), places, styled(ImGuiCol_Text, 0.75f));
  }
  if (curve_.size() < 2 || !*style_.name) return;
  // At its end, or else on either side further left.
  std::vector<Place> places = {{{curve_.back().x, curve_.back().y - 0.7f * em_}, {1, 1}},
                               {{curve_.back().x, curve_.back().y + 0.7f * em_}, {1, 0}}};
  for (const std::size_t part : {2, 4, 1, 3}) {
    const ImVec2 at = curve_[part * (curve_.size() - 1) / 5];
    places.push_back({{at.x + 0.5f * em_, at.y - 0.3f * em_}, {0, 1}});
    places.push_back({{at.x - 0.5f * em_, at.y + 0.3f * em_}, {1, 0}});
  }
  placeInside(style_.name, places, styled(ImGuiCol_PlotLines));
}

ImU32 LogPlot::secondColour() const {
  ImVec4 colour = style_.second.colour;
  if (!style_.second.equal) colour.w *= 0.65f;
  return ImGui::GetColorU32(colour);
}

void LogPlot::drawGrid(ImDrawList& list) const {
  list.AddRectFilled({left_, top_}, {right_, bottom_ + hair_}, IM_COL32(0, 0, 0, 64));
  for (const Tick& tick : y_ticks_) {
    const float y = std::round(yOf(tick.at));
    const float strength = tick.major && !tick.text.empty() ? 0.17f : 0.055f;
    list.AddRectFilled({left_, y}, {right_, y + hair_}, styled(ImGuiCol_Text, strength));
  }
  for (const Tick& tick : x_ticks_) {
    const float x = std::min(std::round(xOf(tick.at)), right_ - hair_);
    list.AddRectFilled({x, top_}, {x + hair_, bottom_}, styled(ImGuiCol_Text, 0.055f));
    list.AddRectFilled({x, bottom_}, {x + hair_, bottom_ + std::round(kNumbersBelow * em_)},
                       styled(ImGuiCol_Text, 0.35f));
  }
  list.AddRectFilled({left_, bottom_}, {right_, bottom_ + hair_}, styled(ImGuiCol_Text, 0.35f));
}

void LogPlot::drawGoal(ImDrawList& list) const {
  if (!hasGoal()) return;
  const float y = std::round(yOf(std::log10(*style_.goal)));
  const float dash = wholePixels(0.4f * em_), gap = wholePixels(0.27f * em_);
  for (float x = left_; x < right_; x += dash + gap) {
    list.AddRectFilled({x, y}, {std::min(x + dash, right_), y + hair_}, styled(ImGuiCol_Text, 0.6f));
  }
}

// The soft area under the curve, fading towards the axis.
void LogPlot::drawArea(ImDrawList& list) const {
  if (curve_.size() < 2) return;
  const int count = static_cast<int>(curve_.size());
  const ImVec2 white = ImGui::GetFontTexUvWhitePixel();
  const float height = bottom_ - top_;
  list.PrimReserve(6 * (count - 1), 2 * count);
  const unsigned int first = list._VtxCurrentIdx;
  for (const ImVec2& p : curve_) {
    const float up = std::clamp((bottom_ - p.y) / height, 0.0f, 1.0f);
    list.PrimWriteVtx(p, white, styled(ImGuiCol_PlotLines, 0.03f + 0.30f * up));
    list.PrimWriteVtx({p.x, bottom_}, white, styled(ImGuiCol_PlotLines, 0.03f));
  }
  for (int i = 0; i + 1 < count; ++i) {
    const unsigned int at = first + 2 * static_cast<unsigned int>(i);
    for (unsigned int corner : {0u, 2u, 3u, 0u, 3u, 1u})
      list.PrimWriteIdx(static_cast<ImDrawIdx>(at + corner));
  }
}

// A sharp turn begins a new piece: mitres of sharp corners would be long spikes.
void LogPlot::drawLine(ImDrawList& list, const std::vector<ImVec2>& curve, ImU32 colour,
                       float thickness) const {
  const auto piece = [&](std::size_t begin, std::size_t end) {
    list.AddPolyline(&curve[begin], static_cast<int>(end - begin), colour, 0, thickness);
  };
  std::size_t begin = 0;
  for (std::size_t i = 1; i + 1 < curve.size(); ++i) {
    const ImVec2 in{curve[i].x - curve[i - 1].x, curve[i].y - curve[i - 1].y};
    const ImVec2 out{curve[i + 1].x - curve[i].x, curve[i + 1].y - curve[i].y};
    const float cosine = in.x * out.x + in.y * out.y;
    if (cosine > 0.3f * std::sqrt((in.x * in.x + in.y * in.y) * (out.x * out.x + out.y * out.y))) continue;
    piece(begin, i + 1);
    begin = i;
  }
  if (curve.size() > begin + 1) piece(begin, curve.size());
}

// Down to the bottom where the lower end is 0 or not known. Without smoothed edges: pieces that touch would
// show their seams.
void LogPlot::drawBand(ImDrawList& list) const {
  const PlotCurve& second = style_.second;
  if (second.low.size() != second.points.size()) return;
  ImVec4 colour = second.colour;
  colour.w *= 0.15f;
  const ImU32 packed = ImGui::GetColorU32(colour);
  const ImVec2 white = ImGui::GetFontTexUvWhitePixel();
  std::vector<ImVec2> ends;  // high and low by turns, one pair a column of pixels
  const auto draw = [&] {
    const int pairs = static_cast<int>(ends.size() / 2);
    if (pairs > 1) {
      list.PrimReserve(6 * (pairs - 1), 2 * pairs);
      const unsigned int first = list._VtxCurrentIdx;
      for (const ImVec2& end : ends) list.PrimWriteVtx(end, white, packed);
      for (unsigned int at = first; at + 2 < first + 2 * static_cast<unsigned int>(pairs); at += 2) {
        for (unsigned int corner : {0u, 2u, 3u, 0u, 3u, 1u})
          list.PrimWriteIdx(static_cast<ImDrawIdx>(at + corner));
      }
    }
    ends.clear();
  };
  for (std::size_t i = 0; i < second.points.size(); ++i) {
    if (!isShown(second.points[i])) {
      draw();
      continue;
    }
    const ImVec2 high = pixelOf(second.points[i]);
    const float low = isShown(second.low[i]) ? std::min(pixelOf(second.low[i]).y, bottom_) : bottom_;
    if (!ends.empty() && high.x < ends.back().x + 1 && i + 1 < second.points.size()) continue;
    ends.push_back(high);
    ends.push_back({high.x, low});
  }
  draw();
}

void LogPlot::drawSecond(ImDrawList& list) const {
  if (second_.size() < 2) return;
  const PlotCurve& second = style_.second;
  drawLine(list, second_, secondColour(), wholePixels(em_ / (second.equal ? 7.5f : 12.0f)));
}

void LogPlot::drawMarker(ImDrawList& list, ImVec2 at, ImU32 colour) const {
  list.AddCircleFilled(at, 0.58f * em_, styled(ImGuiCol_PlotLines, 0.20f));
  list.AddCircleFilled(at, 0.34f * em_, styled(ImGuiCol_WindowBg));
  list.AddCircleFilled(at, 0.24f * em_, colour);
}

void LogPlot::draw(ImDrawList& list) {
  drawGrid(list);
  drawArea(list);
  drawGoal(list);
  drawBand(list);
  drawSecond(list);
  drawLine(list, curve_, styled(ImGuiCol_PlotLines), wholePixels(em_ / 7.5f));
  labels_.draw(list);
  inner_labels_.draw(list);
  if (last_) {
    drawMarker(list, pixelOf(*last_), styled(ImGuiCol_PlotLines));
  } else {
    PlotLabels empty({left_, top_}, {right_, bottom_}, 0);
    empty.place("no values yet", {0.5f * (left_ + right_), 0.5f * (top_ + bottom_)}, {0.5f, 0.5f},
                styled(ImGuiCol_TextDisabled));
    empty.draw(list);
  }
}

void LogPlot::hover(ImDrawList& list, ImVec2 mouse) const {
  const PlotPoint* nearest = nullptr;
  float least = 0;
  for (const PlotPoint& point : points_) {
    if (!isShown(point)) continue;
    const ImVec2 at = pixelOf(point);
    // The column decides, the height only between points of one column.
    const float distance = std::abs(at.x - mouse.x) + 1e-3f * std::abs(at.y - mouse.y);
    if (nearest && distance >= least) continue;
    nearest = &point;
    least = distance;
  }
  if (!nearest) return;
  const ImVec2 at = pixelOf(*nearest);
  const ImU32 cross = styled(ImGuiCol_Text, 0.4f);
  const float x = std::round(at.x), y = std::round(at.y);
  list.AddRectFilled({x, top_}, {x + hair_, bottom_}, cross);
  list.AddRectFilled({left_, y}, {right_, y + hair_}, cross);
  drawMarker(list, at, styled(ImGuiCol_PlotLinesHovered));
  ImGui::BeginTooltip();
  ImGui::PushStyleColor(ImGuiCol_Text, styled(ImGuiCol_PlotLines));
  const std::string name = *style_.name ? std::string(style_.name) + " " : std::string();
  ImGui::TextUnformatted((name + valueText(nearest->y, style_.percent, 3)).c_str());
  ImGui::PopStyleColor();
  const std::string unit = *style_.x_unit ? style_.x_unit : style_.x_label;
  ImGui::TextDisabled("%s", positionText(nearest->x, unit).c_str());
  ImGui::EndTooltip();
}

}  // namespace

void logPlot(const char* id, std::span<const PlotPoint> points, const PlotStyle& style) {
  const float width = std::floor(std::max(1.0f, ImGui::GetContentRegionAvail().x));
  const float height = std::max(1.0f, std::floor(style.height > 0 ? style.height : width * 5 / 9));
  const ImVec2 min = ImGui::GetCursorScreenPos();
  const ImVec2 max{min.x + width, min.y + height};
  ImGui::InvisibleButton(id, {width, height});
  if (!ImGui::IsItemVisible()) return;
  ImDrawList& list = *ImGui::GetWindowDrawList();
  list.PushClipRect(min, max, true);
  LogPlot plot(points, style, min, max);
  plot.draw(list);
  if (ImGui::IsItemHovered()) plot.hover(list, ImGui::GetMousePos());
  list.PopClipRect();
}

}  // namespace unshot
