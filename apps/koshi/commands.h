// The commands of the program. Each adds its subcommand; its callback throws InputError or RunError.
#pragma once

namespace CLI {
class App;
}

namespace koshi::app {

/// `koshi calibrate`: springs from E and nu and what they give; no case is needed.
void add_calibrate_command(CLI::App& app);

}  // namespace koshi::app
