// The commands of the program. Each adds its subcommand; its callback throws InputError or RunError.
#pragma once

#include <string>
#include <vector>

namespace CLI {
class App;
}

namespace koshi::app {

/// The program's own arguments, as needed to start it again on several ranks.
using Arguments = std::vector<std::string>;

/// `koshi run CASE.toml`: computes a case. `petsc`: the options after "--".
void add_run_command(CLI::App& app, const Arguments& arguments, const Arguments& petsc);

/// `koshi homogenize CASE.toml`: effective stiffness of a periodic case.
void add_homogenize_command(CLI::App& app, const Arguments& arguments, const Arguments& petsc);

/// `koshi check CASE.toml`: validates a case and says what it means.
void add_check_command(CLI::App& app);

/// `koshi calibrate`: springs from E and nu and what they give; no case is needed.
void add_calibrate_command(CLI::App& app);

/// `koshi paper`: the two analyses of Nishimura et al.
void add_paper_command(CLI::App& app);

/// `koshi report DIR`: the results of a run as one page.
void add_report_command(CLI::App& app);

/// `koshi schema`: JSON Schema of the input.
void add_schema_command(CLI::App& app);

}  // namespace koshi::app
