// The fields a run writes, computed from its state.
#pragma once

#include <list>
#include <vector>

#include "io/field_writer.h"
#include "mechanics/measure.h"

namespace koshi::driver {

/// Fields of one sample; owns those that the state does not hold.
class FieldSet {
 public:
  /// `names` as in output.fields (collective; exchanges ghosts of the displacements).
  FieldSet(const std::vector<std::string>& names, const model::Model& model, model::State& state,
           mechanics::Meter& meter);

  const std::vector<io::FieldData>& fields() const { return fields_; }

 private:
  void add(const std::string& name, const model::Model& model, model::State& state, mechanics::Meter& meter);

  std::vector<io::FieldData> fields_;
  std::list<lattice::Field<double>> computed_;
};

}  // namespace koshi::driver
