#include <cmath>
#include <iterator>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "calibration/calibrate.h"
#include "calibration/words.h"
#include "model/choices.h"

namespace koshi::calibration {
namespace {

using Out = std::back_insert_iterator<std::string>;

/// Relative deviation in per cent; rounding shows as 0.
double percent(double found, double wanted) {
  const double deviation = 100 * (found / wanted - 1);
  return std::abs(deviation) < 5e-9 ? 0 : deviation;
}

void write_input(const Calibrated& c, Out out) {
  fmt::format_to(out, "{} lattice, {} springs, calibration {}, kinematics {}\n", lattice::name(c.lattice.cell),
                 model::choice_name(c.lattice.springs), model::choice_name(*c.lattice.calibration),
                 model::choice_name(c.lattice.kinematics));
  if (c.lattice.calibration == material::Calibration::paper)
    fmt::format_to(out, "  equations         {}{}; axes 1, 2, 3 = {}\n", fmt::join(c.lattice.equations, ", "),
                   c.lattice.equations.size() == 1 ? ", kn = kt" : "", fmt::join(c.lattice.axes, ", "));
  fmt::format_to(out, "  Young's modulus   {:.6g} Pa\n", c.elastic.youngs_modulus);
  fmt::format_to(out, "  Poisson's ratio   {:.6g}\n", c.elastic.poissons_ratio);
  fmt::format_to(out, "  density           {:.6g} kg/m^3\n", c.elastic.density);
  fmt::format_to(out, "  spacing           {:.6g} m\n", c.lattice.spacing);
  if (c.cells)
    fmt::format_to(out, "  body              {} cells, {:.10g} bonds\n", fmt::join(*c.cells, " x "), c.bonds);
  else
    fmt::format_to(out, "  body              the unit cell inside the bulk\n");
}

void write_springs(const Calibrated& c, Out out) {
  constexpr std::array labels{"edges", "face diagonals", "body diagonals"};
  fmt::format_to(out, "\nSprings of a bond inside the bulk\n  {:<16}{:>16}{:>16}\n", "", "kn [N/m]", "kt [N/m]");
  for (int family = 0; family < lattice::families_of(c.lattice.cell); ++family)
    fmt::format_to(out, "  {:<16}{:>16.8g}{:>16.8g}\n", labels[family], c.springs.kn[family], c.springs.kt[family]);
  fmt::format_to(out, "  volumetric spring of a cell {:.8g} Pa\n", c.springs.kappa);
}

void write_tensor(const Calibrated& c, Out out) {
  fmt::format_to(out, "\nStiffness tensor C of the {} [MPa], rows and columns 11 22 33 23 13 12\n",
                 c.cells ? "body" : "bulk");
  for (const auto& row : c.C.voigt) {
    fmt::format_to(out, " ");
    for (const double entry : row) fmt::format_to(out, "{:>12.5g}", entry / 1e6);
    fmt::format_to(out, "\n");
  }
  fmt::format_to(out, "  elastic solid: C1111 = {:.5g}, C1122 = {:.5g}, C1212 = {:.5g}\n",
                 c.check.target(0, 0, 0, 0) / 1e6, c.check.target(0, 0, 1, 1) / 1e6, c.check.target(0, 1, 0, 1) / 1e6);
}

void write_constants(const Calibrated& c, Out out) {
  if (!c.constants) {
    fmt::format_to(out, "\nC is singular: this lattice has no elastic constants\n");
    return;
  }
  const material::EngineeringConstants& found = *c.constants;
  fmt::format_to(out, "\nElastic constants along the axes and their deviation\n  axis     E [MPa]\n");
  for (int i = 0; i < 3; ++i) {
    fmt::format_to(out, "  {}   {:>12.8g} {:>+9.4g} %", axis_names[i], found.youngs_modulus[i] / 1e6,
                   percent(found.youngs_modulus[i], c.elastic.youngs_modulus));
    for (int j = 0; j < 3; ++j) {
      if (i == j) continue;
      const double deviation = found.poissons_ratio[i][j] - c.elastic.poissons_ratio;
      fmt::format_to(out, "     nu_{}{} {:>9.6f} {:>+9.2g}", axis_names[i], axis_names[j], found.poissons_ratio[i][j],
                     std::abs(deviation) < 5e-11 ? 0 : deviation);
    }
    fmt::format_to(out, "\n");
  }
  fmt::format_to(out, "  Zener ratio {:.6g}\n", found.zener_ratio);
}

void write_waves(const Calibrated& c, Out out) {
  const double p = c.elastic.p_wave_speed(), s = c.elastic.s_wave_speed();
  fmt::format_to(out, "\nWaves and explicit time step\n");
  fmt::format_to(out, "  speeds            P {:.6g} m/s, S {:.6g} m/s\n", p, s);
  fmt::format_to(out, "  d / c_p           {:.6g} s\n", c.lattice.spacing / p);
  fmt::format_to(out, "  2 / omega_max     {:.6g} s inside the bulk; the step must stay below both\n",
                 c.check.bulk_step);
  fmt::format_to(out, "  speeds of the lattice over those of the solid, by cells per wavelength\n  {:<12}", "");
  // Rows of the table come direction by direction, wavelength by wavelength.
  const auto& table = c.check.dispersion;
  std::size_t lengths = 0;
  while (lengths < table.size() && table[lengths].direction == table.front().direction) ++lengths;
  for (std::size_t i = 0; i < lengths; ++i) fmt::format_to(out, "{:>9}", table[i].cells);
  fmt::format_to(out, "\n");
  for (std::size_t first = 0; first < table.size(); first += lengths)
    for (int wave = 0; wave < 3; ++wave) {
      constexpr std::array labels{"P", "S slow", "S fast"};
      fmt::format_to(out, "  {:<6}{:<6}", wave == 0 ? direction_name(table[first].direction) : "", labels[wave]);
      for (std::size_t i = first; i < first + lengths; ++i) {
        const mechanics::PhaseSpeeds& speeds = table[i].speeds;
        const std::array ratios{speeds.p / p, speeds.s_slow / s, speeds.s_fast / s};
        fmt::format_to(out, "{:>9.5f}", ratios[wave]);
      }
      fmt::format_to(out, "\n");
    }
}

void write_check(const Calibrated& c, Out out) {
  const mechanics::SelfCheck& check = c.check;
  fmt::format_to(out, "\nSelf-check inside the bulk\n");
  fmt::format_to(out, "  C against the elastic solid    {:.2g} of its largest entry\n", check.C_error);
  fmt::format_to(out, "  energy of a bent cell          {:.6f} of the solid's (dome {:.6f}, saddle {:.6f})\n",
                 check.energy.bending, check.energy.dome_bending, check.energy.saddle_bending);
  fmt::format_to(out, "  energy of a bent beam          {:.6f} of the solid's\n", check.energy.beam_bending);
  fmt::format_to(out, "  energy of a twisted cell       {:.6f} of the solid's\n", check.energy.torsion);
  fmt::format_to(out, "  softest motion of a cell       {:.4g} mu d; {} without energy besides the six rigid ones\n",
                 check.cell.least < 0 ? check.cell.least : check.cell.smallest_nonzero,
                 check.cell.zero_modes_beyond_rigid);
  fmt::format_to(out, "  waves without stiffness        at {} of {} wave vectors\n", check.zone.soft_vectors,
                 check.zone.vectors);
  fmt::format_to(out, "  verdict                        {}\n", name(check.verdict));
  if (!check.reason.empty()) fmt::format_to(out, "    {}\n    remedy: {}\n", check.reason, check.remedy);
  if (!c.note.empty()) fmt::format_to(out, "  note: {}\n", c.note);
}

}  // namespace

std::string calibration_report(const Calibrated& calibrated) {
  std::string text;
  const Out out = std::back_inserter(text);
  write_input(calibrated, out);
  write_springs(calibrated, out);
  write_tensor(calibrated, out);
  write_constants(calibrated, out);
  write_waves(calibrated, out);
  write_check(calibrated, out);
  return text;
}

}  // namespace koshi::calibration
