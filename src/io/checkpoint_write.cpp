#include <fcntl.h>
#include <fmt/format.h>
#include <mpi.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstdio>
#include <vector>

#include "base/collective.h"
#include "io/checkpoint.h"
#include "io/checkpoint_index.h"
#include "io/checkpoint_layout.h"
#include "io/checkpoint_seal.h"
#include "io/files.h"

namespace koshi::io {
namespace {

namespace fs = std::filesystem;
using hdf5::check;
using hdf5::Handle;

struct NamedValues {
  std::string name;
  const lattice::Field<double>* values;
};

// Bytes the file will have at most: fields, strings, and HDF5's own.
std::int64_t expected_bytes(const model::Model& model, const CheckpointInfo& info,
                            std::span<const NamedValues> fields) {
  std::int64_t bytes = (1 << 16) + static_cast<std::int64_t>(info.case_text.size() + info.blob.size());
  bytes += 2048 * static_cast<std::int64_t>(info.scalars.size() + fields.size());
  for (const NamedValues& field : fields) bytes += 8 * field.values->components() * model.lattice.grid.node_count();
  return bytes;
}

// Takes the file's space on the disk in advance. A full disk is met here, where the system gives the reason and nothing
// is half done: HDF5 and MPI cannot close a file they could not write.
void reserve(const fs::path& file, std::int64_t bytes) {
  const int descriptor = ::open(file.c_str(), O_WRONLY | O_CREAT | O_CLOEXEC, 0666);
  int error = descriptor < 0 ? errno : 0;
  if (error == 0 && ::fallocate(descriptor, 0, 0, bytes) != 0) error = errno;
  if (descriptor >= 0) ::close(descriptor);
  // A file system that cannot reserve can still tell what is free.
  if (error == EOPNOTSUPP) error = fs::space(file).available < static_cast<std::uintmax_t>(bytes) ? ENOSPC : 0;
  if (error != 0) throw RunError(fmt::format("cannot write {}: {}", file.native(), system_reason(error)));
}

void write_attribute(hid_t where, const std::string& name, hid_t file_type, hid_t memory_type, const void* value) {
  const Handle space(H5Screate(H5S_SCALAR), H5Sclose, "describe a number");
  const Handle attribute(H5Acreate2(where, name.c_str(), file_type, space, H5P_DEFAULT, H5P_DEFAULT), H5Aclose,
                         "create " + name);
  check(H5Awrite(attribute, memory_type, value), "write " + name);
}

// The file while it is written. Calls are collective; a write that fails on one rank only is remembered, so that the
// ranks stay together.
class Writer {
 public:
  Writer(const fs::path& path, const Communicator& communicator)
      : root_(communicator.is_root()), file_(create(path, communicator)) {}

  // Where the text is.
  Bytes write_string(const char* name, const std::string& text) {
    const Handle type(H5Tcopy(H5T_C_S1), H5Tclose, "describe text");
    check(H5Tset_size(type, text.size() + 1), "describe text");
    const Handle space(H5Screate(H5S_SCALAR), H5Sclose, "describe text");
    const Handle dataset = make_dataset(file_, name, type, space);
    if (root_) remember(H5Dwrite(dataset, type, H5S_ALL, H5S_ALL, H5P_DEFAULT, text.c_str()));
    return {offset_of(dataset), text.size()};
  }

  void write_head(const model::State& state, const CheckpointInfo& info) {
    write_attribute(file_, time_name, H5T_IEEE_F64LE, H5T_NATIVE_DOUBLE, &state.time);
    write_attribute(file_, step_name, H5T_STD_I64LE, H5T_NATIVE_INT64, &state.step);
    write_string(version_name, KOSHI_VERSION);
    index_.time = state.time;
    index_.step = state.step;
    index_.scalars = info.scalars;
    index_.case_text = write_string(case_name, info.case_text);
    index_.blob = write_string(blob_name, info.blob);
    const Handle group = make_group(scalars_name);
    for (const auto& [name, value] : info.scalars)
      write_attribute(group, name, H5T_IEEE_F64LE, H5T_NATIVE_DOUBLE, &value);
  }

  void write_fields(const lattice::Grid& grid, const lattice::Layout& layout, std::span<const NamedValues> fields) {
    const Handle group = make_group(fields_name);
    const Handle memory = memory_space(layout);
    const Handle transfer(H5Pcreate(H5P_DATASET_XFER), H5Pclose, "describe the transfer");
    check(H5Pset_dxpl_mpio(transfer, H5FD_MPIO_COLLECTIVE), "describe the transfer");
    for (const NamedValues& field : fields) {
      const auto shape = field_shape(field.values->components(), grid.nodes());
      const Handle space(H5Screate_simple(4, shape.data(), nullptr), H5Sclose, "describe " + field.name);
      const Handle dataset = make_dataset(group, field.name, H5T_IEEE_F64LE, space);
      IndexedField& indexed = index_.fields[field.name];
      indexed.offset = offset_of(dataset);
      std::copy(shape.begin(), shape.end(), indexed.shape.begin());
      for (int c = 0; c < field.values->components(); ++c) {
        select_owned(space, layout, c);
        remember(H5Dwrite(dataset, H5T_NATIVE_DOUBLE, memory, space, transfer, field.values->component(c)));
      }
    }
  }

  // Where everything is; the last thing to be written. Returns where that is.
  Bytes write_index() { return write_string(index_name, text_of(index_)); }

  // Throws if anything failed on any rank.
  void close(const Communicator& communicator, const fs::path& path) {
    const bool failed = communicator.any(!good_);
    // HDF5 must be able to write its own part even so, or the ranks hang: give it room.
    std::error_code ignored;
    if (failed && root_) fs::resize_file(path, 0, ignored);
    communicator.barrier();
    const bool closed = file_.close() >= 0;
    if (communicator.any(!closed) || failed) throw RunError(fmt::format("cannot write {}: HDF5 failed", path.native()));
  }

 private:
  static Handle create(const fs::path& path, const Communicator& communicator) {
    const Handle access(H5Pcreate(H5P_FILE_ACCESS), H5Pclose, "describe access");
    check(H5Pset_fapl_mpio(access, MPI_Comm_f2c(communicator.handle()), MPI_INFO_NULL), "use MPI");
    check(H5Pset_fclose_degree(access, H5F_CLOSE_STRONG), "describe access");
    const Handle creation(H5Pcreate(H5P_FILE_CREATE), H5Pclose, "describe the file");
    check(H5Pset_userblock(creation, seal_size), "describe the file");
    return Handle(H5Fcreate(path.c_str(), H5F_ACC_TRUNC, creation, access), H5Fclose, "create the file");
  }
  Handle make_group(const char* name) {
    return Handle(H5Gcreate2(file_, name, H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT), H5Gclose,
                  std::string("create ") + name);
  }
  // Contiguous and placed at once, without fill values and times: equal states give equal files.
  static Handle make_dataset(hid_t where, const std::string& name, hid_t type, hid_t space) {
    const Handle creation(H5Pcreate(H5P_DATASET_CREATE), H5Pclose, "describe " + name);
    check(H5Pset_fill_time(creation, H5D_FILL_TIME_NEVER), "describe " + name);
    check(H5Pset_alloc_time(creation, H5D_ALLOC_TIME_EARLY), "describe " + name);
    check(H5Pset_obj_track_times(creation, false), "describe " + name);
    return Handle(H5Dcreate2(where, name.c_str(), type, space, H5P_DEFAULT, creation, H5P_DEFAULT), H5Dclose,
                  "create " + name);
  }
  // From the file's first byte, the seal's.
  static std::uint64_t offset_of(hid_t dataset) {
    const haddr_t offset = H5Dget_offset(dataset);
    if (offset == HADDR_UNDEF) throw hdf5::Error("cannot place a dataset");
    return offset;
  }
  void remember(herr_t result) { good_ = good_ && result >= 0; }

  bool root_;
  bool good_ = true;
  Handle file_;
  CheckpointIndex index_;
};

// Gives the file its name and keeps its predecessor; checkpoint.h5 is there at every moment.
void rotate(const fs::path& directory) {
  const fs::path current = directory / "checkpoint.h5", previous = directory / "checkpoint.previous.h5";
  std::error_code error;
  if (fs::exists(current, error)) {
    fs::remove(previous, error);
    fs::create_hard_link(current, previous, error);
    // A file system without links: for a moment only the previous one is there.
    if (error) fs::rename(current, previous, error);
  }
  fs::rename(part_of(current), current, error);
  if (error) throw RunError(fmt::format("cannot write {}: {}", current.native(), error.message()));
  flush_to_disk(directory);
}

}  // namespace

void write_checkpoint(const fs::path& directory, const model::Model& model, const model::State& state,
                      const CheckpointInfo& info, std::span<const CheckpointField> fields) {
  const Communicator& communicator = model.communicator;
  const fs::path part = part_of(directory / "checkpoint.h5");
  std::vector<NamedValues> all{{displacement_name, &state.displacement}, {velocity_name, &state.velocity}};
  for (const CheckpointField& field : fields) all.push_back({field.name, field.values});
  const std::int64_t bytes = expected_bytes(model, info, all);
  collectively(communicator, [&] {
    if (communicator.is_root()) fresh_part_of(directory / "checkpoint.h5");
  });
  const auto reserve_space = [&] {
    collectively(communicator, [&] {
      if (communicator.is_root()) reserve(part, bytes);
    });
  };

  const hdf5::Silence silence;
  try {
    // Reserved twice, since HDF5 begins by emptying the file: the first time to be sure it can end what it begins.
    reserve_space();
    Writer writer(part, communicator);
    reserve_space();
    writer.write_head(state, info);
    writer.write_fields(model.lattice.grid, model.layout(), all);
    const Bytes index = writer.write_index();
    writer.close(communicator, part);
    seal_checkpoint(part, index, communicator);
    collectively(communicator, [&] {
      if (communicator.is_root()) rotate(directory);
    });
  } catch (const std::exception& error) {
    std::error_code ignored;
    if (communicator.is_root()) fs::remove(part, ignored);
    throw RunError(error.what());
  }
}

}  // namespace koshi::io
