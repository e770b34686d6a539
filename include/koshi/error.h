// Errors: three tiers.
//   1. InputError  the user's input is wrong: says where (file, line, column) and what would be right. Exit code 2.
//   2. RunError    a valid run failed (diverged, disk full, no convergence). Exit code 1.
//   3. assert      a bug in Koshi. Kernels neither throw nor check.
#pragma once

#include <stdexcept>
#include <string>

namespace koshi {

/// A place in an input file; line and column count from 1, 0 = unknown.
struct Place {
  std::string file;  ///< or option, or path of the key
  int line = 0;      ///< from 1
  int column = 0;    ///< from 1
};

/// Wrong input. `what()` reads "case.toml:12:9: error: what is wrong; what would be right".
class InputError : public std::runtime_error {
 public:
  explicit InputError(const std::string& message) : InputError(Place{}, message) {}  ///< place unknown
  InputError(const Place& place, const std::string& message);                        ///< `message` without the place

  const Place& place() const { return place_; }  ///< where the mistake stands
  /// The text without the place.
  const std::string& message() const { return message_; }

 private:
  Place place_;
  std::string message_;
};

/// A run that was valid but failed. `what()` says where it stopped and what to change.
class RunError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

}  // namespace koshi
