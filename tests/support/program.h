// Runs the program as a user does.
#pragma once

#include <gtest/gtest.h>
#include <sys/wait.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>

namespace koshi::test {

struct Ended {
  int code = -1;       ///< exit code
  std::string output;  ///< standard output
  std::string error;   ///< standard error
};

inline std::string read_file(const std::filesystem::path& file) {
  std::ifstream stream(file);
  std::ostringstream text;
  text << stream.rdbuf();
  return text.str();
}

inline void write_file(const std::filesystem::path& file, const std::string& text) { std::ofstream(file) << text; }

/// The address sanitizer reserves terabytes of address space, so that no limit can be set, and reports what libraries
/// leak.
#ifdef __SANITIZE_ADDRESS__
inline constexpr bool without_address_sanitizer = false;
#else
inline constexpr bool without_address_sanitizer = true;
#endif

/// Runs `koshi ARGUMENTS` through the shell in a directory.
inline Ended koshi(const std::filesystem::path& directory, const std::string& arguments,
                   const std::string& program = KOSHI_PROGRAM) {
  const auto out = directory / "stdout.txt", err = directory / "stderr.txt";
  const std::string command = "cd '" + directory.native() + "' && '" + program + "' " + arguments + " >'" +
                              out.native() + "' 2>'" + err.native() + "' </dev/null";
  const int status = std::system(command.c_str());
  EXPECT_TRUE(WIFEXITED(status)) << command;
  return {WEXITSTATUS(status), read_file(out), read_file(err)};
}

/// The same within 1.5 GB of address space.
inline Ended koshi_in_small_memory(const std::filesystem::path& directory, const std::string& arguments) {
  return koshi(directory, "--version >/dev/null; ulimit -v 1500000; '" + std::string(KOSHI_PROGRAM) + "' " + arguments);
}

}  // namespace koshi::test
