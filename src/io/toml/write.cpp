#include <fmt/format.h>

#include "io/toml/key.h"
#include "koshi/input.h"

namespace koshi::io {
namespace {

template <class S>
void write_table(const std::string& header, const S& value, std::string& out) {
  out += fmt::format("\n{}\n", header);
  for (const std::string& line : assignments(value)) out += line + "\n";
}

// File names are looked up beside the case; the resolved input may stand elsewhere.
void make_absolute(const std::string& directory, std::string& file) {
  if (!file.empty())
    file = std::filesystem::absolute(std::filesystem::path(directory) / file).lexically_normal().string();
}

}  // namespace

std::string resolved_toml(const model::Definition& definition) {
  model::Definition resolved = definition;
  make_absolute(definition.directory, resolved.body.image);
  make_absolute(definition.directory, resolved.body.factor);
  make_absolute(definition.directory, resolved.body.strength);
  if (resolved.body.grain_boundary) make_absolute(definition.directory, resolved.body.grain_boundary->labels);
  make_absolute(definition.directory, resolved.analysis.start_from);
  for (auto& region : resolved.regions) make_absolute(definition.directory, region.file);

  std::string out = "# The whole input with every default, in SI units.\n";
  if (!resolved.title.empty()) out += fmt::format("title = {}\n", toml_text(resolved.title));
  write_table("[lattice]", resolved.lattice, out);
  write_table("[body]", resolved.body, out);
  // Mixtures come from the image, and will again.
  resolved.materials.resize(resolved.materials.size() - resolved.body.mixtures.size());
  for (const auto& material : resolved.materials)
    write_table(fmt::format("[material.{}]", toml_key(material.name)), material, out);
  for (const auto& region : resolved.regions) write_table("[[region]]", region, out);
  for (const auto& crack : resolved.pre_cracks) write_table("[[crack]]", crack, out);
  for (const auto& selection : resolved.selections) write_table("[[selection]]", selection, out);
  for (const auto& boundary : resolved.boundaries) write_table("[[boundary]]", boundary, out);
  for (const auto& load : resolved.loads) write_table("[[load]]", load, out);
  if (resolved.macroscopic) write_table("[macroscopic]", *resolved.macroscopic, out);
  write_table("[analysis]", resolved.analysis, out);
  for (const auto& probe : resolved.probes) write_table("[[probe]]", probe, out);
  write_table("[output]", resolved.output, out);
  return out;
}

}  // namespace koshi::io
