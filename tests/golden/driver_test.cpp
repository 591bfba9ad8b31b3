// Machines whose OpenGL is missing or too old: what needs none works, what needs it says so before any work.
#include <gmock/gmock.h>

#include "support/run_program.h"
#include "support/scenes.h"

namespace unshot {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::Not;
using testing_support::boxObj;
using testing_support::ProgramResult;
using testing_support::runProgram;
using testing_support::TempFolder;
using testing_support::writeRoom;

/// How a machine lacks OpenGL: an environment variable, and what is said then of each provider.
struct Lack {
  const char* name;
  const char* variable;
  const char* value;  ///< null: a folder of files that are no libraries
  const char* osmesa;
  const char* egl;
};

void PrintTo(const Lack& lack, std::ostream* out) { *out << lack.name; }

class Driver : public testing::TestWithParam<Lack> {
 protected:
  Driver() {
    writeRoom(folder_, boxObj());
    for (const char* name : {"libOSMesa.so.8", "libOSMesa.so.6", "libOSMesa.so", "libEGL.so.1", "libEGL.so"})
      libraries_.write(name, "no library");
    const std::string value = GetParam().value ? GetParam().value : libraries_.path().string();
    ::setenv(GetParam().variable, value.c_str(), 1);
  }
  ~Driver() override { ::unsetenv(GetParam().variable); }

  /// Runs it in vain; returns what it said.
  std::string refused(const std::vector<std::string>& words) {
    const std::set<std::string> before = folder_.names();
    const ProgramResult result = runProgram(folder_, words);
    EXPECT_EQ(result.code, 4) << result.err;
    EXPECT_EQ(result.out, "");
    EXPECT_THAT(result.err, AllOf(HasSubstr("\n  try: "), HasSubstr("apt-get install ")));
    EXPECT_EQ(folder_.names(), before);
    return result.err;
  }

  TempFolder folder_, libraries_;
};

TEST_P(Driver, WhatNeedsNoOpenGlWorks) {
  const ProgramResult result =
      runProgram(folder_, {"solve", "room.obj", "--elements", "100", "--form-factors", "rays", "--ply",
                           "a.ply", "--save", "s.unshot"});
  EXPECT_EQ(result.code, 0) << result.err;
  EXPECT_EQ(runProgram(folder_, {"check", "room.obj"}).code, 0);
}

TEST_P(Driver, WhatNeedsItSaysWhatIsMissing) {
  const std::vector<std::string> picture{"solve", "room.obj", "--elements", "100", "--png", "a.png"};
  const std::string said = refused(picture);
  EXPECT_THAT(said, AllOf(HasSubstr("no OpenGL 3.3 context can be made here"), HasSubstr(GetParam().osmesa),
                          HasSubstr(GetParam().egl)));
  EXPECT_THAT(said, Not(HasSubstr("meshing"))) << "work was done";
  EXPECT_THAT(refused({"solve", "room.obj", "--elements", "100", "--png", "a.png", "--gl", "osmesa"}),
              HasSubstr("the GL provider 'osmesa' gives no context: "));
  EXPECT_THAT(refused({"solve", "room.obj", "--elements", "100", "--ply", "a.ply", "--form-factors",
                       "hemicube", "--gl", "egl"}),
              HasSubstr("the GL provider 'egl' gives no context: "));
  folder_.write("script.txt", "wait converged\nscreenshot a.png\n");
  refused({"view", "room.obj", "--gl", "osmesa", "--script", "script.txt"});
}

INSTANTIATE_TEST_SUITE_P(Gl, Driver,
                         testing::Values(Lack{"NoLibraries", "LD_LIBRARY_PATH", nullptr,
                                              "/libOSMesa.so.8: file too short",
                                              "/libEGL.so.1: file too short"},
                                         Lack{"TooOld", "MESA_GL_VERSION_OVERRIDE", "2.1",
                                              "osmesa: OSMesa refuses an OpenGL 3.3 core context",
                                              "egl: EGL: no OpenGL 3.3 core context"}),
                         [](const auto& row) { return std::string(row.param.name); });

}  // namespace
}  // namespace unshot
