#include "driver/step_work.h"

#include <array>

#include "base/exact_sum.h"

namespace koshi::driver {

StepWork::StepWork(const model::Model& model, mechanics::Meter& meter)
    : model_(model),
      meter_(meter),
      loads_(model),
      force_(model.layout(), model.components()),
      displacement_(model.layout(), model.components()) {}

double StepWork::add(model::State& state, double bend) {
  const lattice::Layout& layout = model_.layout();
  lattice::Field<double> force = meter_.reactions(state);
  loads_.set_time(state.time);
  for (std::int64_t k = 0; k < layout.owned()[2]; ++k)
    for (std::int64_t j = 0; j < layout.owned()[1]; ++j) {
      std::array<double*, 6> row{};
      for (int c = 0; c < force.components(); ++c)
        row[static_cast<std::size_t>(c)] = force.component(c) + layout.index(0, j, k);
      loads_.add(j, k, row.data());
    }
  ExactSum sum;
  lattice::for_each_owned(layout, [&](auto, auto, auto, auto n) {
    double work = 0;
    for (int c = 0; c < force.components(); ++c)
      work += 0.5 * (force_.component(c)[n] + force.component(c)[n]) *
              (state.displacement.component(c)[n] - displacement_.component(c)[n]);
    sum += work;
  });
  sum.sum_ranks(model_.communicator);
  force_ = std::move(force);
  displacement_ = state.displacement;
  return work_ += sum.value() + bend;
}

}  // namespace koshi::driver
