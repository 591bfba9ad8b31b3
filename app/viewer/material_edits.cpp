#include "viewer/material_edits.h"

#include <string>
#include <utility>

#include "base/error.h"

namespace unshot {
namespace {

constexpr std::size_t kMostUndone = 200;
// Of the first light in a scene without any [W/m^2].
constexpr double kFirstLight = 10;

}  // namespace

void MaterialEdits::begin(Materials materials) {
  now_ = opened_ = std::move(materials);
  before_.clear();
  after_.clear();
  saved_.clear();
  gesture_.reset();
  last_emission_.clear();
  for (const Material& m : now_) last_emission_.push_back(m.emission);
}

std::size_t MaterialEdits::find(std::string_view name) const {
  std::string names;
  for (std::size_t m = 0; m < now_.size(); ++m) {
    if (now_[m].name == name) return m;
    names += (names.empty() ? "" : ", ") + now_[m].name;
  }
  throw Error(ErrorKind::kUsage, "the scene has no material '" + std::string(name) + "'", {},
              names.empty() ? "a scene, first" : "one of: " + names);
}

void MaterialEdits::remember(std::optional<double> gesture) {
  after_.clear();
  if (gesture && gesture == gesture_) return;
  gesture_ = gesture;
  before_.push_back(now_);
  if (before_.size() > kMostUndone) before_.erase(before_.begin());
}

void MaterialEdits::setReflectance(std::size_t material, const glm::dvec3& rho,
                                   std::optional<double> gesture) {
  if (now_.at(material).reflectance == rho) return;
  remember(gesture);
  now_[material].reflectance = rho;
}

void MaterialEdits::setEmission(std::size_t material, const glm::dvec3& e, std::optional<double> gesture) {
  if (now_.at(material).emission == e) return;
  remember(gesture);
  now_[material].emission = e;
  if (now_[material].emits()) last_emission_[material] = e;
}

void MaterialEdits::setLight(std::size_t material, bool on) {
  if (on == now_.at(material).emits()) return;
  setEmission(material, on ? usualEmission(material) : glm::dvec3(0.0));
}

glm::dvec3 MaterialEdits::usualEmission(std::size_t material) const {
  if (last_emission_[material] != glm::dvec3(0.0)) return last_emission_[material];
  glm::dvec3 sum(0.0);
  double lights = 0;
  for (const Material& m : now_) {
    if (!m.emits()) continue;
    sum += m.emission;
    ++lights;
  }
  return lights > 0 ? sum / lights : glm::dvec3(kFirstLight);
}

void MaterialEdits::undo() {
  if (before_.empty()) return;
  after_.push_back(std::exchange(now_, std::move(before_.back())));
  before_.pop_back();
  gesture_.reset();
}

void MaterialEdits::redo() {
  if (after_.empty()) return;
  before_.push_back(std::exchange(now_, std::move(after_.back())));
  after_.pop_back();
  gesture_.reset();
}

void MaterialEdits::reset() {
  if (!edited()) return;
  remember({});
  now_ = opened_;
}

void MaterialEdits::adopt(Materials materials) {
  if (materials.size() != now_.size()) return begin(std::move(materials));
  now_ = std::move(materials);
  gesture_.reset();
}

}  // namespace unshot
