#include "formfactor/methods.h"

#include <algorithm>
#include <array>
#include <string>

namespace unshot {

bool nothingCanOcclude(const Mesh& mesh) {
  return std::none_of(mesh.surfaces.begin(), mesh.surfaces.end(), [](const Surface& s) { return s.between; });
}

std::span<const FormFactorMethodRow> formFactorMethods() {
  static const std::array<FormFactorMethodRow, 4> table{{
      {{"hemicube", "Hemicube",
        "pixels of a hemicube drawn with OpenGL, counted by exact delta form factors; the classic"},
       true,
       ReceiverKind::kElements,
       makeHemicube,
       [](const Mesh&) { return std::string(); }},
      {{"hemicube-visibility", "Hemicube visibility",
        "exact Lambert factors at the mesh's vertices, times whether a hemicube of the patch sees them"},
       true,
       ReceiverKind::kVertices,
       makeHemicubeVisibility,
       [](const Mesh&) { return std::string(); }},
      {{"rays", "Rays",
        "exact Lambert factors at the mesh's vertices, times what shadow rays find visible; no OpenGL"},
       false,
       ReceiverKind::kVertices,
       makeRays,
       [](const Mesh&) { return std::string(); }},
      {{"closed-form", "Closed form",
        "exact Lambert factors of polygons; for scenes in which nothing can occlude"},
       false,
       ReceiverKind::kVertices,
       makeClosedForm,
       [](const Mesh& mesh) {
         return nothingCanOcclude(mesh)
                    ? std::string()
                    : std::string(
                          "closed-form factors know no occlusion, and in this scene surfaces can "
                          "stand between others: shadows will be missing");
       }},
  }};
  return table;
}

}  // namespace unshot
