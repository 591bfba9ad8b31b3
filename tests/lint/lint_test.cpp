#include <gmock/gmock.h>

#include <cstdio>
#include <filesystem>
#include <fstream>
#include <iterator>

#include "lint/include_rules.h"

namespace unshot::lint {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;

bool isSource(const std::filesystem::path& path) {
  return path.extension() == ".h" || path.extension() == ".cpp";
}

/// Paths from the root, with slashes.
std::vector<std::string> sourcesOf(const std::vector<std::string>& folders) {
  const std::filesystem::path root = UNSHOT_SOURCE_DIR;
  std::vector<std::string> paths;
  for (const std::string& folder : folders) {
    for (const auto& entry : std::filesystem::recursive_directory_iterator(root / folder)) {
      if (isSource(entry.path()))
        paths.push_back(std::filesystem::relative(entry.path(), root).generic_string());
    }
  }
  return paths;
}

TEST(Includes, PointLeftOnlyAndThirdPartyHeadersStayAtHome) {
  Complaints complaints;
  const std::vector<std::string> paths = sourcesOf({"core", "app"});
  EXPECT_GT(paths.size(), 50u);
  for (const std::string& path : paths) {
    std::ifstream stream(std::filesystem::path(UNSHOT_SOURCE_DIR) / path);
    const std::string text(std::istreambuf_iterator<char>(stream), {});
    const Complaints found = checkIncludes({path, text});
    complaints.insert(complaints.end(), found.begin(), found.end());
  }
  EXPECT_THAT(complaints, IsEmpty());
}

TEST(Includes, TheRulesRefuseWhatIsWrong) {
  const auto complaints = [](const std::string& path, const std::string& line) {
    return checkIncludes({path, line});
  };
  EXPECT_THAT(complaints("core/base/a.h", "\n#include \"scene/scene.h\""),
              ElementsAre("core/base/a.h:2: base may not include scene"));
  EXPECT_THAT(complaints("core/mesh/a.cpp", "#include \"solver/modes.h\"").size(), 1u);
  EXPECT_THAT(complaints("core/export/a.cpp", "#include \"render/picture.h\"").size(), 1u);
  EXPECT_THAT(complaints("core/gl/a.cpp", "#include \"mesh/mesh.h\"").size(), 1u);
  EXPECT_THAT(complaints("core/solver/a.cpp", "# include \"gl/context.h\"").size(), 1u);
  EXPECT_THAT(complaints("core/formfactor/rays.cpp", "#include \"gl/context.h\"").size(), 1u);
  EXPECT_THAT(complaints("core/new_folder/a.cpp", "#include \"base/error.h\"").size(), 1u);
  EXPECT_THAT(complaints("core/report/a.cpp", "#include \"cli/text.h\"").size(), 1u);
  EXPECT_THAT(complaints("core/mesh/a.cpp", "#include <embree3/rtcore.h>").size(), 1u);
  EXPECT_THAT(complaints("core/session/a.cpp", "#include <nlohmann/json.hpp>").size(), 1u);
  EXPECT_THAT(complaints("app/main.cpp", "#include <CLI/CLI.hpp>").size(), 1u);
  EXPECT_THAT(complaints("app/cli/a.cpp", "#include <GL/gl.h>").size(), 1u);
  EXPECT_THAT(complaints("core/export/ply.cpp", "#include <stb_image.h>").size(), 1u);
}

TEST(Includes, TheRulesAllowWhatIsRight) {
  const auto complaints = [](const std::string& path, const std::string& line) {
    return checkIncludes({path, line});
  };
  EXPECT_THAT(complaints("core/session/a.cpp", "#include \"solver/modes.h\"\n#include \"gl/context.h\""),
              IsEmpty());
  EXPECT_THAT(complaints("core/formfactor/hemicube_picture.cpp", "#include \"gl/objects.h\""), IsEmpty());
  EXPECT_THAT(complaints("core/render/a.cpp",
                         "#include \"render/camera.h\"\n#include <glm/vec3.hpp>\n#include <vector>"),
              IsEmpty());
  EXPECT_THAT(complaints("core/rays/a.cpp", "#include <embree3/rtcore.h>"), IsEmpty());
  EXPECT_THAT(complaints("core/gl/functions.h", "#include <GL/glcorearb.h>"), IsEmpty());
  EXPECT_THAT(complaints("app/cli/a.cpp", "#include <CLI/CLI.hpp>\n#include \"render/picture.h\""),
              IsEmpty());
  EXPECT_THAT(complaints("core/base/a.h", "// #include \"scene/scene.h\""), IsEmpty());
}

/// Standard output and error of a shell command, and its status.
std::pair<std::string, int> shell(const std::string& command) {
  std::string output;
  FILE* pipe = ::popen((command + " 2>&1").c_str(), "r");
  if (!pipe) return {"", -1};
  char buffer[4096];
  for (std::size_t n; (n = std::fread(buffer, 1, sizeof buffer, pipe)) > 0;) output.append(buffer, n);
  return {output, ::pclose(pipe)};
}

/// clang-format lays code out a little differently from version to version; this is the one that Debian 12
/// has.
constexpr const char* kVersion = "version 14.";

TEST(Formatting, FollowsClangFormat) {
  if (shell("clang-format --version").first.find(kVersion) == std::string::npos) {
    GTEST_SKIP() << "clang-format " << kVersion << "x is not installed";
  }
  std::string command = "cd '" UNSHOT_SOURCE_DIR "' && clang-format --dry-run -Werror --ferror-limit=1";
  for (const std::string& path : sourcesOf({"core", "app", "tests"})) command += " '" + path + "'";
  const auto [output, status] = shell(command);
  EXPECT_EQ(status, 0) << output << "\ntry: clang-format -i on these files";
}

}  // namespace
}  // namespace unshot::lint
