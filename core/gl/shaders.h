// GLSL sources: embedded at build time, or read from a folder while developing them.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace unshot::gl {

struct EmbeddedShader {
  std::string_view name;  ///< file name, such as "display.vert"
  std::string source;
};

/// Every file of shaders/, sorted by name. Defined by a source that the build writes.
const std::vector<EmbeddedShader>& embeddedShaders();

/// Takes shaders from this folder where it holds them (--shader-dir); empty: the embedded ones only. Any
/// thread.
void setShaderDir(const std::filesystem::path& folder);

/// A shader with its includes in place, and where each of its lines came from.
struct ShaderText {
  struct Origin {
    std::string file;
    int line = 1;  ///< counted from 1
  };
  std::string text;
  std::vector<Origin> lines;  ///< one per line of text
};

/// Reads a shader; a line `#include "name.glsl"` is replaced by that file, once. Throws Error: kInput for an
/// unknown name.
ShaderText loadShader(std::string_view name);

/// loadShader(name).text.
std::string shaderSource(std::string_view name);

}  // namespace unshot::gl
