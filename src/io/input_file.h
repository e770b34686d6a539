// Files that others made, opened with care.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <string_view>

namespace koshi::io {

/// A regular file open for reading. Folders, pipes and devices are refused: they have no length that a header could be
/// checked against, and reading them may never end. Errors: InputError without a place, a predicate such as "cannot be
/// opened (No such file or directory)".
class InputFile {
 public:
  explicit InputFile(const std::filesystem::path& path);
  ~InputFile();
  InputFile(InputFile&& other) noexcept;
  InputFile& operator=(InputFile&&) = delete;

  std::uint64_t size() const { return size_; }  ///< [bytes], when it was opened
  const std::filesystem::path& path() const { return path_; }

  /// Fills `out` from this offset on.
  void read(std::uint64_t offset, std::span<std::byte> out) const;

  /// The bytes [begin, end); both are cut to the file's length.
  std::string text(std::uint64_t begin, std::uint64_t end) const;

 private:
  std::filesystem::path path_;
  int descriptor_ = -1;
  std::uint64_t size_ = 0;
};

}  // namespace koshi::io
