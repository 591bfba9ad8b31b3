#include "gl/shaders.h"

#include <algorithm>
#include <fstream>
#include <mutex>
#include <sstream>

#include "base/error.h"

namespace unshot::gl {
namespace {

// Process-wide, since it says where the program's own parts are: set once from the command line.
struct ShaderDir {
  std::mutex mutex;
  std::filesystem::path folder;
};

ShaderDir& shaderDir() {
  static ShaderDir dir;
  return dir;
}

std::string readFile(std::string_view name, const std::string& included_from) {
  std::filesystem::path folder;
  {
    const std::scoped_lock lock(shaderDir().mutex);
    folder = shaderDir().folder;
  }
  if (!folder.empty()) {
    std::ifstream file(folder / name, std::ios::binary);
    if (file) {
      std::ostringstream text;
      text << file.rdbuf();
      return text.str();
    }
  }
  for (const EmbeddedShader& shader : embeddedShaders()) {
    if (shader.name == name) return shader.source;
  }
  throw Error(ErrorKind::kInput, "there is no shader '" + std::string(name) + "'", included_from);
}

// The name in a line `#include "name"`, or empty.
std::string includedName(const std::string& line) {
  static constexpr std::string_view kInclude = "#include";
  const std::size_t begin = line.find_first_not_of(" \t");
  if (begin == std::string::npos || line.compare(begin, kInclude.size(), kInclude) != 0) return {};
  const std::size_t open = line.find('"', begin);
  const std::size_t close = open == std::string::npos ? open : line.find('"', open + 1);
  return close == std::string::npos ? std::string() : line.substr(open + 1, close - open - 1);
}

void append(ShaderText& shader, std::vector<std::string>& seen, const std::string& name,
            const std::string& included_from) {
  if (std::find(seen.begin(), seen.end(), name) != seen.end()) return;
  seen.push_back(name);
  std::istringstream source(readFile(name, included_from));
  std::string line;
  for (int number = 1; std::getline(source, line); ++number) {
    const std::string include = includedName(line);
    if (include.empty()) {
      shader.text += line + '\n';
      shader.lines.push_back({name, number});
    } else {
      append(shader, seen, include, name + ':' + std::to_string(number));
    }
  }
}

}  // namespace

void setShaderDir(const std::filesystem::path& folder) {
  if (!folder.empty() && !std::filesystem::is_directory(folder)) {
    throw Error(ErrorKind::kUsage, "the shader folder does not exist", folder.string());
  }
  const std::scoped_lock lock(shaderDir().mutex);
  shaderDir().folder = folder;
}

ShaderText loadShader(std::string_view name) {
  ShaderText shader;
  std::vector<std::string> seen;
  append(shader, seen, std::string(name), {});
  return shader;
}

std::string shaderSource(std::string_view name) { return loadShader(name).text; }

}  // namespace unshot::gl
