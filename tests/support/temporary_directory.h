// A fresh directory for one test, removed at its end.
#pragma once

#include <unistd.h>

#include <filesystem>
#include <optional>
#include <string>

#include "koshi/communicator.h"

namespace koshi::test {

class TemporaryDirectory {
 public:
  TemporaryDirectory() : path_(make()) {}
  /// The same directory on all ranks (collective).
  explicit TemporaryDirectory(const Communicator& communicator)
      : owner_(communicator.is_root()),
        path_(communicator.broadcast(owner_ ? make() : "")),
        communicator_(communicator) {}
  ~TemporaryDirectory() {
    if (communicator_) communicator_->barrier();
    std::error_code ignored;
    if (owner_) std::filesystem::remove_all(path_, ignored);
  }
  TemporaryDirectory(const TemporaryDirectory&) = delete;
  TemporaryDirectory& operator=(const TemporaryDirectory&) = delete;

  const std::filesystem::path& path() const { return path_; }
  std::filesystem::path operator/(const std::filesystem::path& name) const { return path_ / name; }

 private:
  static std::string make() {
    std::string name = (std::filesystem::temp_directory_path() / "koshi_test_XXXXXX").native();
    return ::mkdtemp(name.data()) ? name : "";
  }
  bool owner_ = true;
  std::filesystem::path path_;
  std::optional<Communicator> communicator_;
};

}  // namespace koshi::test
