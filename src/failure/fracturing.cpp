#include "failure/fracturing.h"

#include "base/exact_sum.h"

namespace koshi::failure {

std::int64_t Fracturing::count_cells(double at_least) const {
  std::int64_t number = 0;
  lattice::for_each_owned(model_.layout(), [&](auto, auto, auto, auto n) {
    const bool cracked = state_.crack.component(kappa)[n] != 0;
    number += cracked && state_.crack.component(damage)[n] >= at_least ? 1 : 0;
  });
  return model_.communicator.sum(number);
}

double Fracturing::energy_taken() const {
  ExactSum sum;
  lattice::for_each_owned(model_.layout(),
                          [&](auto, auto, auto, auto n) { sum += state_.crack.component(dissipated)[n]; });
  sum.sum_ranks(model_.communicator);
  return sum.value();
}

void Fracturing::complete(mechanics::Balance& balance) const {
  ExactSum stored, given, damped;
  lattice::for_each_owned(model_.layout(), [&](auto, auto, auto, auto n) {
    given += state_.work.component(0)[n];
    damped += state_.work.component(1)[n];
    if (state_.crack.component(kappa)[n] != 0) stored += stored_energy(n);
  });
  for (ExactSum* sum : {&stored, &given, &damped}) sum->sum_ranks(model_.communicator);
  balance.elastic_energy += stored.value();
  balance.leapfrog_energy += stored.value();
  balance.cracked = energy_taken();
  balance.given += given.value();  // to that of the half step since
  balance.damped = damped.value();
}

}  // namespace koshi::failure
