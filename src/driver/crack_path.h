// What a static analysis that follows its cracks has found.
#pragma once

#include <cstdint>
#include <string>

namespace koshi::driver {

struct CrackPath {
  std::int64_t events = 0;       ///< event by event: rows of the history beside the first
  std::int64_t steps = 0;        ///< in steps: those that were made
  std::int64_t equilibria = 0;   ///< in steps: solves of all
  std::int64_t cracked = 0;      ///< cells that have cracked
  std::int64_t parted = 0;       ///< cells that have cracked through
  std::int64_t peak_event = 0;   ///< event by event: at which the body carried the most
  double peak_load_factor = 0;   ///< on loads and motions at that event
  std::int64_t hierarchies = 1;  ///< times that the solver's levels were made
  std::string reason;            ///< why it ended, in words
  std::string endless;           ///< in steps: of the next one, which has found no end, and what to do; empty: none
};

}  // namespace koshi::driver
