// Files that are no checkpoint of this case: each is refused with its reason, none crashes the reader.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <hdf5.h>

#include <fstream>

#include "io/checkpoint.h"
#include "io/checkpoint_seal.h"
#include "io/files.h"
#include "support/checkpoint_body.h"
#include "support/temporary_directory.h"

namespace koshi::io {
namespace {

namespace fs = std::filesystem;
using testing::AllOf;
using testing::HasSubstr;
using testing::Not;
using testing::ThrowsMessage;

const std::string case_text = "[lattice]\ncell = \"cube-III\"\nspacing = 0.25\n\n[material.rock]\ndensity = 1000\n";

class CheckpointErrors : public testing::Test {
 protected:
  CheckpointErrors() {
    test::fill(model, state, 7);
    CheckpointInfo info;
    info.case_text = case_text;
    info.scalars["energy"] = 1;
    write_checkpoint(directory.path(), model, state, info);
    whole = read_file(file);
  }
  void expect_refused(const std::string& content, const std::string& reason) {
    replace_file(file, content);
    EXPECT_THAT([&] { read_checkpoint(file, model, case_text, state); },
                ThrowsMessage<InputError>(AllOf(HasSubstr(file.native()), HasSubstr(reason))));
  }

  const Communicator world = Communicator::world();
  const test::TemporaryDirectory directory;
  const fs::path file = directory / "checkpoint.h5";
  const model::Model model = model::make_model(test::checkpoint_definition(), world);
  model::State state{model};
  std::string whole;
};

TEST_F(CheckpointErrors, WholeFileIsAccepted) {
  test::fill(model, state, 0);
  EXPECT_EQ(read_checkpoint(directory.path(), model, case_text, state).step, 7);
  EXPECT_TRUE(test::is_filled(model, state, 7));
}

TEST_F(CheckpointErrors, MissingFile) {
  fs::remove(file);
  EXPECT_THAT([&] { read_checkpoint(file, model, case_text, state); },
              ThrowsMessage<InputError>(AllOf(HasSubstr("checkpoint " + file.native() + " cannot be opened"),
                                              HasSubstr("No such file or directory"), Not(HasSubstr("try")))));
}

TEST_F(CheckpointErrors, PredecessorIsSuggested) {
  replace_file(directory / "checkpoint.previous.h5", whole);
  const std::string remedy = "; try " + (directory / "checkpoint.previous.h5").native();
  expect_refused("", remedy);
  fs::remove(file);
  EXPECT_THAT([&] { read_checkpoint(directory.path(), model, case_text, state); },
              ThrowsMessage<InputError>(HasSubstr(remedy)));
  EXPECT_EQ(read_checkpoint_header(directory / "checkpoint.previous.h5", world).step, 7);
}

TEST_F(CheckpointErrors, ForeignFiles) {
  expect_refused("", "is no checkpoint of Koshi");
  expect_refused("time,step\n0,1\n", "is no checkpoint of Koshi");
  expect_refused(std::string(10000, '\0'), "is no checkpoint of Koshi");
  const fs::path foreign = directory / "foreign.h5";
  H5Fclose(H5Fcreate(foreign.c_str(), H5F_ACC_TRUNC, H5P_DEFAULT, H5P_DEFAULT));
  expect_refused(read_file(foreign), "is an HDF5 file, but no checkpoint of Koshi");
}

TEST_F(CheckpointErrors, OtherFormatVersion) {
  std::string other = whole;
  other.replace(other.find("format 2"), 8, "format 3");
  expect_refused(other, "has checkpoint format 3, this Koshi reads format 2; go on with Koshi " KOSHI_VERSION);
}

TEST_F(CheckpointErrors, CutShortAnywhere) {
  int count = 0;
  for (std::size_t length = seal_size; length < whole.size(); length += 997, ++count)
    expect_refused(whole.substr(0, length), "is cut short");
  EXPECT_GT(count, 30);
  expect_refused(whole + "x", "is cut short");
}

TEST_F(CheckpointErrors, AnyChangedByteIsFound) {
  // Every byte of the seal and of HDF5's first structures, and every 13th of the rest, changed in place.
  std::fstream damage(file, std::ios::binary | std::ios::in | std::ios::out);
  const auto put = [&](std::size_t at, int byte) {
    damage.seekp(static_cast<std::streamoff>(at));
    damage.put(static_cast<char>(byte)).flush();
  };
  int count = 0, refused = 0;
  for (std::size_t at = 0; at < whole.size(); at += at < 4096 ? 1 : 13, ++count) {
    put(at, whole[at] ^ (1 << at % 8));
    try {
      read_checkpoint(file, model, case_text, state);
    } catch (const InputError&) {
      ++refused;
    }
    put(at, whole[at]);
  }
  EXPECT_EQ(refused, count);
  EXPECT_GT(count, 4096 + 2000);
  EXPECT_NO_THROW(read_checkpoint(file, model, case_text, state)) << "all damage was undone";
}

TEST_F(CheckpointErrors, CorruptedContentIsCalledSo) {
  std::string damaged = whole;
  damaged[20000] = static_cast<char>(damaged[20000] + 1);
  expect_refused(damaged, "is corrupted: its checksum is ");
}

// Made by hand, with a right seal: what the seal and the index say is held against the file before anything is read,
// and HDF5's structures are not looked at.
TEST_F(CheckpointErrors, ForgedFilesAreRefusedByTheirIndex) {
  const auto forge = [&](const std::string& index, Bytes place) {
    replace_file(file, whole + index);
    seal_checkpoint(file, place, world);
    return read_file(file);
  };
  const auto put = [&](const std::string& index) { return forge(index, {whole.size(), index.size()}); };
  const std::string head = "time 0.5\nstep 7\ncase 600 0\nblob 600 0\n";
  expect_refused(forge("", {whole.size() + 1, 0}), "has its index behind its end");
  expect_refused(forge("", {~0ULL, 2}), "has its index behind its end");
  expect_refused(forge("", {0, 10}), "has its index behind its end");
  int count = 0;
  for (const std::string line : {"time -1",
                                 "time nan",
                                 "time inf",
                                 "time",
                                 "step -1",
                                 "step 1e3",
                                 "step 99999999999999999999",
                                 "case 0 10",
                                 "case 600 18446744073709551615",
                                 "case 18446744073709551615 1",
                                 "blob 100000000 0",
                                 "blob -1 0",
                                 "scalar x y",
                                 "scalar 1",
                                 "field 600 1 1 1",
                                 "field 600 0 1 1 1 u",
                                 "field 600 -1 -1 1 1 u",
                                 "field 600 1 1 1 100000000 u",
                                 "field 600 4294967296 4294967296 4294967296 4294967296 u",
                                 "field 0 1 1 1 1 u",
                                 "field 1e3 1 1 1 1 u",
                                 "step 7 more",
                                 "%n",
                                 "",
                                 "\x1b[2J"}) {
    expect_refused(put(head + line + "\n"), "its index has the line \"");
    ++count;
  }
  EXPECT_EQ(count, 25);
  expect_refused(put("time 0\nstep 0\n"), "its index lacks time, step, case or blob");
  expect_refused(put(head), "it is of another case");
}

TEST_F(CheckpointErrors, StructuresOfHdf5AreNotRead) {
  // All that HDF5 has in front of the first text, and behind the last field.
  const std::string index = whole.substr(whole.rfind("time "), whole.rfind("velocity\n") + 9 - whole.rfind("time "));
  std::string forged = whole;
  std::fill(forged.begin() + seal_size, forged.begin() + seal_size + 512, '\xff');
  replace_file(file, forged + index);
  seal_checkpoint(file, {forged.size(), index.size()}, world);
  test::fill(model, state, 0);
  EXPECT_EQ(read_checkpoint(file, model, case_text, state).step, 7);
  EXPECT_TRUE(test::is_filled(model, state, 7));
}

TEST_F(CheckpointErrors, OtherCaseSaysWhatDiffers) {
  std::string other = case_text;
  other.replace(other.find("0.25"), 4, "0.125");
  EXPECT_THAT([&] { read_checkpoint(file, model, other, state); },
              ThrowsMessage<InputError>(
                  HasSubstr("is of another case: in [lattice] `spacing = 0.25` there, `spacing = 0.125` here")));
  EXPECT_THAT(
      [&] { read_checkpoint(file, model, case_text + "youngs_modulus = 1\n", state); },
      ThrowsMessage<InputError>(HasSubstr("in [material.rock] `nothing more` there, `youngs_modulus = 1` here")));
  EXPECT_THAT([&] { read_checkpoint(file, model, "", state); },
              ThrowsMessage<InputError>(HasSubstr("another case: `[lattice]` there, `nothing more` here")));
}

TEST_F(CheckpointErrors, OtherLattice) {
  const model::Model finer = model::make_model(test::checkpoint_definition(false, 0.125), world);
  model::State fine(finer);
  EXPECT_THAT(
      [&] { read_checkpoint(file, finer, case_text, fine); },
      ThrowsMessage<InputError>(HasSubstr("of another lattice: displacement has 6 components on 8 x 6 x 7 nodes "
                                          "there, 6 on 15 x 11 x 13 here")));
  auto definition = test::checkpoint_definition();
  definition.lattice.kinematics = material::Kinematics::least_squares;
  const model::Model three = model::make_model(definition, world);
  model::State translations(three);
  EXPECT_THAT([&] { read_checkpoint(file, three, case_text, translations); },
              ThrowsMessage<InputError>(HasSubstr("6 components on 8 x 6 x 7 nodes there, 3 on 8 x 6 x 7 here")));
}

TEST_F(CheckpointErrors, MissingField) {
  lattice::Field<double> orientation(model.layout(), 4);
  EXPECT_THAT(
      [&] {
        read_checkpoint(file, model, case_text, state, std::array{CheckpointField{"orientation", &orientation}});
      },
      ThrowsMessage<InputError>(HasSubstr("it does not have the field orientation")));
}

}  // namespace
}  // namespace koshi::io
