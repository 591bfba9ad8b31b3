#include "render/light_fields.h"

#include <algorithm>
#include <utility>

namespace unshot {
namespace {

bool isOfElements(LightField field) {
  return field == LightField::kElementIrradiance || field == LightField::kElementDirect;
}

// Whether snapshots have it by a pointer, which stays the same while its values do.
bool isShared(LightField field) {
  return field == LightField::kDirect || field == LightField::kElementDirect ||
         field == LightField::kBounces || field == LightField::kResidual;
}

}  // namespace

LightFields::LightFields(gl::Context& context) {
  for (std::size_t i = 0; i < kLightFields; ++i) {
    Copy copy;
    copy.buffer = gl::Buffer(context);
    if (isOfElements(static_cast<LightField>(i))) copy.texture = gl::Texture(context);
    copies_.push_back(std::move(copy));
  }
}

LightFields::Values LightFields::valuesOf(const std::shared_ptr<const Snapshot>& snapshot, LightField field) {
  switch (field) {
    case LightField::kIrradiance:
      return {snapshot, &snapshot->irradiance};
    case LightField::kDirect:
      return snapshot->direct;
    case LightField::kAmbient:
      return {snapshot, &snapshot->ambient};
    case LightField::kUnshot:
      return {snapshot, &snapshot->unshot};
    case LightField::kBounces:
      return snapshot->bounces;
    case LightField::kResidual:
      return snapshot->residual;
    case LightField::kElementIrradiance:
      return {snapshot, &snapshot->element_irradiance};
    case LightField::kElementDirect:
      return snapshot->element_direct;
  }
  return nullptr;
}

void LightFields::setSnapshot(std::shared_ptr<const Snapshot> snapshot) {
  const bool same_cut = snapshot_ && snapshot_->mesh->cut == snapshot->mesh->cut;
  // Where fields were given up half way, it is not known what is there.
  const bool known = same_cut && uploads_.done();
  uploads_.clear();
  for (std::size_t i = 0; i < kLightFields; ++i) {
    const auto field = static_cast<LightField>(i);
    Copy& copy = copies_[i];
    copy.begun = copy.begun && known && isShared(field) && copy.of == valuesOf(snapshot, field);
    if (!copy.begun) copy.of = nullptr;
    copy.has_room = copy.has_room && same_cut;
  }
  snapshot_ = std::move(snapshot);
}

void LightFields::begin(const LightFieldSet& wanted) {
  for (std::size_t i = 0; i < kLightFields; ++i) {
    const auto field = static_cast<LightField>(i);
    Copy& copy = copies_[i];
    if (copy.begun || !wanted.has(field)) continue;
    const bool of_elements = isOfElements(field);
    const std::size_t count = of_elements ? snapshot_->mesh->element_count : snapshot_->mesh->vertices.size();
    if (!copy.has_room) {
      const std::size_t stride = of_elements ? sizeof(glm::vec4) : sizeof(glm::vec3);
      allocate(copy.buffer, std::max<std::size_t>(count, 1) * stride, GL_DYNAMIC_DRAW);
      if (of_elements) attachTexels(copy.texture, GL_RGBA32F, copy.buffer);
      copy.has_room = true;
    }
    const Values values = valuesOf(snapshot_, field);
    if (of_elements) {
      uploads_.add<glm::vec4>(copy.buffer, count, finiteValues<glm::vec4>(values));
    } else {
      uploads_.add<glm::vec3>(copy.buffer, count, finiteValues<glm::vec3>(values));
    }
    copy.begun = true;
    if (isShared(field)) copy.of = values;
  }
}

}  // namespace unshot
