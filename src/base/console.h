// What people watch while a run goes on: lines on stderr, and on a terminal one live line below them.
#pragma once

#include <functional>
#include <string>
#include <string_view>

namespace koshi {

/// Lines scroll up, the live line stays last and is redrawn in place. A pipe has no live line.
class Console {
 public:
  using Write = std::function<void(std::string_view)>;

  /// The process's stderr. It counts as a terminal if it is one, or if the environment variable KOSHI_PROGRESS is
  /// "live" (for ranks whose output a launcher passes on to a terminal); "lines" makes it a pipe.
  static Console& standard();

  /// `width()`: columns of the terminal.
  Console(Write write, bool terminal, std::function<int()> width);

  bool terminal() const { return terminal_; }
  /// Prints a line above the live line.
  void print(std::string_view line);
  /// Replaces the live line, cut to the width of the terminal; an empty one clears it. Does nothing in a pipe.
  void show(std::string_view live);

 private:
  Write write_;
  bool terminal_;
  std::function<int()> width_;
  std::string live_;
};

}  // namespace koshi
