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
    begin(field.data() + layout().index(0, 0, 0), field.components(),
          {field.stride(), layout().pitch(), layout().plane()});
  }
  /// Distances in memory, in elements: to the next component, the next node in y, the next node in z.
  struct Strides {
    std::int64_t component, y, z;
  };
  /// The same for values stored otherwise; `origin` is component 0 of node (0, 0, 0).
  template <class T>
  void begin(T* origin, int components, const Strides& strides) const {
    constexpr std::int64_t element = sizeof(T);
    begin_bytes(reinterpret_cast<std::byte*>(origin), components,
                {strides.component * element, strides.y * element, strides.z * element}, element);
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
  void begin_bytes(std::byte* origin, int components, const Strides& bytes, std::int64_t element) const;
  struct Implementation;
  std::unique_ptr<Implementation> self_;
};

}  // namespace koshi::lattice
