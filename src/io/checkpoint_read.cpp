#include <fmt/format.h>

#include <sstream>

#include "base/collective.h"
#include "io/checkpoint.h"
#include "io/checkpoint_layout.h"
#include "io/checkpoint_seal.h"

namespace koshi::io {
namespace {

namespace fs = std::filesystem;
using hdf5::check;
using hdf5::Handle;

// Each rank reads for itself: no rank can leave the others waiting.
Handle open_file(const fs::path& path) {
  const Handle access(H5Pcreate(H5P_FILE_ACCESS), H5Pclose, "describe access");
  check(H5Pset_fclose_degree(access, H5F_CLOSE_STRONG), "describe access");
  return Handle(H5Fopen(path.c_str(), H5F_ACC_RDONLY, access), H5Fclose, "open the file");
}

Handle open_group(hid_t file, const char* name) {
  return Handle(H5Gopen2(file, name, H5P_DEFAULT), H5Gclose, std::string("find ") + name);
}

void read_attribute(hid_t attribute, hid_t type, void* value, const std::string& name) {
  const Handle space(H5Aget_space(attribute), H5Sclose, "read " + name);
  if (H5Sget_simple_extent_npoints(space) != 1) throw hdf5::Error("read " + name);
  check(H5Aread(attribute, type, value), "read " + name);
}

void read_number(hid_t file, const char* name, hid_t type, void* value) {
  read_attribute(Handle(H5Aopen(file, name, H5P_DEFAULT), H5Aclose, std::string("find ") + name), type, value, name);
}

std::string read_string(hid_t file, const char* name) {
  const Handle dataset(H5Dopen2(file, name, H5P_DEFAULT), H5Dclose, std::string("find ") + name);
  const Handle type(H5Dget_type(dataset), H5Tclose, std::string("read ") + name);
  const Handle space(H5Dget_space(dataset), H5Sclose, std::string("read ") + name);
  if (H5Tget_class(type) != H5T_STRING || H5Tis_variable_str(type) != 0 || H5Sget_simple_extent_npoints(space) != 1)
    throw hdf5::Error(std::string("read ") + name);
  std::string text(H5Tget_size(type), '\0');
  check(H5Dread(dataset, type, H5S_ALL, H5S_ALL, H5P_DEFAULT, text.data()), std::string("read ") + name);
  text.pop_back();
  return text;
}

std::map<std::string, double> read_scalars(hid_t file) {
  std::map<std::string, double> scalars;
  const Handle group = open_group(file, scalars_name);
  H5O_info_t information;
  check(H5Oget_info2(group, &information, H5O_INFO_NUM_ATTRS), "count scalars");
  for (hsize_t i = 0; i < information.num_attrs; ++i) {
    const Handle attribute(H5Aopen_by_idx(group, ".", H5_INDEX_NAME, H5_ITER_INC, i, H5P_DEFAULT, H5P_DEFAULT),
                           H5Aclose, "read scalars");
    std::string name(static_cast<std::size_t>(check(H5Aget_name(attribute, 0, nullptr), "read scalars")) + 1, '\0');
    check(H5Aget_name(attribute, name.size(), name.data()), "read scalars");
    name.pop_back();
    read_attribute(attribute, H5T_NATIVE_DOUBLE, &scalars[name], name);
  }
  return scalars;
}

CheckpointInfo read_head(hid_t file) {
  CheckpointInfo info;
  read_number(file, time_name, H5T_NATIVE_DOUBLE, &info.time);
  read_number(file, step_name, H5T_NATIVE_INT64, &info.step);
  info.koshi_version = read_string(file, version_name);
  info.case_text = read_string(file, case_name);
  info.blob = read_string(file, blob_name);
  info.scalars = read_scalars(file);
  return info;
}

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

void read_field(hid_t group, const std::string& name, const model::Model& model, lattice::Field<double>& values) {
  if (H5Lexists(group, name.c_str(), H5P_DEFAULT) <= 0) throw InputError("it does not have the field " + name);
  const Handle dataset(H5Dopen2(group, name.c_str(), H5P_DEFAULT), H5Dclose, "open " + name);
  const Handle space(H5Dget_space(dataset), H5Sclose, "read " + name);
  const auto wanted = field_shape(values.components(), model.lattice.grid.nodes());
  std::array<hsize_t, 4> shape{};
  if (H5Sget_simple_extent_ndims(space) != 4) throw hdf5::Error("read " + name);
  check(H5Sget_simple_extent_dims(space, shape.data(), nullptr), "read " + name);
  if (shape != wanted)
    throw InputError(
        fmt::format("it is of another lattice: {} has {} components on {} x {} x {} nodes there, {} on "
                    "{} x {} x {} here",
                    name, shape[0], shape[3], shape[2], shape[1], wanted[0], wanted[3], wanted[2], wanted[1]));
  const Handle memory = memory_space(model.layout());
  for (int c = 0; c < values.components(); ++c) {
    select_owned(space, model.layout(), c);
    check(H5Dread(dataset, H5T_NATIVE_DOUBLE, memory, space, H5P_DEFAULT, values.component(c)), "read " + name);
  }
}

// Opens a whole checkpoint and calls `action` with it; errors get the file's name.
template <class F>
void with_checkpoint(fs::path file, const Communicator& communicator, F&& action) {
  if (fs::is_directory(file)) file /= "checkpoint.h5";
  check_seal(file, communicator);
  const hdf5::Silence silence;
  collectively(communicator, [&] {
    try {
      action(open_file(file));
    } catch (const InputError& error) {
      throw InputError(fmt::format("checkpoint {} does not fit: {}", file.native(), error.message()));
    } catch (const hdf5::Error& error) {
      throw InputError(fmt::format("checkpoint {} is damaged: {}", file.native(), error.what()));
    }
  });
}

}  // namespace

CheckpointInfo read_checkpoint(const fs::path& file, const model::Model& model, const std::string& case_text,
                               model::State& state, std::span<const CheckpointField> fields) {
  CheckpointInfo info;
  with_checkpoint(file, model.communicator, [&](hid_t opened) {
    info = read_head(opened);
    check_case(info, case_text);
    const Handle group = open_group(opened, fields_name);
    read_field(group, displacement_name, model, state.displacement);
    read_field(group, velocity_name, model, state.velocity);
    for (const CheckpointField& field : fields) read_field(group, field.name, model, *field.values);
    state.time = info.time;
    state.step = info.step;
  });
  return info;
}

CheckpointInfo read_checkpoint_header(const fs::path& file, const Communicator& communicator) {
  CheckpointInfo info;
  with_checkpoint(file, communicator, [&](hid_t opened) { info = read_head(opened); });
  return info;
}

}  // namespace koshi::io
