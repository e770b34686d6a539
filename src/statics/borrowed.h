// Memory of the state for what is needed on the way only.
#pragma once

#include "koshi/field.h"

namespace koshi::statics {

/// Memory of the state that waits for its values until the end; all zero again when this is gone.
class Borrowed {
 public:
  explicit Borrowed(lattice::Field<double>& field) : field_(field) {}
  ~Borrowed() { field_.zero(); }
  Borrowed(const Borrowed&) = delete;
  Borrowed& operator=(const Borrowed&) = delete;
  double* data() { return field_.data(); }

 private:
  lattice::Field<double>& field_;
};

}  // namespace koshi::statics
