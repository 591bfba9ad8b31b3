#include "session/bounces.h"

#include "session/fields.h"

namespace unshot {
namespace {

// Fields for display take no more than this together [bytes]: on a mesh of a million elements those of the
// first four or five bounces.
constexpr std::size_t kMostBytes = 128u << 20;

std::size_t bytesOf(const MeshField& field) {
  return (field.vertices.size() + field.elements.size()) * sizeof(glm::vec3);
}

}  // namespace

Bounces::Bounces(std::shared_ptr<const Mesh> mesh, Transport& transport, const RadiosityState& state)
    : mesh_(std::move(mesh)), transport_(transport), series_(transport, state) {}

void Bounces::follow() {
  if (series_.follow()) light_.reset();
}

bool Bounces::hasWork(bool compute) {
  follow();
  if (series_.done()) return false;
  return series_.missing().empty() || (compute && !no_room_);
}

bool Bounces::advance(bool compute) {
  follow();
  const std::vector<std::uint32_t> missing = series_.missing();
  if (!missing.empty()) {
    if (!compute || no_room_) return false;
    transport_.column(missing.front());
    no_room_ = !transport_.isKept(missing.front());
    return true;
  }
  if (!series_.advance()) return false;
  const std::size_t known = series_.powers().size() - 1;
  if (known == 1) {
    received_.clear();
    bytes_ = 0;
  }
  if (received_.size() + 1 == known && bytes_ < kMostBytes) {
    received_.push_back(
        std::make_shared<const MeshField>(makeField(*mesh_, transport_.receivers(), series_.received())));
    bytes_ += bytesOf(*received_.back());
  }
  return true;
}

std::shared_ptr<const BounceLight> Bounces::light() {
  follow();
  if (series_.powers().size() < 2) return light_ = nullptr;
  if (!light_ || light_->power.size() != series_.powers().size())
    light_ = std::make_shared<const BounceLight>(BounceLight{series_.powers(), received_});
  return light_;
}

BounceWait Bounces::wait() { return {series_.missing().size(), no_room_}; }

}  // namespace unshot
