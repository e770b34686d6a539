#include "io/scan_cells.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

#include "io/cell_mixtures.h"
#include "model/check.h"

namespace koshi::io {
namespace {

using model::ScanDefinition;

std::string list_of(const std::set<double>& values) {
  constexpr std::size_t most = 20;
  std::string text;
  for (const double value : values) text += fmt::format("{}{:.0f}", text.empty() ? "" : ", ", value);
  return text + (values.size() > most ? ", ..." : "");
}

std::uint16_t index_of(const model::Definition& definition, const std::string& name) {
  std::size_t index = 0;
  while (index < definition.materials.size() && definition.materials[index].name != name) ++index;
  return name == "void" ? 0 : static_cast<std::uint16_t>(index + 1);
}

/// Materials of values; values without one are remembered.
class Materials {
 public:
  explicit Materials(const model::Definition& definition) : last_(of_value_.end()) {
    for (const auto& [value, name] : definition.body.image_materials) of_value_[value] = index_of(definition, name);
    last_ = of_value_.end();
  }
  std::uint16_t of(double value) {
    // Neighbours mostly have the same value, so the last one found is tried first.
    if (last_ == of_value_.end() || last_->first != value) last_ = of_value_.find(value);
    if (last_ != of_value_.end()) return last_->second;
    if (unknown_.size() < 21) unknown_.insert(value);
    return 0;
  }
  void refuse_unknown(const model::Checker& check) const {
    if (unknown_.empty()) return;
    const bool counted = check.definition.body.scan && !check.definition.body.scan->thresholds.empty();
    check.fail("body.materials",
               fmt::format("the image also has the value{} {}{}; name a material, or \"void\", for each",
                           unknown_.size() == 1 ? "" : "s", list_of(unknown_), counted ? " by its thresholds" : ""));
  }

 private:
  std::map<double, std::uint16_t> of_value_;
  std::map<double, std::uint16_t>::const_iterator last_;
  std::set<double> unknown_;
};

// Linear between the points, constant beyond.
double density_of(const ScanDefinition& scan, double grey) {
  const auto above = std::upper_bound(scan.grey.begin(), scan.grey.end(), grey);
  if (above == scan.grey.begin()) return scan.density.front();
  if (above == scan.grey.end()) return scan.density.back();
  const auto i = static_cast<std::size_t>(above - scan.grey.begin());
  const double part = (grey - scan.grey[i - 1]) / (scan.grey[i] - scan.grey[i - 1]);
  return scan.density[i - 1] + part * (scan.density[i] - scan.density[i - 1]);
}

// Calls f(value) for the voxels of the cell whose first voxel is `at`.
template <class F>
void for_each_voxel(const CellImage& image, std::int64_t at, std::int64_t edge, F&& f) {
  for (std::int64_t k = 0; k < edge; ++k)
    for (std::int64_t j = 0; j < edge; ++j)
      for (std::int64_t i = 0; i < edge; ++i)
        f(image.value(at + i * image.stride[0] + j * image.stride[1] + k * image.stride[2]));
}

// Calls f(first voxel) for all cells, x fastest.
template <class F>
void for_each_cell(const CellImage& image, const Int3& cells, std::int64_t edge, F&& f) {
  for (std::int64_t k = 0; k < cells[2]; ++k)
    for (std::int64_t j = 0; j < cells[1]; ++j)
      for (std::int64_t i = 0; i < cells[0]; ++i)
        f(edge * (i * image.stride[0] + j * image.stride[1] + k * image.stride[2]));
}

Int3 coarse_size(const CellImage& kept, std::int64_t edge, const model::Checker& check) {
  Int3 cells{};
  for (std::size_t a = 0; a < 3; ++a) {
    cells[a] = kept.cells[a] / edge;
    if (cells[a] * edge != kept.cells[a])
      check.fail(
          "body.scan.coarsen",
          fmt::format("there are {} x {} x {} voxels, but cells of {} voxels along an edge need multiples of {}; "
                      "crop the image",
                      kept.cells[0], kept.cells[1], kept.cells[2], edge, edge));
  }
  return cells;
}

}  // namespace

CellImage kept_part(const CellImage& image, const model::Definition& definition) {
  if (!definition.body.scan) return image;
  const ScanDefinition& scan = *definition.body.scan;
  Int3 first{}, last = image.cells;
  if (scan.crop) {
    for (std::size_t a = 0; a < 3; ++a) {
      first[a] = static_cast<std::int64_t>(scan.crop->first[a]);
      last[a] = static_cast<std::int64_t>(scan.crop->second[a]);
      if (last[a] > image.cells[a])
        model::Checker(definition)
            .fail("body.scan.crop", fmt::format("crop goes to voxel {} along {}, but the image has {} x {} x {}",
                                                last[a], "xyz"[a], image.cells[0], image.cells[1], image.cells[2]));
    }
  }
  CellImage kept{{}, {}, {}, image.voxel};
  std::int64_t start = 0;
  for (std::size_t a = 0; a < 3; ++a) {
    const std::string axis = scan.axes.empty() ? std::string(1, "xyz"[a]) : scan.axes[a];
    const auto from = static_cast<std::size_t>(axis.back() - 'x');
    const bool backwards = axis.front() == '-';
    kept.cells[a] = last[from] - first[from];
    kept.stride[a] = backwards ? -image.stride[from] : image.stride[from];
    start += image.stride[from] * (backwards ? last[from] - 1 : first[from]);
  }
  kept.value = [value = image.value, start](std::int64_t i) { return value(start + i); };
  if (!scan.thresholds.empty())
    kept.value = [value = kept.value, thresholds = scan.thresholds](std::int64_t i) {
      return static_cast<double>(std::upper_bound(thresholds.begin(), thresholds.end(), value(i)) - thresholds.begin());
    };
  return kept;
}

ScanCells cells_of(const CellImage& kept, const model::Definition& definition) {
  const model::Checker check(definition);
  const model::BodyDefinition& body = definition.body;
  const std::int64_t edge = body.scan ? body.scan->coarsen : 1;
  const double voxels = static_cast<double>(edge * edge * edge);
  ScanCells result;
  result.cells = coarse_size(kept, edge, check);
  result.material.reserve(static_cast<std::size_t>(result.cells[0] * result.cells[1] * result.cells[2]));

  if (body.scan && !body.scan->grey.empty()) {
    const std::uint16_t material = index_of(definition, body.material);
    const double dense = definition.materials[material - 1u].elastic.density;
    for_each_cell(kept, result.cells, edge, [&](std::int64_t at) {
      double grey = 0;
      for_each_voxel(kept, at, edge, [&](double value) { grey += value; });
      const double share = std::clamp(density_of(*body.scan, grey / voxels) / dense, 0.0, 1.0);
      result.material.push_back(share > 0 ? material : 0);
      // A void has no use for them, but a region may fill it.
      result.density_share.push_back(share > 0 ? static_cast<float>(share) : 1.0F);
      result.factor.push_back(share > 0 ? static_cast<float>(std::pow(share, body.scan->exponent)) : 1.0F);
    });
    return result;
  }

  Materials materials(definition);
  CellMixtures mixtures(definition);
  std::map<std::uint16_t, int> count;
  for_each_cell(kept, result.cells, edge, [&](std::int64_t at) {
    if (edge == 1) {
      result.material.push_back(materials.of(kept.value(at)));
      return;
    }
    count.clear();
    int solid = 0;
    for_each_voxel(kept, at, edge, [&](double value) {
      const std::uint16_t material = materials.of(value);
      if (material == 0) return;
      ++count[material];
      ++solid;
    });
    const std::uint16_t material = solid == 0 ? std::uint16_t{0} : mixtures.material_of(count);
    result.material.push_back(material);
    // A void has no use for a factor, but a region may fill it.
    const float factor = solid == 0 ? 1.0F : static_cast<float>(solid / voxels);
    result.factor.push_back(factor);
    // Of a mixture the voxels have the mass, not the sixteenths.
    double mass = 0;
    if (material > definition.materials.size())
      for (const auto& [of, number] : count) mass += number * mixtures.density(of);
    result.density_share.push_back(mass > 0 ? static_cast<float>(mass / (voxels * mixtures.density(material)))
                                            : factor);
  });
  result.mixtures = mixtures.mixtures();
  result.mixture_materials = mixtures.materials(result.material, result.cells);
  materials.refuse_unknown(check);
  return result;
}

}  // namespace koshi::io
