#include "bench/frame_table.h"

#include <algorithm>
#include <cmath>
#include <string>

#include "base/clock.h"
#include "base/srgb.h"
#include "bench/text_table.h"
#include "support/live_viewer.h"

namespace unshot::bench {
namespace {

using testing_support::LiveViewer;

constexpr int kWidth = 1280, kHeight = 720;
constexpr int kRounds = 3;
constexpr double kLooksRight = 0.05;  // nRMSE of linear light

LiveViewer::Options cornellBox(std::uint64_t elements) {
  LiveViewer::Options options;
  options.scene = UNSHOT_SOURCE_DIR "/assets/cornell_box.obj";
  options.solve.elements = elements;
  options.width = kWidth;
  options.height = kHeight;
  return options;
}

/// The left button is held and the mouse goes to and fro, so that each frame has another camera.
class Drag {
 public:
  Drag() { ImGui::GetIO().MouseDown[0] = true; }
  ~Drag() { ImGui::GetIO().MouseDown[0] = false; }
  void move(LiveViewer& live) {
    const int there = ++steps_ % 120;
    ImGui::GetIO().MousePos = {300 + 2.0f * static_cast<float>(std::min(there, 120 - there)), 400};
    live->input();
  }

 private:
  int steps_ = 0;
};

struct Times {
  std::vector<double> seconds;
  double median() {
    std::nth_element(seconds.begin(), seconds.begin() + static_cast<std::ptrdiff_t>(seconds.size() / 2),
                     seconds.end());
    return seconds[seconds.size() / 2];
  }
  double worst() const { return *std::max_element(seconds.begin(), seconds.end()); }
  std::string text() { return figure("%.1f, ", 1e3 * median()) + figure("%.1f", 1e3 * worst()); }
};

struct Frames {
  Times answer;   ///< from a motion of the mouse to the end of the window's frame that knows of it
  Times picture;  ///< from the motion that a picture of the scene is of until a frame shows it
};

/// Rests, or lets the viewer work on the picture, until it is time to draw the window.
void untilFrame(LiveViewer& live) {
  for (;;) {
    const double now = wallSeconds(), next = live->nextFrame(now);
    if (next > now) {
      live.rest(next - now);
    } else if (live->prepare()) {
      return;
    }
    live->update(wallSeconds());
  }
}

/// Frames as fast as the viewer asks for them.
Frames dragFor(LiveViewer& live, double seconds) {
  Frames frames;
  double begin = wallSeconds();
  Drag drag;
  const double end = wallSeconds() + seconds;
  // The first ones open the drag; at least three count.
  for (int frame = -3; wallSeconds() < end || frames.picture.seconds.size() < 3; ++frame) {
    const glm::dvec3 shown = live->shownCamera().eye;
    const double start = wallSeconds();
    drag.move(live);
    if (!live->drawingScene()) begin = start;
    untilFrame(live);
    live.draw();
    if (frame < 0) continue;
    frames.answer.seconds.push_back(wallSeconds() - start);
    if (live->shownCamera().eye != shown) frames.picture.seconds.push_back(wallSeconds() - begin);
  }
  return frames;
}

/// Columns a second, counted where the session says so; `draw`: meanwhile frames are drawn.
double columnRate(LiveViewer& live, double seconds, bool draw, Frames* frames = nullptr) {
  live->update(wallSeconds());
  const double start = wallSeconds();
  const std::uint64_t before = live->state().measures.rows;
  if (draw) {
    *frames = dragFor(live, seconds);
  } else {
    while (wallSeconds() < start + seconds) live.rest(start + seconds - wallSeconds());
  }
  live->update(wallSeconds());
  return static_cast<double>(live->state().measures.rows - before) / (wallSeconds() - start);
}

struct Round {
  double alone = 0, meanwhile = 0;  // columns a second
  Frames solving, idle;

  /// Keeps the better of each: what other programs take away is not meant.
  void improve(Round other) {
    alone = std::max(alone, other.alone);
    meanwhile = std::max(meanwhile, other.meanwhile);
    for (Frames Round::*part : {&Round::solving, &Round::idle}) {
      if ((this->*part).answer.seconds.empty() ||
          (other.*part).answer.median() < (this->*part).answer.median())
        std::swap(this->*part, other.*part);
    }
  }
};

Round measureRound(LiveViewer& live, double seconds) {
  Round round;
  live->resume();
  live.until([&] { return live->state().phase != SessionPhase::kPaused; });
  round.alone = columnRate(live, seconds, false);
  round.meanwhile = columnRate(live, seconds, true, &round.solving);
  live->pause();
  live.untilPhase(SessionPhase::kPaused);
  round.idle = dragFor(live, seconds);
  return round;
}

std::vector<float> sceneLight(LiveViewer& live) {
  std::vector<std::uint8_t> pixels(4 * static_cast<std::size_t>(kWidth) * kHeight);
  live.fn().ReadPixels(0, 0, kWidth, kHeight, GL_RGBA, GL_UNSIGNED_BYTE, pixels.data());
  std::vector<float> light;
  const std::size_t scene_width = kWidth - 304;  // the rest is the panel
  for (std::size_t y = 0; y < kHeight; y += 2) {
    for (std::size_t x = 0; x < scene_width; x += 2) {
      for (std::size_t c = 0; c < 3; ++c)
        light.push_back(static_cast<float>(linearFromSrgb(pixels[4 * (y * kWidth + x) + c] / 255.0)));
    }
  }
  return light;
}

double difference(const std::vector<float>& a, const std::vector<float>& b) {
  double sum = 0, all = 0;
  for (std::size_t k = 0; k < b.size(); ++k) {
    sum += (a[k] - b[k]) * (a[k] - b[k]);
    all += b[k] * b[k];
  }
  return std::sqrt(sum / all);
}

struct Opening {
  double first = 0, looks_right = 0, converged = 0;
};

/// `look`: keeps a copy of each picture, which costs time; else only the moments are taken.
Opening openOnce(std::uint64_t elements, bool look) {
  struct Moment {
    double time;
    std::vector<float> light;
  };
  Opening out;
  std::vector<Moment> moments;
  const double start = wallSeconds();
  LiveViewer live(cornellBox(elements));
  const glm::dvec3 unframed = live->camera().eye;
  double own_work = 0;
  while (out.converged == 0 || live->nextFrame(0) < 1e30) {
    if (!live.pump()) {
      live.rest(std::clamp(live->nextFrame(wallSeconds()) - wallSeconds(), 0.0, 0.05));
      continue;
    }
    const double now = wallSeconds() - own_work;
    if (live->camera().eye == unframed) continue;
    if (out.first == 0) out.first = now - start;
    if (live->state().phase == SessionPhase::kConverged && out.converged == 0) out.converged = now - start;
    if (!look) continue;
    const double pause = wallSeconds();
    moments.push_back({now - start, sceneLight(live)});
    own_work += wallSeconds() - pause;
  }
  for (auto moment = moments.rbegin(); moment != moments.rend(); ++moment) {
    if (difference(moment->light, moments.back().light) > kLooksRight) break;
    out.looks_right = moment->time;
  }
  return out;
}

}  // namespace

void printFrameTable(const std::vector<std::uint64_t>& elements, double seconds) {
  std::printf("Frames of the viewer, %d x %d, Cornell box, the camera moving\n", kWidth, kHeight);
  std::printf(
      "(OSMesa; best of %d rounds of %g s; the solver keeps no columns, so that its rate is even. Share: of "
      "the columns a "
      "second\n that it computes where nothing is drawn.)\n\n",
      kRounds, seconds);
  std::printf(
      "Milliseconds, median and worst: from a motion of the mouse to the window's next frame (answer), and "
      "to the "
      "picture of\n the scene that follows it.\n\n");
  TextTable table({"elements", "triangles", "idle: answer", "picture", "solving: answer", "picture",
                   "pictures/s", "columns/s", "share"});
  for (const std::uint64_t count : elements) {
    LiveViewer::Options options = cornellBox(count);
    options.solve.error = 1e-9;
    options.solve.kept_bytes = 0;
    LiveViewer live(options);
    const glm::dvec3 unframed = live->camera().eye;
    live.until([&] { return live->camera().eye != unframed; });
    Round best;
    for (int round = 0; round < kRounds; ++round) best.improve(measureRound(live, seconds));
    const Mesh& mesh = *live->state().snapshot->mesh;
    table.add({std::to_string(mesh.element_count), std::to_string(mesh.triangle_element.size()),
               best.idle.answer.text(), best.idle.picture.text(), best.solving.answer.text(),
               best.solving.picture.text(),
               figure("%.0f", static_cast<double>(best.solving.picture.seconds.size()) / seconds),
               figure("%.0f", best.alone),
               best.alone > 0 ? figure("%.0f %%", 100 * best.meanwhile / best.alone) : "-"});
  }
  table.print();
}

void printOpeningTable(const std::vector<std::uint64_t>& elements) {
  std::printf("From opening the Cornell box on, in seconds (viewer on OSMesa, %d x %d)\n", kWidth, kHeight);
  std::printf(
      "(Looks right: from then on within %g %% nRMSE, linear, of the converged picture; copying pictures for "
      "that is not\n counted.)\n\n",
      100 * kLooksRight);
  TextTable table({"elements", "first picture", "looks right", "converged", "converged, nothing copied"});
  for (const std::uint64_t count : elements) {
    const Opening opening = openOnce(count, true), undisturbed = openOnce(count, false);
    table.add({std::to_string(count), figure("%.2f", opening.first), figure("%.2f", opening.looks_right),
               figure("%.2f", opening.converged), figure("%.2f", undisturbed.converged)});
  }
  table.print();
}

}  // namespace unshot::bench
