// The ranks of a run. One process without a launcher is the case of one rank.
#pragma once

#include <cstdint>
#include <span>
#include <string>

namespace koshi {

/// Starts the message-passing layer for the life of the object; create one at the start of a program.
class Environment {
 public:
  /// `argc` and `argv` of main, or null; arguments of the launcher are taken out of them.
  Environment(int* argc, char*** argv);
  ~Environment();
  Environment(const Environment&) = delete;
  Environment& operator=(const Environment&) = delete;

  /// Whether somebody has started the layer.
  static bool is_running();
};

/// A group of ranks. All functions but rank() and size() are collective.
class Communicator {
 public:
  /// All ranks of the program; starts the message-passing layer if nobody has.
  static Communicator world();
  /// This rank alone.
  static Communicator self();
  /// From a Fortran handle (MPI_Comm_c2f), e.g. that of mpi4py. The caller keeps ownership.
  static Communicator from_handle(int fortran_handle);

  int rank() const;                             ///< 0 ... size - 1
  int size() const;                             ///< number of ranks
  bool is_root() const { return rank() == 0; }  ///< whether this is rank 0
  /// Fortran handle, for libraries that take an MPI communicator (PETSc, HDF5).
  int handle() const { return handle_; }

  void barrier() const;  ///< waits for all ranks
  /// Sums of integers are exact, hence independent of the number of ranks; sum floating-point numbers with ExactSum.
  void sum(std::span<std::int64_t> values) const;
  std::int64_t sum(std::int64_t value) const;  ///< of all ranks, exact
  double max(double value) const;              ///< of all ranks
  double min(double value) const;              ///< of all ranks
  bool any(bool value) const;                  ///< whether it is true on some rank
  /// The text of `root` on every rank.
  std::string broadcast(const std::string& text, int root = 0) const;
  void broadcast(std::span<double> values, int root = 0) const;  ///< the values of `root` on every rank
  /// Concatenation of every rank's values in rank order; empty on all ranks but the root.
  std::string gather(const std::string& bytes) const;
  /// The same, on all ranks.
  std::string all_gather(const std::string& bytes) const;

 private:
  explicit Communicator(int handle) : handle_(handle) {}
  int handle_;
};

}  // namespace koshi
