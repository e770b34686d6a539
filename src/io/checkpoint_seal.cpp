#include "io/checkpoint_seal.h"

#include <fmt/format.h>
#include <zlib.h>

#include <algorithm>
#include <cerrno>
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
std::string make_head(const std::string& version, std::int64_t bytes) {
  return fmt::format("{}{}\nkoshi {}\nbytes {}\n", title, checkpoint_format, version, bytes);
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
std::uint32_t checksum(const fs::path& file, const std::string& head, std::int64_t bytes,
                       const Communicator& communicator) {
  struct Part {
    std::uint64_t crc;
    std::int64_t length;
  };
  const std::int64_t body = bytes - static_cast<std::int64_t>(seal_size);
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
  uLong crc = crc_of(head);
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

// The seal of a file that seems to be a checkpoint of this format and size.
std::string read_seal(const fs::path& file, std::int64_t& bytes) {
  std::string seal;
  try {
    const InputFile opened(file);
    seal = opened.text(0, seal_size);
    bytes = static_cast<std::int64_t>(opened.size());
  } catch (const InputError& error) {
    throw InputError(fmt::format("checkpoint {} {}", file.native(), error.message()));
  }
  const std::string name = file.native();
  if (seal.starts_with("\x89HDF\r\n\x1a\n"))
    throw InputError(fmt::format("{} is an HDF5 file, but no checkpoint of Koshi", name));
  if (!seal.starts_with(title)) throw InputError(fmt::format("{} is no checkpoint of Koshi", name));
  const std::string format = entry(seal, "format");
  if (format != std::to_string(checkpoint_format))
    throw InputError(fmt::format("{} has checkpoint format {}, this Koshi reads format {}; go on with Koshi {}", name,
                                 format, checkpoint_format, entry(seal, "koshi")));
  if (const std::string wanted = entry(seal, "bytes"); wanted != std::to_string(bytes))
    throw InputError(fmt::format("checkpoint {} is cut short: {} of {} bytes", name, bytes, wanted));
  return seal;
}

// What a user may try instead of a broken checkpoint.
std::string remedy(const fs::path& file) {
  const fs::path previous = file.parent_path() / "checkpoint.previous.h5";
  return file.filename() == "checkpoint.h5" && fs::exists(previous) ? "; try " + previous.native() : "";
}

}  // namespace

void seal_checkpoint(const fs::path& file, const Communicator& communicator) {
  const auto bytes = static_cast<std::int64_t>(fs::file_size(file));
  const std::string head = make_head(KOSHI_VERSION, bytes);
  const std::uint32_t crc = checksum(file, head, bytes, communicator);
  collectively(communicator, [&] {
    if (!communicator.is_root()) return;
    std::fstream out(file, std::ios::binary | std::ios::in | std::ios::out);
    if (!out.write(make_seal(head, crc).data(), seal_size).flush())
      throw RunError(fmt::format("cannot write {}: {}", file.native(), system_reason(errno)));
    flush_to_disk(file);
  });
}

void check_seal(const fs::path& file, const Communicator& communicator) {
  try {
    std::string seal;
    std::int64_t bytes = 0;
    collectively(communicator, [&] { seal = read_seal(file, bytes); });
    const std::string head = make_head(entry(seal, "koshi"), bytes);
    const std::uint32_t crc = checksum(file, head, bytes, communicator);
    collectively(communicator, [&] {
      if (communicator.is_root() && seal != make_seal(head, crc))
        throw InputError(fmt::format("checkpoint {} is corrupted: its checksum is {:08x}, not {}", file.native(), crc,
                                     entry(seal, "crc32")));
    });
  } catch (const InputError& error) {
    throw InputError(error.message() + remedy(file));
  }
}

}  // namespace koshi::io
