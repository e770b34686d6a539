#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <sstream>
#include <vector>

#include "base/collective.h"
#include "io/checkpoint.h"
#include "io/checkpoint_index.h"
#include "io/checkpoint_seal.h"
#include "io/input_file.h"
#include "koshi/error.h"

namespace koshi::io {
namespace {

namespace fs = std::filesystem;

// The values of this program and of the file have the same bytes.
static_assert(std::endian::native == std::endian::little);

/// A checkpoint whose seal is right. Each rank reads for itself: no rank can leave the others waiting.
struct Opened {
  InputFile file;
  Seal seal;
  CheckpointIndex index;

  Opened(const fs::path& path, const Seal& checked)
      : file(path), seal(checked), index(parse_index(text(checked.index), file.size())) {}
  std::string text(const Bytes& bytes) const { return file.text(bytes.offset, bytes.offset + bytes.count); }
  CheckpointInfo info() const {
    return {index.time, index.step, text(index.case_text), index.scalars, text(index.blob), seal.koshi_version};
  }
};

// First line in which two cases differ, with the table it stands in.
std::string difference(const std::string& there, const std::string& here) {
  std::istringstream a(there), b(here);
  std::string table, line_a, line_b;
  for (;;) {
    const bool more_a = static_cast<bool>(std::getline(a, line_a)), more_b = static_cast<bool>(std::getline(b, line_b));
    if (!more_a) line_a = "nothing more";
    if (!more_b) line_b = "nothing more";
    if (line_a != line_b || !(more_a && more_b))
      return fmt::format("{}`{}` there, `{}` here", table.empty() ? "" : "in " + table + " ", line_a, line_b);
    if (line_a.starts_with('[')) table = line_a;
  }
}

void check_case(const CheckpointInfo& info, const std::string& case_text) {
  if (info.case_text != case_text) throw InputError("it is of another case: " + difference(info.case_text, case_text));
}

void read_field(const Opened& opened, const std::string& name, const model::Model& model,
                lattice::Field<double>& values) {
  const auto found = opened.index.fields.find(name);
  if (found == opened.index.fields.end()) throw InputError("it does not have the field " + name);
  const IndexedField& field = found->second;
  const auto [components, nz, ny, nx] = field.shape;
  const Int3 nodes = model.lattice.grid.nodes();
  if (field.shape != std::array<std::int64_t, 4>{values.components(), nodes[2], nodes[1], nodes[0]})
    throw InputError(
        fmt::format("it is of another lattice: {} has {} components on {} x {} x {} nodes there, {} on "
                    "{} x {} x {} here",
                    name, components, nx, ny, nz, values.components(), nodes[0], nodes[1], nodes[2]));
  // Layer by layer: this rank's rows of y, whole along x.
  const lattice::Layout& layout = model.layout();
  const Int3 &begin = layout.begin(), &owned = layout.owned();
  std::vector<double> rows(static_cast<std::size_t>(owned[1] * nx));
  for (int c = 0; c < values.components(); ++c)
    for (std::int64_t k = 0; k < owned[2]; ++k) {
      const std::int64_t first = ((c * nz + begin[2] + k) * ny + begin[1]) * nx;
      opened.file.read(field.offset + sizeof(double) * static_cast<std::uint64_t>(first),
                       std::as_writable_bytes(std::span(rows)));
      for (std::int64_t j = 0; j < owned[1]; ++j)
        std::copy_n(rows.data() + j * nx + begin[0], owned[0], values.component(c) + layout.index(0, j, k));
    }
}

// Opens a whole checkpoint and calls `action` with it; errors get the file's name.
template <class F>
void with_checkpoint(fs::path file, const Communicator& communicator, F&& action) {
  if (fs::is_directory(file)) file /= "checkpoint.h5";
  const Seal seal = check_seal(file, communicator);
  collectively(communicator, [&] {
    try {
      action(Opened(file, seal));
    } catch (const InputError& error) {
      throw InputError(fmt::format("checkpoint {} does not fit: {}", file.native(), error.message()));
    }
  });
}

}  // namespace

CheckpointInfo read_checkpoint(const fs::path& file, const model::Model& model, const std::string& case_text,
                               model::State& state, std::span<const CheckpointField> fields) {
  CheckpointInfo info;
  with_checkpoint(file, model.communicator, [&](const Opened& opened) {
    info = opened.info();
    check_case(info, case_text);
    read_field(opened, displacement_name, model, state.displacement);
    read_field(opened, velocity_name, model, state.velocity);
    for (const CheckpointField& field : fields) read_field(opened, field.name, model, *field.values);
    state.time = info.time;
    state.step = info.step;
  });
  return info;
}

CheckpointInfo read_checkpoint_header(const fs::path& file, const Communicator& communicator) {
  CheckpointInfo info;
  with_checkpoint(file, communicator, [&](const Opened& opened) { info = opened.info(); });
  return info;
}

}  // namespace koshi::io
