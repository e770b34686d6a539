#include "driver/crack_events.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <numeric>

namespace koshi::driver {
namespace {

// Sets of cells that are joined pair by pair; each goes by its least member.
class Sets {
 public:
  explicit Sets(std::size_t count) : parent_(count) { std::iota(parent_.begin(), parent_.end(), std::size_t{0}); }
  std::size_t of(std::size_t member) {
    while (parent_[member] != member) member = parent_[member] = parent_[parent_[member]];
    return member;
  }
  void join(std::size_t a, std::size_t b) {
    a = of(a), b = of(b);
    parent_[std::max(a, b)] = std::min(a, b);
  }

 private:
  std::vector<std::size_t> parent_;
};

// Numbers of the cells that share a corner with this one, each pair once but for periodic bodies.
template <class F>
void for_each_neighbour(const lattice::Grid& grid, std::int64_t number, F&& f) {
  const Int3 at = cell_indices(grid, number);
  for (int s = 0; s < 27; ++s) {
    const Int3 step{s % 3 - 1, s / 3 % 3 - 1, s / 9 - 1};
    Int3 next;
    bool inside = step != Int3{};
    for (std::size_t a = 0; a < 3; ++a) {
      next[a] = at[a] + step[a];
      if (grid.periodic[a]) next[a] = (next[a] + grid.cells[a]) % grid.cells[a];
      inside = inside && next[a] >= 0 && next[a] < grid.cells[a];
    }
    if (inside) f(next[0] + grid.cells[0] * (next[1] + grid.cells[1] * next[2]));
  }
}

}  // namespace

double CrackEvent::magnitude() const {
  return energy > 0 ? (std::log10(energy) - 4.8) / 1.5 : -std::numeric_limits<double>::infinity();
}

Together within_window(const model::Model& model) {
  double slowest = std::numeric_limits<double>::infinity();
  for (const model::MaterialDefinition& material : model.definition.materials)
    if (material.cracks()) slowest = std::min(slowest, material.elastic.s_wave_speed());
  const double window = 10 * model.lattice.grid.d / slowest;
  return [window](double a, double b) { return std::abs(a - b) <= window; };
}

Together within_one_rise(std::span<const double> load_factors) {
  // How many largest factors there were up to each equilibrium.
  std::vector<int> rises;
  double largest = 0;
  for (const double factor : load_factors) {
    rises.push_back((rises.empty() ? 0 : rises.back()) + (factor > largest ? 1 : 0));
    largest = std::max(largest, factor);
  }
  return [rises](double a, double b) {
    return rises.at(static_cast<std::size_t>(a)) == rises.at(static_cast<std::size_t>(b));
  };
}

Together within_one_step() {
  return [](double a, double b) { return a == b; };
}

std::vector<CrackEvent> crack_events(const lattice::Grid& grid, std::span<const CrackedCell> all,
                                     const Together& together) {
  std::vector<CrackedCell> cells;  // by number
  std::ranges::copy_if(all, std::back_inserter(cells), [](const CrackedCell& cell) { return cell.moment > 0; });
  Sets sets(cells.size());
  for (std::size_t c = 0; c < cells.size(); ++c)
    for_each_neighbour(grid, cells[c].number, [&](std::int64_t number) {
      const auto next = std::ranges::lower_bound(cells, number, {}, &CrackedCell::number);
      if (next == cells.end() || next->number != number) return;
      if (together(next->moment, cells[c].moment)) sets.join(c, static_cast<std::size_t>(next - cells.begin()));
    });

  std::vector<CrackEvent> events;
  std::vector<std::size_t> event_of(cells.size());
  for (std::size_t c = 0; c < cells.size(); ++c) {
    const CrackedCell& cell = cells[c];
    if (sets.of(c) == c) {
      event_of[c] = events.size();
      events.push_back({.time = cell.moment, .duration = cell.moment});
    }
    CrackEvent& event = events[event_of[c] = event_of[sets.of(c)]];
    event.time = std::min(event.time, cell.moment);
    event.duration = std::max(event.duration, cell.moment);  // its end, so far
    const Int3 at = cell_indices(grid, cell.number);
    event.place = event.place + grid.position(at) + 0.5 * grid.d * Vec3{1, 1, 1};
    event.energy += cell.energy;
    event.shear += cell.shear;
    ++event.cells;
  }
  for (CrackEvent& event : events) {
    event.duration -= event.time;
    event.place = (1 / static_cast<double>(event.cells)) * event.place;
    event.shear /= static_cast<double>(event.cells);
  }
  std::ranges::stable_sort(events, {}, &CrackEvent::time);
  return events;
}

std::vector<std::string> event_columns(std::span<const double> load_factors) {
  std::vector<std::string> columns{"time [s]", "duration [s]"};
  if (!load_factors.empty()) columns = {"event [1]", "last event [1]", "load factor [1]"};
  for (const char* column : {"x [m]", "y [m]", "z [m]", "energy [J]", "cells [1]", "shear [1]", "magnitude [1]"})
    columns.emplace_back(column);
  return columns;
}

std::vector<std::vector<double>> event_rows(std::span<const CrackEvent> events, std::span<const double> load_factors) {
  std::vector<std::vector<double>> rows;
  for (const CrackEvent& e : events) {
    std::vector<double>& row = rows.emplace_back();
    if (load_factors.empty())
      row = {e.time, e.duration};
    else
      row = {e.time, e.time + e.duration, load_factors[static_cast<std::size_t>(e.time)]};
    row.insert(row.end(),
               {e.place[0], e.place[1], e.place[2], e.energy, static_cast<double>(e.cells), e.shear, e.magnitude()});
  }
  return rows;
}

nlohmann::ordered_json events_summary(std::span<const CrackEvent> events) {
  double energy = 0, mean = 0;
  double largest = -std::numeric_limits<double>::infinity(), least = std::numeric_limits<double>::infinity();
  for (const CrackEvent& event : events) {
    energy += event.energy;
    const double magnitude = event.magnitude();
    largest = std::max(largest, magnitude);
    least = std::min(least, magnitude);
    mean += magnitude / static_cast<double>(events.size());
  }
  // Aki's estimate: magnitudes above the least one fall off exponentially, by b decades of number for each unit.
  constexpr std::size_t enough = 20;
  nlohmann::ordered_json b_value;
  if (events.size() >= enough && mean > least) b_value = std::numbers::log10e / (mean - least);
  return {{"count", events.size()}, {"energy", energy}, {"largest_magnitude", largest}, {"b_value", b_value}};
}

}  // namespace koshi::driver
