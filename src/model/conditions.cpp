#include "model/conditions.h"

#include <fmt/format.h>

#include <algorithm>
#include <set>

#include "base/collective.h"
#include "base/exact_sum.h"
#include "model/profiled_loads.h"
#include "model/selection.h"
#include "model/surface_loads.h"

namespace koshi::model {
namespace {

// Nodes of a selection; an error when no rank has one.
std::vector<SelectedNode> nodes_of(const Model& model, const Selection& selection, const std::string& path,
                                   const std::string& title) {
  const NodeSet box = select(selection, model.definition, model.lattice.grid, path);
  auto nodes = selected_nodes(model.lattice, box);
  if (model.communicator.sum(static_cast<std::int64_t>(nodes.size())) == 0)
    throw InputError(model.definition.places.find(path),
                     fmt::format("{} selects only nodes without material; choose nodes of the body", title));
  return nodes;
}

std::string title(const char* kind, const std::string& name, std::size_t index) {
  return name.empty() ? fmt::format("{} {}", kind, index + 1) : fmt::format("{} \"{}\"", kind, name);
}

Vec3 mean_position(const Model& model, const std::vector<SelectedNode>& nodes) {
  // Global indices are integers, so the sums are exact.
  std::array<std::int64_t, 4> sums{0, 0, 0, static_cast<std::int64_t>(nodes.size())};
  for (const SelectedNode& node : nodes)
    for (int a = 0; a < 3; ++a) sums[a] += node.global[a];
  model.communicator.sum(sums);
  Vec3 mean;
  for (int a = 0; a < 3; ++a)
    mean[a] = model.lattice.grid.origin[a] +
              model.lattice.grid.d * static_cast<double>(sums[a]) / static_cast<double>(sums[3]);
  return mean;
}

// Displacements and rotation of a node that turns by small angles about the axes through `center`, along components the
// turn prescribes: across each axis and about it.
void add_twist(const BoundaryDefinition& boundary, const Vec3& center, const Vec3& position, int components,
               const PrescribedMotion& base, std::vector<PrescribedMotion>& motions) {
  std::array<std::optional<double>, 6> value;
  for (int a = 0; a < 3; ++a) {
    if (!boundary.twist[a]) continue;
    const double angle = *boundary.twist[a];
    const int b = (a + 1) % 3, c = (a + 2) % 3;
    value[b] = value[b].value_or(0) - angle * (position[c] - center[c]);
    value[c] = value[c].value_or(0) + angle * (position[b] - center[b]);
    value[3 + a] = angle;
  }
  for (int c = 0; c < components; ++c) {
    if (!value[c]) continue;
    PrescribedMotion motion = base;
    motion.component = static_cast<std::int8_t>(c);
    motion.value = *value[c];
    motions.push_back(motion);
  }
}

bool same_motion(const Definition& definition, const PrescribedMotion& a, const PrescribedMotion& b) {
  if (a.value == 0 && b.value == 0) return true;
  if (a.value != b.value || a.is_velocity != b.is_velocity) return false;
  const BoundaryDefinition &first = definition.boundaries[a.boundary], &second = definition.boundaries[b.boundary];
  return first.ramp == second.ramp && first.history == second.history;
}

std::string describe(const Definition& definition, const PrescribedMotion& motion) {
  constexpr std::array<const char*, 6> names{"x", "y", "z", "rx", "ry", "rz"};
  const char* unit =
      motion.is_velocity ? (motion.component < 3 ? " m/s" : " rad/s") : (motion.component < 3 ? " m" : " rad");
  return fmt::format(
      "{} prescribes {} = {:.6g}{}",
      title("boundary", definition.boundaries[motion.boundary].name, static_cast<std::size_t>(motion.boundary)),
      names[motion.component], motion.value, unit);
}

// Gives the probe these nodes, each with its area or 1 as its weight; the sum of the weights (collective).
double add_weights(const Model& model, const std::vector<SelectedNode>& nodes, Probe& probe) {
  const bool by_area = probe.definition.reduce == ProbeDefinition::Reduce::area_mean;
  ExactSum total;
  for (const SelectedNode& node : nodes) {
    probe.nodes.emplace_back(node.node, by_area ? node.area : 1.0);
    total += probe.nodes.back().second;
  }
  total.sum_ranks(model.communicator);
  return total.value();
}

}  // namespace

std::vector<PrescribedMotion> make_motions(const Model& model) {
  const Definition& definition = model.definition;
  std::vector<PrescribedMotion> motions;
  for (std::size_t b = 0; b < definition.boundaries.size(); ++b) {
    const BoundaryDefinition& boundary = definition.boundaries[b];
    const auto nodes =
        nodes_of(model, boundary.selection, fmt::format("boundary[{}]", b), title("boundary", boundary.name, b));
    const bool twists =
        std::any_of(boundary.twist.begin(), boundary.twist.end(), [](const auto& t) { return t.has_value(); });
    const Vec3 center = !twists ? Vec3{} : boundary.center ? *boundary.center : mean_position(model, nodes);
    for (const SelectedNode& node : nodes) {
      PrescribedMotion motion{node.node, 0, false, 0, static_cast<int>(b)};
      for (int c = 0; c < model.components(); ++c) {
        motion.component = static_cast<std::int8_t>(c);
        motion.is_velocity = !boundary.fix[c] && !boundary.displacement[c];
        motion.value = boundary.fix[c]      ? 0
                       : motion.is_velocity ? boundary.velocity[c].value_or(0)
                                            : *boundary.displacement[c];
        if (boundary.fix[c] || boundary.displacement[c] || boundary.velocity[c]) motions.push_back(motion);
      }
      motion.is_velocity = false;
      if (twists)
        add_twist(boundary, center, model.lattice.grid.position(node.global), model.components(), motion, motions);
    }
  }
  std::stable_sort(motions.begin(), motions.end(), [](const auto& a, const auto& b) {
    return std::pair(a.node, a.component) < std::pair(b.node, b.component);
  });

  // Keep the first of equal prescriptions; different ones contradict each other.
  collectively(model.communicator, [&] {
    std::vector<PrescribedMotion> kept;
    for (const PrescribedMotion& motion : motions) {
      if (kept.empty() || kept.back().node != motion.node || kept.back().component != motion.component) {
        kept.push_back(motion);
        continue;
      }
      if (same_motion(definition, kept.back(), motion)) continue;
      throw InputError(definition.places.find(fmt::format("boundary[{}]", motion.boundary)),
                       fmt::format("{}, but {} at the same node; leave the component out of one of them",
                                   describe(definition, motion), describe(definition, kept.back())));
    }
    motions = std::move(kept);
  });
  return motions;
}

namespace {

[[noreturn]] void no_surface(const Model& model, const std::string& path, const std::string& title) {
  throw InputError(model.definition.places.find(path),
                   fmt::format("{} selects no surface of the body to act on; select a face, or spread a force with "
                               "distribution = \"nodes\"",
                               title));
}

// A load on faces of cells without a profile.
std::vector<NodeForce> face_forces(const Model& model, const LoadDefinition& load,
                                   const std::vector<SelectedNode>& nodes, const std::string& path,
                                   const std::string& title) {
  // Surface of the selection; every part is a multiple of d^2/4, so count quarters.
  const double quarter = 0.25 * model.lattice.grid.d * model.lattice.grid.d;
  std::array<std::int64_t, 2> sums{static_cast<std::int64_t>(nodes.size()), 0};
  for (const SelectedNode& node : nodes) sums[1] += std::llround(node.area / quarter);
  model.communicator.sum(sums);
  const auto [count, quarters] = sums;
  const bool by_nodes = load.force && (load.distribution == LoadDefinition::Distribution::nodes || count == 1);
  if (!by_nodes && quarters == 0) no_surface(model, path, title);
  std::vector<NodeForce> forces;
  for (const SelectedNode& node : nodes) {
    Vec3 force{};
    if (by_nodes)
      force = (1 / static_cast<double>(count)) * *load.force;
    else if (load.force)
      force = (node.area / (quarter * static_cast<double>(quarters))) * *load.force;
    else if (load.traction)
      force = node.area * *load.traction;
    else
      force = -*load.pressure * node.outward;
    forces.push_back({node.node, force});
  }
  return forces;
}

}  // namespace

std::vector<Load> make_loads(const Model& model) {
  std::vector<Load> loads;
  for (std::size_t l = 0; l < model.definition.loads.size(); ++l) {
    const LoadDefinition& load = model.definition.loads[l];
    const std::string path = fmt::format("load[{}]", l), name = title("load", load.name, l);
    const auto regions = surfaces_of(load.selection, model.definition);
    const auto profiled = [&](ForceShares&& shares) {
      loads.push_back(std::move(shares).with_profile(model, load, path));
    };
    if (load.acceleration) {
      if (load.profile.empty())
        loads.push_back({{}, *load.acceleration, load.history});
      else
        profiled(ForceShares(model, load));
    } else if (!regions.empty()) {
      const auto pieces = selected_pieces(model, load.selection, regions, path, name);
      if (load.profile.empty())
        loads.push_back({surface_forces(model, load, pieces), {}, load.history});
      else
        profiled(ForceShares(model, load, pieces));
    } else {
      const auto nodes = nodes_of(model, load.selection, path, name);
      if (load.profile.empty()) {
        loads.push_back({face_forces(model, load, nodes, path, name), {}, load.history});
        continue;
      }
      ForceShares shares(model, load, select(load.selection, model.definition, model.lattice.grid, path));
      if (!model.communicator.any(!shares.empty())) no_surface(model, path, name);
      profiled(std::move(shares));
    }
  }
  return loads;
}

namespace {

// Nodes that supports by the surfaces of a selection take hold of, beside those that it selects: a probe of reactions
// has the whole force of its support.
void add_supported_nodes(const Model& model, const Selection& selection, std::vector<SelectedNode>& nodes) {
  if (surfaces_of(selection, model.definition).empty()) return;
  std::set<std::int64_t> known;
  for (const SelectedNode& node : nodes) known.insert(node.node);
  for (const GroundSpring& spring : model.lattice.ground) {
    if (!holds(selection, model.definition, spring.surface, spring.region)) continue;
    const Int3 cell = model.layout().place(spring.cell);
    for (int corner = 0; corner < 8; ++corner) {
      const Int3 node{cell[0] + (corner & 1), cell[1] + (corner >> 1 & 1), cell[2] + (corner >> 2)};
      if (!model.layout().owns(node) || !known.insert(model.layout().index(node)).second) continue;
      nodes.push_back({model.layout().index(node), model.layout().global(node), {}, 0});
    }
  }
  std::ranges::sort(nodes, {}, &SelectedNode::node);
}

// Places of a probe of stress or strain on surfaces: the middles of their pieces, each for its area.
void set_places(const Model& model, const std::vector<int>& regions, const std::string& path, const std::string& title,
                Probe& probe) {
  const lattice::Grid& grid = model.lattice.grid;
  ExactSum total;
  for (const SurfacePiece& piece : selected_pieces(model, probe.definition.selection, regions, path, title)) {
    const Int3 local = model.layout().local(piece.cell);
    if (!model.layout().owns(local)) continue;
    const Vec3 from_corner = (1 / grid.d) * (piece.at - grid.position(piece.cell));
    probe.places.push_back({model.layout().index(local), from_corner - Vec3{0.5, 0.5, 0.5}, norm(piece.area)});
    total += probe.places.back().area;
  }
  total.sum_ranks(model.communicator);
  probe.total = total.value();
}

}  // namespace

std::vector<Probe> make_probes(const Model& model) {
  std::vector<Probe> probes;
  for (std::size_t p = 0; p < model.definition.probes.size(); ++p) {
    Probe probe{model.definition.probes[p], {}, 0, {}};
    probe.definition.reduce = probe.definition.reduction();
    const std::string path = fmt::format("probe[{}]", p);
    const auto quantity = probe.definition.quantity;
    const bool tensor = quantity == ProbeDefinition::Quantity::stress || quantity == ProbeDefinition::Quantity::strain;
    if (const auto regions = surfaces_of(probe.definition.selection, model.definition); tensor && !regions.empty()) {
      set_places(model, regions, path, title("probe", probe.definition.name, p), probe);
      probes.push_back(std::move(probe));
      continue;
    }
    auto nodes = nodes_of(model, probe.definition.selection, path, title("probe", probe.definition.name, p));
    if (quantity == ProbeDefinition::Quantity::reaction || quantity == ProbeDefinition::Quantity::moment)
      add_supported_nodes(model, probe.definition.selection, nodes);
    probe.total = add_weights(model, nodes, probe);
    if (probe.definition.quantity == ProbeDefinition::Quantity::moment) {
      const Vec3 center = probe.definition.center ? *probe.definition.center : mean_position(model, nodes);
      for (const SelectedNode& node : nodes) probe.arms.push_back(model.lattice.grid.position(node.global) - center);
    }
    bool has_surface = probe.total != 0;
    // The mean of the other selection is taken off by weights that are negative.
    if (has_surface && !probe.definition.minus.empty()) {
      Selection other;
      other.named = probe.definition.minus;
      const auto others = nodes_of(model, other, path + ".minus", title("selection", other.named, p));
      const std::size_t first = probe.nodes.size();
      const double total = add_weights(model, others, probe);
      has_surface = total != 0;
      for (auto weighted = probe.nodes.begin() + static_cast<std::ptrdiff_t>(first); weighted != probe.nodes.end();
           ++weighted)
        weighted->second *= -probe.total / total;
    }
    if (!has_surface)
      throw InputError(model.definition.places.find(path + ".reduce"),
                       fmt::format("{} selects no surface of the body to average over; use reduce = \"mean\"",
                                   title("probe", probe.definition.name, p)));
    probes.push_back(std::move(probe));
  }
  return probes;
}

}  // namespace koshi::model
