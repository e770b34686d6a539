// A raw file against what its input says of it: the first bytes are the size, type, byte order and offset.
#include <array>
#include <cstring>

#include "fuzz/fuzz_image.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace koshi;
  std::array<std::int16_t, 3> cells{};
  std::uint32_t offset = 0;
  constexpr std::size_t head = sizeof cells + 2 + sizeof offset;
  if (size < head) return 0;
  std::memcpy(cells.data(), data, sizeof cells);
  std::memcpy(&offset, data + sizeof cells + 2, sizeof offset);
  const io::VoxelHeader header{{cells[0], cells[1], cells[2]},
                               static_cast<io::ValueType>(data[sizeof cells] % 10),
                               data[sizeof cells + 1] % 2 == 1,
                               {}};
  test::fuzz_image([&](const auto& path) { return io::read_raw(path, header, offset); }, data + head, size - head);
  return 0;
}
