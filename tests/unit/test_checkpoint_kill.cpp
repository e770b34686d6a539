// A process that writes checkpoints, killed at random moments: the last checkpoint is always whole.
#include <gtest/gtest.h>
#include <signal.h>
#include <spawn.h>
#include <sys/wait.h>

#include <chrono>
#include <random>
#include <thread>
#include <utility>
#include <vector>

#include "io/checkpoint.h"
#include "support/checkpoint_body.h"
#include "support/temporary_directory.h"

namespace koshi::io {
namespace {

namespace fs = std::filesystem;

/// A process that writes checkpoints into a directory of its own, killed and started again and again.
struct Victim {
  fs::path directory;
  pid_t pid = -1;
  fs::file_time_type before{};  // of the last checkpoint when it was started
  std::int64_t step = 0;        // of the last checkpoint

  Victim() = default;
  Victim(const Victim&) = delete;
  ~Victim() {
    if (pid > 0) kill();
  }
  fs::path last() const { return directory / "checkpoint.h5"; }
  void start() {
    std::error_code ignored;
    before = fs::last_write_time(last(), ignored);
    std::string program = CHECKPOINT_LOOP, argument = directory.native();
    std::array<char*, 3> arguments{program.data(), argument.data(), nullptr};
    ASSERT_EQ(posix_spawn(&pid, program.c_str(), nullptr, nullptr, arguments.data(), environ), 0);
  }
  /// Until it has written one of its own.
  void wait_for_checkpoint() const {
    std::error_code ignored;
    while ((!fs::exists(last()) || fs::last_write_time(last(), ignored) == before) && is_alive())
      std::this_thread::sleep_for(std::chrono::milliseconds(1));
  }
  bool is_alive() const {
    siginfo_t ended{};
    return waitid(P_PID, static_cast<id_t>(pid), &ended, WEXITED | WNOHANG | WNOWAIT) == 0 && ended.si_pid == 0;
  }
  void kill() {
    ::kill(pid, SIGKILL);
    int status = 0;
    waitpid(std::exchange(pid, -1), &status, 0);
    ASSERT_TRUE(WIFSIGNALED(status)) << "it ended by itself";
  }
};

// Step of the checkpoint in the file; 0 if it is not whole or not what was written.
std::int64_t whole_step(const fs::path& file, const model::Model& model) {
  model::State state(model);
  try {
    const std::int64_t step = read_checkpoint(file, model, "", state).step;
    return test::is_filled(model, state, step) ? step : 0;
  } catch (const InputError& error) {
    ADD_FAILURE() << error.what();
    return 0;
  }
}

TEST(CheckpointKill, LastCheckpointIsWholeAtEveryMoment) {
  const Communicator world = Communicator::world();
  const test::TemporaryDirectory directory;
  const model::Model model = model::make_model(test::checkpoint_definition(), world);
  std::vector<Victim> victims(4);
  for (std::size_t v = 0; v < victims.size(); ++v) {
    victims[v].directory = directory / std::to_string(v);
    fs::create_directory(victims[v].directory);
  }
  std::mt19937 random(1);
  // At least ten rounds, and as many as it takes to hit the writing itself.
  int kills = 0, killed_while_writing = 0;
  for (int round = 0; round < 10 || killed_while_writing < 10; ++round) {
    for (Victim& victim : victims) victim.start();
    for (Victim& victim : victims) {
      // Killed up to 40 ms after a checkpoint of its own has appeared: that is after several more.
      victim.wait_for_checkpoint();
      std::this_thread::sleep_for(std::chrono::microseconds(random() % 40000));
      victim.kill();
      ++kills;
      killed_while_writing += fs::exists(victim.directory / "checkpoint.h5.part");

      // Each life goes on from what the last one left.
      const std::int64_t reached = whole_step(victim.last(), model);
      ASSERT_GT(reached, victim.step) << "after kill " << kills;
      const fs::path previous = victim.directory / "checkpoint.previous.h5";
      if (fs::exists(previous)) EXPECT_GE(whole_step(previous, model), reached - 1);
      victim.step = reached;
    }
  }
  EXPECT_GE(kills, 40);
}

}  // namespace
}  // namespace koshi::io
