// Errors found by some ranks become errors of all, so that none waits for the others.
#pragma once

#include <fmt/format.h>

#include <exception>

#include "koshi/communicator.h"
#include "koshi/error.h"

namespace koshi {

/// Runs `check` on every rank (collective). If any rank throws an InputError, all ranks throw the one of the first such
/// rank.
template <class F>
void collectively(const Communicator& communicator, F&& check) {
  std::exception_ptr own;
  std::string text;
  Place place;
  try {
    check();
  } catch (const InputError& error) {
    own = std::current_exception();
    text = error.message();
    place = error.place();
  }
  const int none = communicator.size();
  const int first = static_cast<int>(communicator.min(own ? communicator.rank() : none));
  if (first == none) return;
  text = communicator.broadcast(text, first);
  place.file = communicator.broadcast(place.file, first);
  std::array<double, 2> at{static_cast<double>(place.line), static_cast<double>(place.column)};
  communicator.broadcast(at, first);
  place.line = static_cast<int>(at[0]);
  place.column = static_cast<int>(at[1]);
  throw InputError(place, text);
}

}  // namespace koshi
