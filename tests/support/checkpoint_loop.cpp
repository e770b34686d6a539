// Writes checkpoint after checkpoint into a directory, from the one it finds there on, until it is killed.
#include "support/checkpoint_body.h"

int main(int argc, char** argv) {
  using namespace koshi;
  Environment environment(&argc, &argv);
  const Communicator world = Communicator::world();
  const model::Model model = model::make_model(test::checkpoint_definition(), world);
  model::State state(model);
  if (std::filesystem::exists(std::filesystem::path(argv[1]) / "checkpoint.h5"))
    io::read_checkpoint(argv[1], model, "", state);
  for (std::int64_t step = state.step + 1;; ++step) {
    test::fill(model, state, step);
    io::write_checkpoint(argv[1], model, state, {});
  }
}
