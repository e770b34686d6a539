#include "koshi/communicator.h"

#include <mpi.h>

#include <cstdlib>
#include <vector>

namespace koshi {
namespace {

MPI_Comm mpi(int handle) { return MPI_Comm_f2c(handle); }

// A process without a launcher needs no daemon of one, which would want programs of a PATH and a home directory.
void start(int* argc, char*** argv) {
  ::setenv("OMPI_MCA_ess_singleton_isolated", "1", 0);
  // Nor does it need the directory in /tmp that all such processes share and the first of them to end takes away, even
  // from under one that just begins. The variable is gone before a child with ranks could inherit it.
  constexpr const char* directories = "OMPI_MCA_orte_create_session_dirs";
  const bool alone = std::getenv("OMPI_COMM_WORLD_SIZE") == nullptr && std::getenv(directories) == nullptr;
  if (alone) ::setenv(directories, "0", 1);
  // Open MPI would put the pointer that ranks share in a file there, which no file of Koshi's uses.
  ::setenv("OMPI_MCA_sharedfp", "individual", 0);
  MPI_Init(argc, argv);
  if (alone) ::unsetenv(directories);
}

}  // namespace

Environment::Environment(int* argc, char*** argv) { start(argc, argv); }
Environment::~Environment() { MPI_Finalize(); }

bool Environment::is_running() {
  int ready = 0;
  MPI_Initialized(&ready);
  return ready != 0;
}

Communicator Communicator::world() {
  if (!Environment::is_running()) start(nullptr, nullptr);
  return Communicator(MPI_Comm_c2f(MPI_COMM_WORLD));
}

Communicator Communicator::self() {
  (void)world();
  return Communicator(MPI_Comm_c2f(MPI_COMM_SELF));
}

Communicator Communicator::from_handle(int fortran_handle) { return Communicator(fortran_handle); }

int Communicator::rank() const {
  int rank = 0;
  MPI_Comm_rank(mpi(handle_), &rank);
  return rank;
}

int Communicator::size() const {
  int size = 1;
  MPI_Comm_size(mpi(handle_), &size);
  return size;
}

void Communicator::barrier() const { MPI_Barrier(mpi(handle_)); }

void Communicator::sum(std::span<std::int64_t> values) const {
  MPI_Allreduce(MPI_IN_PLACE, values.data(), static_cast<int>(values.size()), MPI_INT64_T, MPI_SUM, mpi(handle_));
}

std::int64_t Communicator::sum(std::int64_t value) const {
  sum(std::span(&value, 1));
  return value;
}

double Communicator::max(double value) const {
  MPI_Allreduce(MPI_IN_PLACE, &value, 1, MPI_DOUBLE, MPI_MAX, mpi(handle_));
  return value;
}

double Communicator::min(double value) const { return -max(-value); }

bool Communicator::any(bool value) const { return sum(value ? 1 : 0) != 0; }

std::string Communicator::broadcast(const std::string& text, int root) const {
  std::int64_t length = static_cast<std::int64_t>(text.size());
  MPI_Bcast(&length, 1, MPI_INT64_T, root, mpi(handle_));
  std::string result = rank() == root ? text : std::string(static_cast<std::size_t>(length), '\0');
  MPI_Bcast(result.data(), static_cast<int>(length), MPI_CHAR, root, mpi(handle_));
  return result;
}

void Communicator::broadcast(std::span<double> values, int root) const {
  MPI_Bcast(values.data(), static_cast<int>(values.size()), MPI_DOUBLE, root, mpi(handle_));
}

std::string Communicator::gather(const std::string& bytes) const {
  const int length = static_cast<int>(bytes.size());
  std::vector<int> lengths(static_cast<std::size_t>(size()));
  MPI_Gather(&length, 1, MPI_INT, lengths.data(), 1, MPI_INT, 0, mpi(handle_));
  std::vector<int> offsets(lengths.size() + 1, 0);
  for (std::size_t r = 0; r < lengths.size(); ++r) offsets[r + 1] = offsets[r] + lengths[r];
  std::string all(is_root() ? static_cast<std::size_t>(offsets.back()) : 0, '\0');
  MPI_Gatherv(bytes.data(), length, MPI_CHAR, all.data(), lengths.data(), offsets.data(), MPI_CHAR, 0, mpi(handle_));
  return all;
}

std::string Communicator::all_gather(const std::string& bytes) const {
  const int length = static_cast<int>(bytes.size());
  std::vector<int> lengths(static_cast<std::size_t>(size()));
  MPI_Allgather(&length, 1, MPI_INT, lengths.data(), 1, MPI_INT, mpi(handle_));
  std::vector<int> offsets(lengths.size() + 1, 0);
  for (std::size_t r = 0; r < lengths.size(); ++r) offsets[r + 1] = offsets[r] + lengths[r];
  std::string all(static_cast<std::size_t>(offsets.back()), '\0');
  MPI_Allgatherv(bytes.data(), length, MPI_CHAR, all.data(), lengths.data(), offsets.data(), MPI_CHAR, mpi(handle_));
  return all;
}

}  // namespace koshi
