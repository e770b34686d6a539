// The checkpoint reader against arbitrary files. An input that begins with "patch" is a list of changes (two bytes
// offset, one byte value) to a whole checkpoint; one that begins with "index" is an index for it, with a right seal;
// any other is a file of its own. A file is read or refused with an InputError; a whole checkpoint that was changed
// behind its seal is always refused.
#include <cstdlib>
#include <cstring>
#include <fstream>

#include "io/checkpoint.h"
#include "io/checkpoint_seal.h"
#include "io/files.h"
#include "support/temporary_directory.h"

namespace {

using namespace koshi;

/// A body of one cell and its checkpoint.
struct Fixture {
  test::TemporaryDirectory directory;
  std::filesystem::path file = directory / "checkpoint.h5";
  model::Model model = make();
  model::State state{model};
  std::string whole;

  Fixture() {
    io::CheckpointInfo info;
    info.case_text = "[lattice]\nspacing = 1\n";
    info.scalars["energy"] = 1;
    io::write_checkpoint(directory.path(), model, state, info);
    whole = io::read_file(file);
  }
  static model::Model make() {
    model::Definition definition;
    definition.lattice.spacing = 1;
    definition.body.size = {1, 1, 1};
    definition.body.material = "rock";
    definition.materials = {{"rock", {1e9, 0.2, 1000}}};
    return model::make_model(definition, Communicator::world());
  }
};

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static Fixture fixture;
  std::string bytes(reinterpret_cast<const char*>(data), size);
  bool sealed_damage = false;
  if (bytes.starts_with("patch")) {
    std::string patched = fixture.whole;
    for (std::size_t at = 5; at + 2 < size; at += 3)
      patched[(data[at] + 256u * data[at + 1]) % patched.size()] = static_cast<char>(data[at + 2]);
    sealed_damage =
        patched != fixture.whole && patched.substr(0, io::seal_size) == fixture.whole.substr(0, io::seal_size);
    bytes = patched;
  }
  if (bytes.starts_with("index")) {
    const io::Bytes place{fixture.whole.size(), size - 5};
    std::ofstream(fixture.file, std::ios::binary | std::ios::trunc) << fixture.whole + bytes.substr(5);
    io::seal_checkpoint(fixture.file, place, fixture.model.communicator);
  } else {
    std::ofstream(fixture.file, std::ios::binary | std::ios::trunc) << bytes;
  }
  try {
    io::read_checkpoint(fixture.file, fixture.model, "[lattice]\nspacing = 1\n", fixture.state);
    if (sealed_damage) std::abort();
  } catch (const InputError&) {
  }
  return 0;
}
