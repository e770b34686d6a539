#include "driver/scatter_report.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "base/exact_sum.h"

namespace koshi::driver {
namespace {

ScatterReport examine(const model::Model& model, std::size_t material, const char* property,
                      const lattice::Field<float>& factors) {
  const std::uint16_t* cell = model.lattice.cell.component(0);
  const float* factor = factors.component(0);
  ScatterReport report{model.definition.materials[material - 1].name, property};

  ExactSum sum;
  lattice::for_each_owned(model.layout(), [&](auto, auto, auto, auto n) {
    if (cell[n] != material) return;
    ++report.cells;
    sum += static_cast<double>(factor[n]);
  });
  sum.sum_ranks(model.communicator);
  report.cells = model.communicator.sum(report.cells);
  if (report.cells == 0) return report;
  report.mean = sum.value() / static_cast<double>(report.cells);

  // Each owned cell with those below it along the axes, which are known too.
  ExactSum squares, products;
  std::int64_t pairs = 0;
  const std::array<std::int64_t, 3> steps{1, model.layout().pitch(), model.layout().plane()};
  lattice::for_each_owned(model.layout(), [&](auto, auto, auto, auto n) {
    if (cell[n] != material) return;
    const double deviation = static_cast<double>(factor[n]) - report.mean;
    squares += deviation * deviation;
    for (const std::int64_t step : steps) {
      if (cell[n - step] != material) continue;
      products += deviation * (static_cast<double>(factor[n - step]) - report.mean);
      ++pairs;
    }
  });
  for (ExactSum* each : {&squares, &products}) each->sum_ranks(model.communicator);
  pairs = model.communicator.sum(pairs);
  const double variance = squares.value() / static_cast<double>(report.cells);
  report.variation = std::sqrt(variance) / report.mean;
  if (variance > 0 && pairs > 0) report.correlation = products.value() / static_cast<double>(pairs) / variance;
  return report;
}

}  // namespace

std::vector<ScatterReport> scatter_reports(const model::Model& model) {
  std::vector<ScatterReport> reports;
  for (std::size_t m = 1; m <= model.definition.materials.size(); ++m) {
    const model::MaterialDefinition& material = model.definition.materials[m - 1];
    if (material.stiffness_scatter) reports.push_back(examine(model, m, "stiffness", model.lattice.factor));
    if (material.cracks() && model.strength.components() != 0)
      reports.push_back(examine(model, m, "strength", model.strength));
  }
  std::erase_if(reports, [](const ScatterReport& report) { return report.cells == 0; });
  return reports;
}

std::string text(const ScatterReport& report) {
  return fmt::format("{} of \"{}\": {} cells, mean {:.4g}, variation {:.4g}, correlation of neighbours {:.3f}",
                     report.property, report.material, report.cells, report.mean, report.variation, report.correlation);
}

nlohmann::ordered_json json(const std::vector<ScatterReport>& reports) {
  nlohmann::ordered_json all = nlohmann::ordered_json::object();
  for (const ScatterReport& report : reports)
    all[report.material][report.property] = {{"cells", report.cells},
                                             {"mean", report.mean},
                                             {"variation", report.variation},
                                             {"correlation", report.correlation}};
  return all;
}

}  // namespace koshi::driver
