// Errors found by some ranks become errors of all, so that none waits for the others.
#pragma once

#include <array>
#include <exception>

#include "koshi/communicator.h"
#include "koshi/error.h"

namespace koshi {

/// Runs `action` on every rank (collective). If it throws on any rank, all ranks throw what it threw on the first such
/// rank: an InputError stays one, every other exception becomes a RunError with its text.
template <class F>
void collectively(const Communicator& communicator, F&& action) {
  bool threw = false;
  std::array<double, 3> about{};  // input error?, line, column
  std::string text, file;
  try {
    action();
  } catch (const InputError& error) {
    threw = true;
    text = error.message();
    file = error.place().file;
    about = {1, static_cast<double>(error.place().line), static_cast<double>(error.place().column)};
  } catch (const std::exception& error) {
    threw = true;
    text = error.what();
  }
  const int none = communicator.size();
  const int first = static_cast<int>(communicator.min(threw ? communicator.rank() : none));
  if (first == none) return;
  text = communicator.broadcast(text, first);
  file = communicator.broadcast(file, first);
  communicator.broadcast(about, first);
  if (about[0] == 0) throw RunError(text);
  throw InputError(Place{file, static_cast<int>(about[1]), static_cast<int>(about[2])}, text);
}

}  // namespace koshi
