// `unshot selftest` on the command line.
#include <gmock/gmock.h>

#include <cstdlib>
#include <nlohmann/json.hpp>

#include "support/run_program.h"

namespace unshot {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::StartsWith;
using testing_support::ProgramResult;
using testing_support::runProgram;
using testing_support::TempFolder;

TEST(Selftest, PrintsATableAndASummary) {
  const TempFolder folder;
  const ProgramResult result = runProgram(folder, {"selftest", "--case", "one-triangle"});
  EXPECT_EQ(result.code, 0);
  EXPECT_THAT(result.err, IsEmpty());
  EXPECT_THAT(result.out, StartsWith("case "));
  for (const char* word :
       {"expected", "got", "error", "tolerance", "verdict", "\none-triangle ", " exact ", " pass\n",
        "\n1 of 1 solve within tolerance, 0 known exceptions, 0 refused, 0 failed\n"}) {
    EXPECT_THAT(result.out, HasSubstr(word));
  }
  EXPECT_THAT(folder.names(), IsEmpty());
}

TEST(Selftest, TriesEveryModeWhereAsked) {
  const ProgramResult result =
      runProgram(TempFolder(), {"selftest", "--case", "one-triangle", "--mode", "all", "--json"});
  EXPECT_EQ(result.code, 0);
  const nlohmann::json json = nlohmann::json::parse(result.out);
  std::vector<std::string> modes;
  for (const auto& row : json.at("results")) {
    modes.push_back(row.at("mode"));
    EXPECT_EQ(row.at("got"), 1);
    EXPECT_EQ(row.at("verdict"), "pass");
  }
  EXPECT_THAT(modes, ElementsAre("southwell", "kept-first", "overshoot", "jacobi", "gauss-seidel",
                                 "chebyshev", "conjugate-gradient", "gmres", "direct"));
}

TEST(Selftest, SaysWhatIsNotForAScene) {
  const ProgramResult result =
      runProgram(TempFolder(), {"selftest", "--case", "fins", "--form-factors", "closed-form"});
  EXPECT_EQ(result.code, 0);
  EXPECT_THAT(result.out, HasSubstr(" refused\n  closed-form factors know no occlusion"));
}

TEST(Selftest, EndsWithSixWhereACaseFails) {
  const TempFolder folder;
  const std::string command = "TMPDIR='" + folder / "there-is-none" +
                              "' '" UNSHOT_PROGRAM "' selftest --case duplicates >'" + folder / "out" + "'";
  const int status = std::system(command.c_str());
  ASSERT_TRUE(WIFEXITED(status));
  EXPECT_EQ(WEXITSTATUS(status), 6);
  EXPECT_THAT(folder.read("out"), HasSubstr(" FAIL\n"));
  EXPECT_THAT(folder.read("out"), HasSubstr("1 failed"));
}

}  // namespace
}  // namespace unshot
