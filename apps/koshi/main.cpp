// The program `koshi`. Exit code 0: done, 1: the run failed, 2: bad input.
#include <CLI/CLI.hpp>
#include <algorithm>
#include <cerrno>
#include <csignal>
#include <cstdio>
#include <exception>
#include <iostream>
#include <sstream>

#include "base/escape.h"
#include "base/out_of_memory.h"
#include "base/suggest.h"
#include "commands.h"
#include "io/files.h"
#include "koshi/error.h"

namespace {

// What was printed must have arrived: a full disk behind "> file" is a failure.
int finish(int code) {
  errno = 0;
  std::cout.flush();
  if (std::fflush(stdout) == 0 && std::cout) return code;
  std::cerr << "error: cannot write to the standard output: " << koshi::io::system_reason(errno != 0 ? errno : EIO)
            << '\n';
  return code == 0 ? 1 : code;
}

// An option that the command does not have, with the nearest that it has; empty if it was something else.
std::string unknown_option(const CLI::App& app, const std::vector<std::string>& arguments) {
  if (app.get_subcommands().empty()) return {};
  const CLI::App& command = *app.get_subcommands().front();
  std::vector<std::string> known;
  for (const CLI::Option* option : command.get_options())
    if (!option->get_lnames().empty()) known.push_back("--" + option->get_lnames().front());
  for (const std::string& argument : arguments) {
    const std::string name = argument.substr(0, argument.find('='));
    if (name.starts_with("--") && std::find(known.begin(), known.end(), name) == known.end())
      return "error: koshi " + command.get_name() + " has no option \"" + name + "\"; " +
             koshi::suggestion(name, known) + '\n';
  }
  return {};
}

}  // namespace

int main(int argc, char** argv) {
  // A file that may not grow (ulimit -f) is an error of the write, which says which file, not the end of the program.
  std::signal(SIGXFSZ, SIG_IGN);
  using koshi::app::Arguments;
  const Arguments all(argv, argv + argc);
  // What follows "--" is for PETSc.
  const auto separator = std::find(all.begin(), all.end(), "--");
  const Arguments own(all.begin(), separator);
  const Arguments petsc(separator == all.end() ? separator : separator + 1, all.end());

  CLI::App app{"Koshi: lattice spring engine for elastic solids", "koshi"};
  app.set_version_flag("--version", "koshi " KOSHI_VERSION);
  app.require_subcommand(1);
  koshi::app::add_run_command(app, all, petsc);
  koshi::app::add_homogenize_command(app, all, petsc);
  koshi::app::add_check_command(app);
  koshi::app::add_calibrate_command(app);
  koshi::app::add_paper_command(app);
  koshi::app::add_report_command(app);
  koshi::app::add_schema_command(app);
  try {
    // CLI11 would only say that a command is missing.
    std::vector<std::string> known;
    for (const CLI::App* command : app.get_subcommands({})) known.push_back(command->get_name());
    if (own.size() > 1 && !own[1].starts_with('-') && std::find(known.begin(), known.end(), own[1]) == known.end())
      throw koshi::InputError("there is no command \"" + own[1] + "\"; " + koshi::suggestion(own[1], known));
    // CLI11 takes the arguments in reverse order, without the program's name.
    Arguments reversed(own.rbegin(), own.rend() - 1);
    app.parse(reversed);
    return finish(0);
  } catch (const CLI::Success& success) {
    return finish(app.exit(success));
  } catch (const CLI::ParseError& error) {
    std::ostringstream text;
    text << unknown_option(app, own);
    if (text.str().empty()) app.exit(error, text, text);
    std::cerr << koshi::escaped(text.str(), true);
    return 2;
  } catch (const koshi::InputError& error) {
    std::cerr << error.what() << '\n';
    return 2;
  } catch (const koshi::OutOfMemory& error) {
    std::cerr << "error: " << error.what() << '\n';
    return 1;
  } catch (const std::bad_alloc&) {
    std::cerr << "error: out of memory; `koshi check` says how much a run takes\n";
    return 1;
  } catch (const std::exception& error) {
    std::cerr << "error: " << koshi::escaped(error.what(), true) << '\n';
    return 1;
  }
}
