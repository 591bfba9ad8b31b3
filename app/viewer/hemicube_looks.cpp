#include "viewer/hemicube_looks.h"

#include <cmath>
#include <utility>

#include "base/clock.h"
#include "formfactor/hemicube_choice.h"
#include "formfactor/hemicube_rays.h"
#include "formfactor/item_elements.h"
#include "formfactor/regions.h"
#include "render/patch_colours.h"

namespace unshot {

std::vector<double> HemicubeLook::shares() const {
  std::vector<double> out(mesh->patch_count + 1, 0.0);
  for (std::size_t k = 0; k < elements.size(); ++k) {
    const std::uint32_t seen = patchAt(k);
    out[seen == kNone ? mesh->patch_count : seen] += (*delta)[k];
  }
  return out;
}

struct HemicubeEye::Parts {
  Parts(const Mesh& mesh, const CancelToken& cancel)
      : rays(mesh, cancel),
        elements(mesh),
        delta(std::make_shared<const std::vector<double>>(deltaFormFactors(kLayout))),
        colours(std::make_shared<const std::vector<std::uint8_t>>(patchColours(mesh, cancel))) {}
  HemicubeRays rays;
  ItemElements elements;
  std::shared_ptr<const std::vector<double>> delta;
  std::shared_ptr<const std::vector<std::uint8_t>> colours;
};

HemicubeEye::HemicubeEye(std::shared_ptr<const Mesh> mesh, const CancelToken& cancel)
    : mesh_(std::move(mesh)), parts_(std::make_unique<Parts>(*mesh_, cancel)) {}

HemicubeEye::~HemicubeEye() = default;

HemicubeLook HemicubeEye::look(std::uint32_t patch) {
  const Region region = regionOfPatch(*mesh_, patch);
  const HemicubeFrame frame = turnedHemicube(*mesh_, region.surface, mesh_->sides[region.side], region.sample,
                                             1e-3 * std::sqrt(region.area), 1);
  const HemicubeView::Result seen = parts_->rays.look(frame, kLayout);
  HemicubeLook out{mesh_, patch, kLayout, {}, parts_->delta, parts_->colours};
  out.elements.reserve(seen.items.size());
  for (std::size_t k = 0; k < seen.items.size(); ++k) {
    const std::uint32_t element = parts_->elements.at(seen.items, kLayout, k);
    out.elements.push_back(element == ItemElements::kLost ? kNone : element);
  }
  return out;
}

HemicubeLooks::HemicubeLooks(std::function<void()> wake)
    : wake_(std::move(wake)), thread_([this](const std::stop_token& stop) { run(stop); }) {}

HemicubeLooks::~HemicubeLooks() {
  giveUp();
  const std::scoped_lock lock(mutex_);
  closing_ = true;
}

void HemicubeLooks::giveUp() {
  const std::scoped_lock lock(mutex_);
  wanted_.reset();
  given_up_ = true;
}

std::optional<double> HemicubeLooks::preparing() const {
  const std::scoped_lock lock(mutex_);
  return preparing_;
}

void HemicubeLooks::want(std::shared_ptr<const Mesh> mesh, std::uint32_t patch) {
  {
    const std::scoped_lock lock(mutex_);
    wanted_ = {std::move(mesh), patch};
  }
  arrived_.notify_all();
}

bool HemicubeLooks::pending() const {
  const std::scoped_lock lock(mutex_);
  return wanted_.has_value() || looking_;
}

std::shared_ptr<const HemicubeLook> HemicubeLooks::latest() const {
  const std::scoped_lock lock(mutex_);
  return latest_;
}

std::optional<Error> HemicubeLooks::problem() const {
  const std::scoped_lock lock(mutex_);
  return problem_;
}

void HemicubeLooks::run(const std::stop_token& stop) {
  std::optional<HemicubeEye> eye;
  for (;;) {
    Wanted wanted;
    {
      std::unique_lock lock(mutex_);
      if (!arrived_.wait(lock, stop, [&] { return wanted_.has_value(); })) return;
      wanted = *std::exchange(wanted_, std::nullopt);
      looking_ = true;
      given_up_ = closing_;
      // Meshes that differ in materials alone look the same.
      if (!eye || eye->mesh()->cut != wanted.mesh->cut) {
        preparing_ = wallSeconds();
        eye.reset();
      }
    }
    std::shared_ptr<const HemicubeLook> seen;
    std::optional<Error> problem;
    try {
      if (!eye) eye.emplace(wanted.mesh, CancelToken(given_up_));
      seen = std::make_shared<const HemicubeLook>(eye->look(wanted.patch));
    } catch (const Cancelled&) {
    } catch (...) {
      problem = presentError();
      eye.reset();
    }
    {
      const std::scoped_lock lock(mutex_);
      if (closing_) return;
      if (!given_up_) {
        latest_ = std::move(seen);
        problem_ = std::move(problem);
      }
      looking_ = false;
      preparing_.reset();
    }
    if (wake_) wake_();
  }
}

}  // namespace unshot
