#include "launch.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <csignal>
#include <cstdlib>
#include <cstring>
#include <iostream>
#include <thread>

#include "koshi/error.h"

namespace koshi::app {
namespace {

constexpr rlim_t shared_file_bytes = 16'000'000;

volatile std::sig_atomic_t launcher = 0;  // process number of mpiexec
volatile std::sig_atomic_t interrupts = 0;
volatile std::sig_atomic_t asked_to_stop = 0;

// mpiexec ends its ranks a second after a SIGINT or SIGTERM, whatever they are writing. It passes SIGUSR1 on to them,
// which asks a run to stop after a checkpoint. A second Ctrl-C means it.
void pass_on(int signal) {
  asked_to_stop = 1;
  if (signal == SIGINT) interrupts = interrupts + 1;
  kill(launcher, interrupts > 1 ? SIGTERM : SIGUSR1);
}

void set_environment(int ranks) {
  // Open MPI refuses to run as root and on fewer cores than ranks unless told; both are the user's decision here.
  setenv("OMPI_ALLOW_RUN_AS_ROOT", "1", 0);
  setenv("OMPI_ALLOW_RUN_AS_ROOT_CONFIRM", "1", 0);
  setenv("OMPI_MCA_rmaps_base_oversubscribe", "1", 0);
  setenv("OMPI_MCA_btl_vader_single_copy_mechanism", "none", 0);
  // What went wrong is said by Koshi.
  setenv("OMPI_MCA_orte_execute_quiet", "1", 0);
  // Ranks without a core of their own must not spin while they wait for the others.
  if (static_cast<unsigned>(ranks) > std::thread::hardware_concurrency())
    setenv("OMPI_MCA_mpi_yield_when_idle", "1", 0);
  // The launcher passes on what the ranks print; the live line still works if this process has a terminal.
  if (isatty(STDERR_FILENO)) setenv("KOSHI_PROGRESS", "live", 0);
}

// Becomes mpiexec: out of reach of the terminal's Ctrl-C, ended when this program is, and printing into a pipe.
[[noreturn]] void become_launcher(std::vector<std::string>& command, int printed) {
  setpgid(0, 0);
  dup2(printed, STDOUT_FILENO);
  prctl(PR_SET_PDEATHSIG, SIGTERM);
  const int nothing = open("/dev/null", O_RDONLY);
  if (nothing >= 0) dup2(nothing, STDIN_FILENO);
  std::vector<char*> pointers;
  for (std::string& argument : command) pointers.push_back(argument.data());
  pointers.push_back(nullptr);
  execvp("mpiexec", pointers.data());
  std::cerr << fmt::format(
      "--ranks: error: cannot start mpiexec: {}; install an MPI launcher (Debian: openmpi-bin), or leave --ranks out\n",
      std::strerror(errno));
  std::_Exit(2);
}

// Copies what comes out of a pipe to the standard output, to the end of the pipe; 0, or the error number of the first
// write that failed. mpiexec would lose the output without a word.
int print_all(int pipe) {
  std::signal(SIGPIPE, SIG_IGN);
  int failure = 0;
  char block[4096];
  for (ssize_t length; (length = read(pipe, block, sizeof block)) != 0;) {
    if (length < 0 && errno == EINTR) continue;
    if (length < 0) return errno;
    for (const char* at = block; length > 0 && failure == 0;) {
      const ssize_t written = write(STDOUT_FILENO, at, static_cast<std::size_t>(length));
      if (written < 0 && errno != EINTR) failure = errno;
      if (written <= 0) continue;
      at += written;
      length -= written;
    }
  }
  return failure;
}

}  // namespace

bool is_launched() {
  // Set by Open MPI, and by MPICH and its relatives.
  return std::getenv("OMPI_COMM_WORLD_SIZE") != nullptr || std::getenv("PMI_SIZE") != nullptr;
}

void launch(int ranks, const std::vector<std::string>& arguments) {
  if (const char* path = std::getenv("PATH"); path == nullptr || *path == 0)
    throw InputError(Place{"--ranks"},
                     "the environment has no PATH, where mpiexec and its helpers are looked for; set it, such as "
                     "PATH=/usr/bin:/bin, or leave --ranks out");
  // Open MPI's processes wait for each other for ever when they cannot make the files of 4 MB that they share.
  rlimit files{};
  getrlimit(RLIMIT_FSIZE, &files);
  if (files.rlim_cur < shared_file_bytes)
    throw InputError(
        Place{"--ranks"},
        fmt::format("files may have at most {} bytes (ulimit -f); several ranks share files of more: allow "
                    "{}, or leave --ranks out",
                    files.rlim_cur, shared_file_bytes));
  set_environment(ranks);
  std::vector<std::string> command{"mpiexec", "-n", std::to_string(ranks), "/proc/self/exe"};
  std::vector<char> self(4096);
  const ssize_t length = readlink("/proc/self/exe", self.data(), self.size());
  if (length > 0) command.back().assign(self.data(), static_cast<std::size_t>(length));
  command.insert(command.end(), arguments.begin() + 1, arguments.end());

  int printed[2];
  if (pipe2(printed, O_CLOEXEC) != 0) throw RunError(fmt::format("cannot start mpiexec: {}", std::strerror(errno)));
  const pid_t child = fork();
  if (child < 0) throw RunError(fmt::format("cannot start mpiexec: {}", std::strerror(errno)));
  if (child == 0) become_launcher(command, printed[1]);
  close(printed[1]);
  launcher = child;
  // nohup lets SIGHUP be ignored, and so it stays.
  for (const int signal : {SIGINT, SIGTERM, SIGUSR1, SIGUSR2, SIGXCPU, SIGHUP})
    if (std::signal(signal, pass_on) == SIG_IGN) std::signal(signal, SIG_IGN);
  const int failure = print_all(printed[0]);
  int status = 0;
  while (waitpid(child, &status, 0) < 0 && errno == EINTR) {
  }
  // mpiexec ends with the code of the first rank that failed, 128 and the signal if one was killed.
  const int code = WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
  if (code > 128)
    std::cerr << (asked_to_stop ? std::string("error: ended by a signal before a checkpoint was written\n")
                                : fmt::format("error: a process of the run was ended by signal {} ({})\n", code - 128,
                                              strsignal(code - 128)));
  if (failure != 0) std::cerr << "error: cannot write to the standard output: " << std::strerror(failure) << '\n';
  std::exit(code > 128 || (code == 0 && failure != 0) ? 1 : code);
}

}  // namespace koshi::app
