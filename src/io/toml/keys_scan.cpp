// Keys of [body.scan].
#include "io/toml/key.h"

namespace koshi::io {

using namespace model;

const std::vector<Key<ScanDefinition>>& keys_of(Tag<ScanDefinition>) {
  using D = ScanDefinition;
  static const std::vector<Key<D>> keys{
      key<D>("size", &D::size, "Raw file: voxels along its axes, of which the first runs fastest.",
             {.range = ranges::voxel_count, .example = "[512, 512, 400]"}),
      key<D>("type", &D::type, "Raw file: type of its values."),
      key<D>("byte_order", &D::byte_order, "Raw file: the least or the most significant byte of a value comes first."),
      key<D>("offset", &D::offset, "Raw file: bytes before the values.", {.range = ranges::bytes, .example = "512"}),
      key<D>("unit", &D::unit,
             "Length of the unit in which the file gives the sides of its voxels, for lattice.spacing = \"image\".",
             {.dimension = Dimension::length, .range = ranges::size, .example = R"("1 um")"}),
      key<D>("crop", &D::crop,
             "The voxels from min on and below max, counted from 0 along the axes of the image, are kept.",
             {.range = ranges::voxel, .example = "{min = [0, 0, 100], max = [256, 256, 356]}"}),
      key<D>("axes", &D::axes, "The axes of the image that become x, y, z; a minus turns one around.",
             {.allowed = {"x", "-x", "y", "-y", "z", "-z"}, .example = R"(["z", "y", "-x"])"}),
      key<D>("coarsen", &D::coarsen, "Voxels along the edge of a cell.", {.range = ranges::coarsening, .example = "2"}),
      key<D>("thresholds", &D::thresholds,
             "Ascending; the value of a voxel becomes the number of thresholds that it reaches.",
             {.range = ranges::grey, .example = "[80, 160]"}),
      key<D>("grey", &D::grey, "Ascending values of the image at which density is given; linear between them.",
             {.range = ranges::grey, .example = "[1000, 3000]"}),
      key<D>("density", &D::density, "Density at each of the values of grey, at most that of the material; 0: void.",
             {.dimension = Dimension::density, .range = ranges::scan_density, .example = R"([0, "1800 kg/m^3"])"}),
      key<D>("exponent", &D::exponent,
             "A voxel's Young's modulus is the material's times (density / its density)^exponent.",
             {.range = ranges::exponent, .example = "2"}),
  };
  return keys;
}

}  // namespace koshi::io
