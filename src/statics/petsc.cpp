#include "statics/petsc.h"

#include <fmt/format.h>

#include "koshi/error.h"

namespace koshi::statics {

void check(PetscErrorCode code) {
  if (code == 0) return;
  const char* text = nullptr;
  char* specific = nullptr;
  PetscErrorMessage(code, &text, &specific);
  throw RunError(fmt::format("PETSc stopped: {}{}{}", text != nullptr ? text : "error",
                             specific != nullptr && *specific != '\0' ? ": " : "",
                             specific != nullptr ? specific : ""));
}

PetscSession::PetscSession(const Communicator& communicator, const std::vector<std::string>& options) {
  PetscBool ready = PETSC_FALSE;
  PetscInitialized(&ready);
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
    check(PetscInitialize(&count, &values, nullptr, nullptr));
    owns_ = true;
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
  if (owns_) PetscFinalize();
}

std::vector<std::string> PetscSession::unused_options() const {
  PetscInt count = 0;
  char **names = nullptr, **values = nullptr;
  check(PetscOptionsLeftGet(options_, &count, &names, &values));
  std::vector<std::string> unused;
  for (PetscInt i = 0; i < count; ++i) unused.push_back(std::string("-") + names[i]);
  check(PetscOptionsLeftRestore(options_, &count, &names, &values));
  return unused;
}

}  // namespace koshi::statics
