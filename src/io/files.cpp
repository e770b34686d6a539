#include "io/files.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include <cerrno>
#include <new>
#include <system_error>

#include "io/input_file.h"
#include "koshi/error.h"

namespace koshi::io {
namespace {

/// An open file descriptor.
class Descriptor {
 public:
  Descriptor(const std::filesystem::path& path, int flags) : value_(::open(path.c_str(), flags | O_CLOEXEC, 0666)) {}
  ~Descriptor() {
    if (value_ >= 0) ::close(value_);
  }
  Descriptor(const Descriptor&) = delete;
  Descriptor& operator=(const Descriptor&) = delete;
  explicit operator bool() const { return value_ >= 0; }
  int value() const { return value_; }

 private:
  int value_;
};

bool write_all(int descriptor, std::string_view content) {
  while (!content.empty()) {
    const ssize_t written = ::write(descriptor, content.data(), content.size());
    if (written < 0 && errno == EINTR) continue;
    if (written < 0) return false;
    content.remove_prefix(static_cast<std::size_t>(written));
  }
  return true;
}

}  // namespace

std::filesystem::path part_of(const std::filesystem::path& path) { return path.native() + ".part"; }

std::filesystem::path fresh_part_of(const std::filesystem::path& path) {
  ::unlink(part_of(path).c_str());  // a directory stays, and is an error when the file is opened
  return part_of(path);
}

std::string system_reason(int error_number) { return std::generic_category().message(error_number); }

std::error_code try_replace_file(const std::filesystem::path& path, std::string_view content) {
  const std::filesystem::path part = fresh_part_of(path);
  bool done = false;
  if (const Descriptor file(part, O_WRONLY | O_CREAT | O_EXCL); file)
    done = write_all(file.value(), content) && ::fsync(file.value()) == 0;
  if (done && ::rename(part.c_str(), path.c_str()) == 0) return {};
  const std::error_code error(errno, std::generic_category());
  ::unlink(part.c_str());
  return error;
}

void replace_file(const std::filesystem::path& path, std::string_view content) {
  if (const std::error_code error = try_replace_file(path, content))
    throw RunError(fmt::format("cannot write {}: {}", path.native(), error.message()));
}

std::string read_file(const std::filesystem::path& path) {
  try {
    const InputFile file(path);
    return file.text(0, file.size());
  } catch (const InputError& error) {
    throw InputError(fmt::format("{} {}", path.native(), error.message()));
  } catch (const std::bad_alloc&) {
    throw InputError(fmt::format("{} needs more memory than there is", path.native()));
  }
}

void flush_to_disk(const std::filesystem::path& path) {
  const Descriptor file(path, O_RDONLY);
  if (!file || ::fsync(file.value()) != 0)
    throw RunError(fmt::format("cannot write {}: {}", path.native(), system_reason(errno)));
}

}  // namespace koshi::io
