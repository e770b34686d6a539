// Exchange of ghost nodes between ranks (and across periodic borders).
#pragma once

#include <memory>
#include <span>
#include <vector>

#include "koshi/communicator.h"
#include "koshi/field.h"
#include "lattice/partition.h"

namespace koshi::lattice {

/// Fills the ghost layer of node fields from the ranks that own those nodes, edges and corners included. Ghosts outside
/// the body are left alone. begin() and end() are collective over the neighbours; work on inner nodes may go between.
class Halo {
 public:
  Halo(const Grid& grid, const Partition& partition, const Communicator& communicator);
  ~Halo();
  Halo(Halo&&) noexcept;
  Halo& operator=(Halo&&) noexcept;

  /// Starts sending the border nodes of `field`; the field's owned nodes must not change before end().
  template <class T>
  void begin(Field<T>& field) const {
    begin_bytes(reinterpret_cast<std::byte*>(field.data()), field.components(),
                field.stride() * static_cast<std::int64_t>(sizeof(T)), sizeof(T));
  }
  /// Waits for the ghosts of the field given to begin().
  void end() const;

  template <class T>
  void exchange(Field<T>& field) const {
    begin(field);
    end();
  }

  /// False when no ghost node has an owner (one rank, nothing periodic): exchanges do nothing.
  bool active() const;
  const Layout& layout() const;
  const Communicator& communicator() const;

 private:
  void begin_bytes(std::byte* data, int components, std::int64_t stride, std::size_t element) const;
  struct Implementation;
  std::unique_ptr<Implementation> self_;
};

}  // namespace koshi::lattice
