#include "failure/equilibrium_law.h"

#include "failure/bond_breaking.h"
#include "failure/bond_events.h"
#include "failure/bond_steps.h"
#include "failure/crack_events.h"
#include "failure/crack_steps.h"

namespace koshi::failure {

std::unique_ptr<EventLaw> follow_events(Fracturing& fracturing, model::Model& model, model::State& state) {
  if (auto* const breaking = dynamic_cast<BondBreaking*>(&fracturing))
    return std::make_unique<BondEvents>(*breaking, model, state);
  return std::make_unique<CrackEvents>(dynamic_cast<Cracking&>(fracturing), model, state);
}

std::unique_ptr<StepLaw> follow_steps(Fracturing& fracturing, model::Model& model, model::State& state) {
  if (auto* const breaking = dynamic_cast<BondBreaking*>(&fracturing))
    return std::make_unique<BondSteps>(*breaking, model, state);
  return std::make_unique<CrackSteps>(dynamic_cast<Cracking&>(fracturing), model, state);
}

}  // namespace koshi::failure
