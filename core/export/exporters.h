// The files that a solve can write: one row each. The key is the option of `unshot solve` that names the
// file.
#pragma once

#include <filesystem>
#include <functional>
#include <span>
#include <string>
#include <string_view>

#include "base/choice.h"
#include "base/diagnostic.h"
#include "base/image.h"
#include "export/probes.h"
#include "session/snapshot.h"

namespace unshot {

/// What exporters take from: the state, and what others make of it on demand.
struct ExportSource {
  const Snapshot& snapshot;
  bool with_ambient = false;
  double exposure = 1;  ///< the factor that makes radiosity 0..1 for 8-bit colours of vertices
  std::function<const Image8&()> picture;   ///< as displayed
  std::function<const ImageF&()> radiance;  ///< linear B [W/m^2] at the same pixels
  std::function<std::string()> report;      ///< JSON
  std::span<const Probe> probes;
  std::function<void(const Diagnostic&)> warn;
};

/// What an exporter wants of a picture.
enum class PictureNeed { kNoPicture, kDisplayed, kLinear };

struct Exporter {
  ChoiceInfo info;
  std::string_view ending;  ///< usual ending of the file's name, with its dot
  PictureNeed needs = PictureNeed::kNoPicture;
  /// Throws Error (kEnvironment where the file cannot be written, or what the source throws).
  void (*write)(const ExportSource& source, const std::filesystem::path& path) = nullptr;
};

std::span<const Exporter> exporters();

}  // namespace unshot
