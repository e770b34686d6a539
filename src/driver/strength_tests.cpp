#include "driver/strength_tests.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "failure/cracking.h"
#include "failure/principal.h"
#include "failure/softening.h"
#include "koshi/model.h"

namespace koshi::driver {
namespace {

using failure::Tensor6;

constexpr std::int64_t side = 2;  // cells of the block along an axis

// Strain of the stress `axial` along n with free sides.
Tensor6 uniaxial(const material::Elastic& elastic, double axial, const Vec3& n) {
  const double E = elastic.youngs_modulus, nu = elastic.poissons_ratio;
  Tensor6 strain;
  for (std::size_t v = 0; v < 6; ++v) {
    const auto [i, j] = tensor_axes[v];
    strain[v] = axial / E * ((1 + nu) * n[i] * n[j] - (i == j ? nu : 0));
  }
  return strain;
}

// A block that is strained evenly, step by step.
class Block {
 public:
  explicit Block(model::Model& model) : model_(model) {
    // The last block may have cracked the cells.
    model::make_factors(model_.lattice, [](const Int3&) { return 1.0F; });
    state_.emplace(model_);
    cracking_.emplace(model_, *state_);
  }

  // To this strain; the motion there counts as one of a second.
  void strain_to(const Tensor6& strain) {
    lattice::for_each(model_.layout(), {-1, -1, -1}, model_.layout().owned(), [&](auto i, auto j, auto k, auto n) {
      const Vec3 u = failure::times(strain, model_.lattice.grid.position(model_.layout().global({i, j, k})));
      for (int c = 0; c < 3; ++c) {
        double& at = state_->displacement.component(c)[n];
        state_->velocity.component(c)[n] = u[static_cast<std::size_t>(c)] - at;
        at = u[static_cast<std::size_t>(c)];
      }
    });
    cracking_->follow(1);
  }

  bool cracked() const {
    bool any = false;
    lattice::for_each_owned(model_.layout(),
                            [&](auto, auto, auto, auto n) { any = any || state_->crack.component(1)[n] > 0; });
    return any;
  }

  // What cracks have taken [J].
  double taken() const { return cracking_->energy_taken(); }

 private:
  model::Model& model_;
  std::optional<model::State> state_;
  std::optional<failure::Cracking> cracking_;
};

model::Definition definition_of(const model::LatticeDefinition& lattice, const material::Elastic& elastic,
                                const material::Fracture& fracture) {
  model::Definition definition;
  definition.lattice = lattice;
  const double size = static_cast<double>(side) * lattice.spacing;
  definition.body.size = {size, size, size};
  definition.body.material = "material";
  definition.materials = {{"material", elastic, fracture}};
  definition.materials[0].fracture->strength_scatter.reset();  // the strength itself is asked for
  definition.analysis.type = model::AnalysisDefinition::Type::dynamic;
  definition.analysis.duration = 1;
  return definition;
}

// Stress at which the block cracks, between 0 and twice the most that is expected, by halving.
double breaking_stress(model::Model& model, const Vec3& n, double sign, double expected) {
  double low = 0, high = 2 * expected;
  for (int halving = 0; halving < 45; ++halving) {
    const double middle = 0.5 * (low + high);
    Block block(model);
    block.strain_to(uniaxial(model.materials[1], sign * middle, n));
    (block.cracked() ? high : low) = middle;
  }
  return low;
}

// Energy that cracks across n take over their area: the block is pulled until nothing is left, in steps that grow.
double energy_across(model::Model& model, const material::Fracture& fracture, const Vec3& n, double strength) {
  const material::Elastic& elastic = model.materials[1];
  const double d = model.lattice.grid.d, width = failure::band_width(d, n);
  const double ratio = 2 * elastic.youngs_modulus * fracture.fracture_energy / width / (strength * strength);
  // Softening on a line ends at `ratio` times the strain of the onset; of the exponential e^-20 is left at the end.
  const double end = std::max(1.0, ratio) * (fracture.softening == material::Softening::linear ? 1.01 : 20);
  constexpr int steps = 4000;
  Block block(model);
  for (int s = 0; s <= steps; ++s)
    block.strain_to(uniaxial(elastic, 0.99 * strength * std::pow(end / 0.99, static_cast<double>(s) / steps), n));
  return block.taken() / std::pow(static_cast<double>(side) * d, 3) * width;
}

}  // namespace

StrengthReport test_strength(const model::LatticeDefinition& lattice, const material::Elastic& elastic,
                             const material::Fracture& fracture) {
  model::Model model = model::make_model(definition_of(lattice, elastic, fracture), Communicator::self());
  const double E = elastic.youngs_modulus, f_t = fracture.tensile_strength, G_f = fracture.fracture_energy;
  StrengthReport report;
  report.asked = fracture;
  report.spacing = lattice.spacing;
  for (const auto& [name, along] : {std::pair{"[100]", Vec3{1, 0, 0}}, {"[110]", {1, 1, 0}}, {"[111]", {1, 1, 1}}}) {
    const Vec3 n = (1 / norm(along)) * along;
    StrengthTest test{.name = name, .direction = n};
    test.tensile_strength = breaking_stress(model, n, 1, f_t);
    test.fracture_energy = energy_across(model, fracture, n, test.tensile_strength);
    if (fracture.cohesion) test.compressive_strength = breaking_stress(model, n, -1, fracture.compressive_strength());
    report.tests.push_back(test);
  }
  report.characteristic_length = E * G_f / (f_t * f_t);
  report.spacing_limit = failure::width_limit(E, f_t, G_f) / std::sqrt(3.0);
  return report;
}

std::string strength_text(const StrengthReport& report) {
  std::string text = fmt::format("\nstrength of eight cells under even strain\n{:14}{:>16}{:>16}{:>20}\n", "along",
                                 "tension [Pa]", "crack [J/m^2]", "compression [Pa]");
  const auto row = [&](const std::string& name, double tension, double energy, double compression) {
    text += fmt::format("{:14}{:16.6g}{:16.6g}{:>20}\n", name, tension, energy,
                        compression == 0 ? "no limit" : fmt::format("{:.6g}", compression));
  };
  row("asked", report.asked.tensile_strength, report.asked.fracture_energy, report.asked.compressive_strength());
  for (const StrengthTest& test : report.tests)
    row(test.name, test.tensile_strength, test.fracture_energy, test.compressive_strength);
  text += fmt::format("characteristic length E G_f/f_t^2 {:.4g} m\n", report.characteristic_length);
  text += report.spacing < report.spacing_limit
              ? fmt::format("the spacing of {:.4g} m is fine enough: below {:.4g} m every direction has both\n",
                            report.spacing, report.spacing_limit)
              : fmt::format(
                    "the spacing of {:.4g} m is too coarse: cracks keep their energy and open early; below "
                    "{:.4g} m every direction has both\n",
                    report.spacing, report.spacing_limit);
  return text;
}

nlohmann::ordered_json strength_json(const StrengthReport& report) {
  nlohmann::ordered_json tests = nlohmann::ordered_json::array();
  for (const StrengthTest& test : report.tests) {
    nlohmann::ordered_json entry{{"along", test.name},
                                 {"tensile_strength", test.tensile_strength},
                                 {"fracture_energy", test.fracture_energy},
                                 {"compressive_strength", nullptr}};
    if (test.compressive_strength > 0) entry["compressive_strength"] = test.compressive_strength;
    tests.push_back(entry);
  }
  return {{"tests", tests},
          {"characteristic_length", report.characteristic_length},
          {"spacing_limit", report.spacing_limit}};
}

}  // namespace koshi::driver
