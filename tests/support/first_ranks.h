// Groups of ranks for tests that compare runs on different numbers of ranks in one program.
#pragma once

#include <mpi.h>

#include <optional>

#include "koshi/communicator.h"

namespace koshi::test {

/// The first `count` ranks of the program; empty on the others (collective over all ranks).
inline std::optional<Communicator> first_ranks(int count) {
  const int rank = Communicator::world().rank();
  MPI_Comm group = MPI_COMM_NULL;
  MPI_Comm_split(MPI_COMM_WORLD, rank < count ? 0 : MPI_UNDEFINED, rank, &group);
  if (group == MPI_COMM_NULL) return std::nullopt;
  return Communicator::from_handle(MPI_Comm_c2f(group));
}

}  // namespace koshi::test
