#include <CLI/CLI.hpp>

#include "commands.h"
#include "study/paper.h"

namespace koshi::app {

void add_paper_command(CLI::App& app) {
  CLI::App* command =
      app.add_subcommand("paper", "Reproduce the two analyses of Nishimura et al.: tables, curves and fields");
  const auto directory = std::make_shared<std::string>("paper.out");
  const auto quiet = std::make_shared<bool>(false);
  command->add_option("--out", *directory, "Output directory")->capture_default_str();
  command->add_flag("--quiet", *quiet, "Print the tables only");
  command->callback([directory, quiet] {
    const Environment environment(nullptr, nullptr);
    study::run_paper(*directory, *quiet, Communicator::world());
  });
}

}  // namespace koshi::app
