// A temporary folder of its own for each test, and scenes written into it.
#pragma once

#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <string>
#include <string_view>

#include "base/error.h"
#include "scene/obj_reader.h"

namespace unshot {

class ObjFileTest : public ::testing::Test {
 protected:
  ObjFileTest() {
    const auto* info = ::testing::UnitTest::GetInstance()->current_test_info();
    folder_ = std::filesystem::temp_directory_path() /
              (std::string("unshot_") + info->name() + "_" + std::to_string(::getpid()));
    std::filesystem::create_directories(folder_);
  }
  ~ObjFileTest() override {
    std::error_code ignored;
    std::filesystem::remove_all(folder_, ignored);
  }

  std::filesystem::path write(const std::string& name, std::string_view text) const {
    std::ofstream(folder_ / name, std::ios::binary) << text;
    return folder_ / name;
  }

  Scene read(std::string_view obj) const { return readObj(write("scene.obj", obj)); }

  /// The error that reading ends with; an internal one with an empty text where it ends with a scene.
  Error failureOfFile(const std::filesystem::path& path) const {
    try {
      readObj(path);
    } catch (const Error& error) {
      return error;
    }
    ADD_FAILURE() << "no error for " << path;
    return Error(ErrorKind::kInternal, "");
  }
  Error failure(std::string_view obj) const { return failureOfFile(write("scene.obj", obj)); }

  std::filesystem::path folder_;
};

inline const Diagnostic* findDiagnostic(const Scene& scene, std::string_view code) {
  const auto found = std::find_if(scene.diagnostics.begin(), scene.diagnostics.end(),
                                  [&](const Diagnostic& d) { return d.code == code; });
  return found == scene.diagnostics.end() ? nullptr : &*found;
}

/// Expects a diagnostic of that code, once, whose message and place hold the given texts.
inline void expectDiagnostic(const Scene& scene, std::string_view code, std::string_view message,
                             std::string_view where) {
  const auto times = std::count_if(scene.diagnostics.begin(), scene.diagnostics.end(),
                                   [&](const Diagnostic& d) { return d.code == code; });
  ASSERT_EQ(times, 1) << code;
  const Diagnostic& found = *findDiagnostic(scene, code);
  EXPECT_NE(found.message.find(message), std::string::npos) << found.message;
  EXPECT_NE(found.where.find(where), std::string::npos) << found.where;
}

inline void expectNoDiagnostic(const Scene& scene, std::string_view code) {
  const Diagnostic* found = findDiagnostic(scene, code);
  EXPECT_EQ(found, nullptr) << (found ? found->message : "");
}

inline void expectInput(const Error& error, std::string_view message, std::string_view where) {
  EXPECT_EQ(error.kind(), ErrorKind::kInput) << error.what();
  EXPECT_NE(std::string_view(error.what()).find(message), std::string_view::npos) << error.what();
  EXPECT_NE(error.where().find(where), std::string::npos) << error.where();
  EXPECT_FALSE(error.advice().empty());
}

inline glm::dvec3 filePosition(const Scene& scene, const Polygon& polygon, std::uint32_t k) {
  return scene.frame_origin + scene.position(polygon, k);
}

inline void expectNear(const glm::dvec3& value, const glm::dvec3& expected, double tolerance = 1e-12) {
  for (int c = 0; c < 3; ++c) EXPECT_NEAR(value[c], expected[c], tolerance) << "component " << c;
}

}  // namespace unshot
