// How far the load has gone where cracks are followed event by event.
#pragma once

#include "koshi/field.h"

namespace koshi::failure {

/// The factor on displacements (ghosts too), which must outlive it: at first those of the unit load.
class LoadFactor {
 public:
  explicit LoadFactor(lattice::Field<double>& displacement) : displacement_(displacement) {}

  /// From the unit load to `factor` times it.
  void go(double factor) {
    factor_ = factor;
    scale(factor);
  }
  /// Back to the unit load.
  void unload() {
    scale(1 / factor_);
    factor_ = 1;
  }

 private:
  void scale(double by) {
    for (std::size_t i = 0; i < displacement_.count(); ++i) displacement_.data()[i] *= by;
  }

  lattice::Field<double>& displacement_;
  double factor_ = 1;  ///< of the displacements now
};

}  // namespace koshi::failure
