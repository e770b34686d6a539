#include "io/checkpoint_seal.h"

#include <fmt/format.h>
#include <zlib.h>

#include <algorithm>
#include <cerrno>
#include <charconv>
#include <cstring>
#include <fstream>

#include "base/collective.h"
#include "io/files.h"
#include "io/input_file.h"

namespace koshi::io {
namespace {

namespace fs = std::filesystem;

constexpr std::string_view title = "Koshi checkpoint\nformat ";

// The part of the seal that the checksum covers, together with everything behind the seal.
std::string make_head(const Seal& seal) {
  return fmt::format("{}{}\nkoshi {}\nbytes {}\nindex {} {}\n", title, checkpoint_format, seal.koshi_version,
                     seal.file_size, seal.index.offset, seal.index.count);
}

std::string make_seal(const std::string& head, std::uint32_t crc) {
  std::string seal = fmt::format("{}crc32 {:08x}\n", head, crc);
  seal.resize(seal_size, '\0');
  return seal;
}

uLong crc_of(std::string_view bytes, uLong crc = 0) {
  return crc32_z(crc, reinterpret_cast<const Bytef*>(bytes.data()), bytes.size());
}

// CRC-32 of the head and of everything behind the seal, on the root: each rank reads its part of the file.
std::uint32_t checksum(const fs::path& file, const Seal& seal, const Communicator& communicator) {
  struct Part {
    std::uint64_t crc;
    std::int64_t length;
  };
  const std::int64_t body = static_cast<std::int64_t>(seal.file_size) - static_cast<std::int64_t>(seal_size);
  const std::int64_t ranks = communicator.size(), rank = communicator.rank();
  const std::int64_t begin = body * rank / ranks, end = body * (rank + 1) / ranks;
  Part part{0, end - begin};
  collectively(communicator, [&] {
    std::ifstream in(file, std::ios::binary);
    in.seekg(begin + static_cast<std::int64_t>(seal_size));
    std::string block;
    for (std::int64_t left = part.length; left > 0; left -= static_cast<std::int64_t>(block.size())) {
      block.resize(static_cast<std::size_t>(std::min<std::int64_t>(left, 1 << 20)));
      if (!in.read(block.data(), static_cast<std::streamsize>(block.size())))
        throw InputError(fmt::format("checkpoint {} cannot be read to its end", file.native()));
      part.crc = crc_of(block, static_cast<uLong>(part.crc));
    }
  });

  // The parts' checksums are joined in rank order.
  const std::string parts = communicator.gather(std::string(reinterpret_cast<const char*>(&part), sizeof part));
  uLong crc = crc_of(make_head(seal));
  for (std::size_t at = 0; at < parts.size(); at += sizeof part) {
    std::memcpy(&part, parts.data() + at, sizeof part);
    crc = crc32_combine(crc, static_cast<uLong>(part.crc), part.length);
  }
  return static_cast<std::uint32_t>(crc);
}

// Text after `key` up to the end of the line, empty if there is none.
std::string entry(const std::string& seal, const std::string& key) {
  const std::size_t at = seal.find("\n" + key + " ");
  if (at == std::string::npos) return "";
  const std::size_t begin = at + key.size() + 2;
  return seal.substr(begin, seal.find('\n', begin) - begin);
}

// What stands in front of a file that seems to be a checkpoint of this format and size, and what it says.
std::string read_seal(const fs::path& file, Seal& seal) {
  std::string text;
  try {
    const InputFile opened(file);
    text = opened.text(0, seal_size);
    seal.file_size = opened.size();
  } catch (const InputError& error) {
    throw InputError(fmt::format("checkpoint {} {}", file.native(), error.message()));
  }
  const std::string name = file.native();
  if (text.starts_with("\x89HDF\r\n\x1a\n"))
    throw InputError(fmt::format("{} is an HDF5 file, but no checkpoint of Koshi", name));
  if (!text.starts_with(title)) throw InputError(fmt::format("{} is no checkpoint of Koshi", name));
  seal.koshi_version = entry(text, "koshi");
  const std::string format = entry(text, "format");
  if (format != std::to_string(checkpoint_format))
    throw InputError(fmt::format("{} has checkpoint format {}, this Koshi reads format {}; go on with Koshi {}", name,
                                 format, checkpoint_format, seal.koshi_version));
  if (const std::string wanted = entry(text, "bytes"); wanted != std::to_string(seal.file_size))
    throw InputError(fmt::format("checkpoint {} is cut short: {} of {} bytes", name, seal.file_size, wanted));
  // What is no number becomes one that the checksum does not fit.
  const std::string index = entry(text, "index");
  const char* end = index.data() + index.size();
  const auto [offset_end, error] = std::from_chars(index.data(), end, seal.index.offset);
  if (error == std::errc() && offset_end != end) std::from_chars(offset_end + 1, end, seal.index.count);
  return text;
}

// What a user may try instead of a broken checkpoint.
std::string remedy(const fs::path& file) {
  const fs::path previous = file.parent_path() / "checkpoint.previous.h5";
  return file.filename() == "checkpoint.h5" && fs::exists(previous) ? "; try " + previous.native() : "";
}

}  // namespace

void seal_checkpoint(const fs::path& file, const Bytes& index, const Communicator& communicator) {
  const Seal seal{KOSHI_VERSION, fs::file_size(file), index};
  const std::uint32_t crc = checksum(file, seal, communicator);
  collectively(communicator, [&] {
    if (!communicator.is_root()) return;
    std::fstream out(file, std::ios::binary | std::ios::in | std::ios::out);
    if (!out.write(make_seal(make_head(seal), crc).data(), seal_size).flush())
      throw RunError(fmt::format("cannot write {}: {}", file.native(), system_reason(errno)));
    flush_to_disk(file);
  });
}

Seal check_seal(const fs::path& file, const Communicator& communicator) {
  try {
    std::string text;
    Seal seal;
    collectively(communicator, [&] { text = read_seal(file, seal); });
    const std::uint32_t crc = checksum(file, seal, communicator);
    collectively(communicator, [&] {
      if (communicator.is_root() && text != make_seal(make_head(seal), crc))
        throw InputError(fmt::format("checkpoint {} is corrupted: its checksum is {:08x}, not {}", file.native(), crc,
                                     entry(text, "crc32")));
      // Right, but made by hand: an index may lie behind the end of the file.
      const Bytes& index = seal.index;
      if (index.offset < seal_size || index.offset > seal.file_size || index.count > seal.file_size - index.offset)
        throw InputError(fmt::format("checkpoint {} has its index behind its end", file.native()));
    });
    return seal;
  } catch (const InputError& error) {
    throw InputError(error.message() + remedy(file));
  }
}

}  // namespace koshi::io
