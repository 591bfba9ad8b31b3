// A test that works in a folder of its own, for what is written without a name.
#pragma once

#include <gtest/gtest.h>

#include <filesystem>

#include "support/temp_folder.h"

namespace unshot::testing_support {

class InOwnFolder : public testing::Test {
 protected:
  InOwnFolder() : before_(std::filesystem::current_path()) { std::filesystem::current_path(folder_.path()); }
  ~InOwnFolder() override { std::filesystem::current_path(before_); }

  TempFolder folder_;

 private:
  std::filesystem::path before_;
};

}  // namespace unshot::testing_support
