// Tests of the program in a directory of their own.
#pragma once

#include <nlohmann/json.hpp>

#include "support/program.h"
#include "support/temporary_directory.h"

namespace koshi::test {

class ProgramTest : public testing::Test {
 protected:
  Ended koshi(const std::string& arguments) const { return test::koshi(directory_.path(), arguments); }

  /// What `summary.json` of an output directory says.
  nlohmann::json summary(const std::filesystem::path& output) const {
    return nlohmann::json::parse(read_file(directory_ / output / "summary.json"));
  }

  TemporaryDirectory directory_;
};

}  // namespace koshi::test
