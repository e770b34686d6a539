#include "statics/petsc.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstdio>
#include <new>

#include "koshi/error.h"

namespace koshi::statics {

void check(PetscErrorCode code) {
  switch (code) {
    case 0:
      return;
    case PETSC_ERR_MEM:
      throw std::bad_alloc();
    case PETSC_ERR_ARG_UNKNOWN_TYPE:
    case PETSC_ERR_USER_INPUT:
      throw RunError("PETSc does not know what one of the options after -- asks for; check its value");
    case PETSC_ERR_MAT_LU_ZRPVT:
    case PETSC_ERR_MAT_CH_ZRPVT:
    case PETSC_ERR_LIB:
      throw RunError(
          "the coarsest level could not be factored: some motion of the body costs no energy; `koshi check` says what "
          "the springs can hold");
    default:
      throw RunError(fmt::format(
          "the equations could not be solved: PETSc gave up with its error {}; check the options after --, if any",
          code));
  }
}

namespace {

PetscErrorCode print_nothing(const char*, ...) { return 0; }

// Options of a set that nothing has asked for, as on a command line.
std::vector<std::string> left(PetscOptions options) {
  PetscInt count = 0;
  char **names = nullptr, **values = nullptr;
  check(PetscOptionsLeftGet(options, &count, &names, &values));
  std::vector<std::string> unused;
  for (PetscInt i = 0; i < count; ++i) unused.push_back(std::string("-") + names[i]);
  check(PetscOptionsLeftRestore(options, &count, &names, &values));
  return unused;
}

}  // namespace

PetscSession::PetscSession(const Communicator& communicator, const std::vector<std::string>& options) {
  PetscBool ready = PETSC_FALSE;
  PetscInitialized(&ready);
  // What goes wrong is said by this program.
  PetscErrorPrintf = print_nothing;
  if (ready == PETSC_FALSE) {
    // Only what this program asks for: no files, no signal handlers.
    std::vector<std::string> arguments{"koshi", "-skip_petscrc", "-no_signal_handler"};
    arguments.insert(arguments.end(), options.begin(), options.end());
    std::vector<char*> pointers;
    for (std::string& argument : arguments) pointers.push_back(argument.data());
    pointers.push_back(nullptr);
    int count = static_cast<int>(arguments.size());
    char** values = pointers.data();
    PETSC_COMM_WORLD = MPI_Comm_f2c(communicator.handle());
    if (PetscInitialize(&count, &values, nullptr, nullptr) != 0)
      throw RunError("PETSc cannot start with the options after --; check their names, values and files");
    owns_ = true;
    // What the start has taken, such as -log_view, is not asked for again.
    const std::vector<std::string> waiting = left(nullptr);
    for (const std::string& option : options)
      if (std::find(waiting.begin(), waiting.end(), option) == waiting.end()) taken_at_start_.push_back(option);
  }
  PetscPushErrorHandler(PetscReturnErrorHandler, nullptr);
  check(PetscOptionsCreate(&options_));
  std::string line;
  for (const std::string& option : options) line += option + " ";
  check(PetscOptionsInsertString(options_, line.c_str()));
  check(PetscOptionsPush(options_));
}

PetscSession::~PetscSession() {
  PetscOptionsPop();
  PetscOptionsDestroy(&options_);
  PetscPopErrorHandler();
  if (owns_ && PetscFinalize() != 0)
    fmt::print(stderr, "warning: PETSc could not write what the options after -- ask for; check their files\n");
}

std::vector<std::string> PetscSession::unused_options() const {
  std::vector<std::string> unused = left(options_);
  std::erase_if(unused, [&](const std::string& option) {
    return std::find(taken_at_start_.begin(), taken_at_start_.end(), option) != taken_at_start_.end();
  });
  return unused;
}

}  // namespace koshi::statics
