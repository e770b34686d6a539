// Files that appear whole or not at all.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <system_error>

namespace koshi::io {

/// Name under which a file is written before it gets its own: `path` with ".part" added.
std::filesystem::path part_of(const std::filesystem::path& path);

/// The same, with nothing there any more that was left or put there, so that what is written goes into a file of its
/// own: a link is removed and not followed.
std::filesystem::path fresh_part_of(const std::filesystem::path& path);

/// Text of a system error, e.g. "No space left on device".
std::string system_reason(int error_number);

/// Puts a file with this content at `path`: written beside, flushed to the disk, renamed. On failure the file that was
/// there before stays as it was; try_replace_file() returns the system's error, replace_file() throws a RunError with
/// it.
std::error_code try_replace_file(const std::filesystem::path& path, std::string_view content);
void replace_file(const std::filesystem::path& path, std::string_view content);

/// Content of a regular file. Throws InputError with the reason.
std::string read_file(const std::filesystem::path& path);

/// Flushes a file or a directory (its entries: a rename is safe only then) to the disk. Throws RunError.
void flush_to_disk(const std::filesystem::path& path);

}  // namespace koshi::io
