#include <CLI/CLI.hpp>
#include <iostream>
#include <new>

#include "base/escape.h"
#include "commands.h"
#include "koshi/error.h"
#include "report/report.h"

namespace koshi::app {

void add_report_command(CLI::App& app) {
  CLI::App* command = app.add_subcommand("report", "Show the results in an output directory as one page, report.html");
  const auto directory = std::make_shared<std::filesystem::path>();
  command->add_option("directory", *directory, "Output directory of a run")->required();
  command->callback([directory] {
    try {
      report::write_report(*directory);
    } catch (const std::bad_alloc&) {
      throw RunError("out of memory while making the report of " + directory->string());
    }
    std::cout << "report in " << escaped((*directory / "report.html").string()) << '\n';
  });
}

}  // namespace koshi::app
