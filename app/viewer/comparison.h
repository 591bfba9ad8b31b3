// What the picture is compared with, and what part of the light it shows: chosen, loaded, and said over the
// scene.
#pragma once

#include <filesystem>
#include <memory>
#include <string>

#include "base/cancel.h"
#include "render/scene_view.h"
#include "session/session.h"
#include "viewer/panels/lower_edge.h"

namespace unshot {

/// What is shown of the snapshot, to be compared with later. Throws a usage Error where there is nothing.
std::shared_ptr<const ReferenceLight> rememberedLight(const SessionState& state, const LightChoice& choice);

/// A solution that `unshot solve --ply` wrote, of the same scene on any mesh, brought to the vertices of the
/// snapshot's mesh. Any thread. Throws Error (kInput) where it is another scene's or no PLY file, Cancelled.
std::shared_ptr<const ReferenceLight> loadedLight(const Snapshot& snapshot, const std::filesystem::path& ply,
                                                  const CancelToken& cancel = {});

/// How many bounces are shown, where that is a number and known; else 0.
std::uint32_t shownBounces(const Snapshot& snapshot, const LightChoice& choice);
/// What light by bounces waits for, as a sentence; empty where for nothing.
std::string bounceWaitText(const SessionState& state);

/// A scale of relative differences with its title, in a picture `room` wide [px]; `unit` says of what they
/// are parts.
void differenceScale(const std::string& title, const char* unit, float room);
/// Its width [px].
float differenceScaleWidth(float room);

/// What the display mode `difference` shows: what is subtracted from what.
std::string differenceTitle(const SessionState& state, const ViewOptions& view);

/// A line on the part of the light that is shown, or the colours of sides and normals, at the scene's lower
/// left; nothing for a picture of all light, nor where there is no room.
void buildLegend(const SessionState& state, const ViewOptions& view, LowerEdge& edge);

}  // namespace unshot
