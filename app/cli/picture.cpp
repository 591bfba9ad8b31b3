#include "cli/picture.h"

#include <vector>

#include "base/colour.h"
#include "render/exposure.h"

namespace unshot {

const Picture& PictureMaker::get() {
  if (!picture_) picture_ = renderPicture(context_.get(), snapshot_, options_);
  return *picture_;
}

double vertexExposure(const Snapshot& snapshot, bool with_ambient) {
  const Mesh& mesh = *snapshot.mesh;
  std::vector<glm::vec4> values(mesh.vertices.size());
  for (std::size_t v = 0; v < values.size(); ++v) {
    const bool lamp = luminance(mesh.sides[mesh.vertices[v].side].emission) > 0;
    values[v] =
        glm::vec4(glm::vec3(radiosity(snapshot, v, with_ambient)), lamp ? kEmitterPixel : kSurfacePixel);
  }
  return automaticExposure(values);
}

}  // namespace unshot
