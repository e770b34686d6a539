#include <fmt/format.h>

#include <cerrno>
#include <cstring>
#include <fstream>

#include "io/toml/key.h"
#include "io/toml/override.h"
#include "io/toml/read.h"
#include "koshi/calibration.h"
#include "koshi/input.h"

namespace koshi::io {
namespace {

void record_places(const Value& value, const std::string& path, model::Places& places) {
  places.set(path, value.place);
  if (const Table* table = value.table())
    for (const Entry& entry : *table)
      record_places(entry.value, path.empty() ? entry.key : path + "." + entry.key, places);
  if (const Array* array = value.array())
    for (std::size_t i = 0; i < array->size(); ++i) record_places((*array)[i], fmt::format("{}[{}]", path, i), places);
}

// What the file leaves open but the run decides.
void fill_in(const Value& root, model::Definition& definition) {
  auto& lattice = definition.lattice;
  lattice.calibration = definition.calibration();
  if (lattice.calibration == material::Calibration::paper && lattice.equations.empty())
    lattice.equations = material::default_equations(lattice.cell);

  const Entry* analysis = find(*root.table(), "analysis");
  const bool damping_given = analysis != nullptr && find(*analysis->value.table(), "damping") != nullptr;
  if (definition.analysis.type == model::AnalysisDefinition::Type::dynamic && !damping_given)
    definition.analysis.damping.kind = model::DampingDefinition::Kind::none;

  const auto number = [](auto& list, const std::string& section) {
    for (std::size_t i = 0; i < list.size(); ++i)
      if (list[i].name.empty()) list[i].name = fmt::format("{} {}", section, i + 1);
  };
  number(definition.boundaries, "boundary");
  number(definition.loads, "load");

  for (auto& probe : definition.probes) probe.reduce = probe.reduction();
}

std::string contents(const std::filesystem::path& file) {
  const Place place{file.string(), 0, 0};
  errno = 0;
  std::ifstream stream(file, std::ios::binary);
  if (!stream)
    throw InputError(place, fmt::format("cannot be opened ({}); expected a case file in TOML", std::strerror(errno)));
  constexpr std::streamsize largest = 16 << 20;
  std::string text(static_cast<std::size_t>(largest), '\0');
  stream.read(text.data(), largest);
  if (std::filesystem::is_directory(file)) throw InputError(place, "is a folder; expected a case file in TOML");
  if (stream.bad()) throw InputError(place, "cannot be read; expected a case file in TOML");
  if (stream.gcount() == largest) throw InputError(place, "is larger than 16 MiB; expected a case file in TOML");
  text.resize(static_cast<std::size_t>(stream.gcount()));
  return text;
}

}  // namespace

model::Definition read_case_text(std::string_view text, const std::string& file_name,
                                 std::span<const std::string> overrides) {
  const auto directory = std::filesystem::path(file_name).parent_path();
  return read_case_values(parse_toml(text, file_name), directory.empty() ? "." : directory.string(), overrides);
}

model::Definition read_case_values(Value root, const std::string& directory, std::span<const std::string> overrides) {
  for (const std::string& override : overrides) apply_override(root, override);

  model::Definition definition;
  definition.directory = directory;
  record_places(root, "", definition.places);
  read_table(root, "the input", definition);
  fill_in(root, definition);
  check(definition);
  return definition;
}

model::Definition read_case(const std::filesystem::path& file, std::span<const std::string> overrides) {
  return read_case_text(contents(file), file.string(), overrides);
}

}  // namespace koshi::io
