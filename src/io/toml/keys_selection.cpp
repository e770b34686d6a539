// Keys of selections, and of the tables that apply to one: [[selection]], [[boundary]], [[load]] and [[probe]].
#include <algorithm>

#include "io/toml/key.h"

namespace koshi::io {

using namespace model;

namespace {

About corner_key(const std::string& example) {
  return {.dimension = Dimension::length, .required = true, .range = ranges::position, .example = example};
}
About radius_key() {
  return {.dimension = Dimension::length, .required = true, .range = ranges::size, .example = R"("2 mm")"};
}

// The keys of a selection, and the name before them.
template <class D>
std::vector<Key<D>> selection_keys(const std::string& name_description, bool name_required) {
  return {
      key<D>("name", &D::name, name_description, {.required = name_required, .example = R"("top")"}),
      key<D>("face", [](auto& s) -> auto& { return s.selection.face; }, "Selects the nodes of a face of the box.",
             {.one_of = {"where"}}),
      key<D>("box", [](auto& s) -> auto& { return s.selection.box; },
             "Selects the nodes inside a box or on its border.",
             {.dimension = Dimension::length,
              .range = ranges::position,
              .example = "{min = [0, 0, 0], max = [\"1 cm\", \"1 cm\", 0]}",
              .one_of = {"where"}}),
      key<D>("point", [](auto& s) -> auto& { return s.selection.point; },
             "Selects the nearest node, at most half a spacing away in every direction.",
             {.dimension = Dimension::length,
              .range = ranges::position,
              .example = R"(["0.8 cm", "7.8 cm", "1.0 cm"])",
              .one_of = {"where"}}),
      key<D>(
          "surface", [](auto& s) -> auto& { return s.selection.surface; },
          "Name of a region: selects what of its surface is surface of the body, and the corners of the cells there.",
          {.example = R"("bore")", .one_of = {"where"}}),
  };
}

// The same, and a named selection.
template <class D>
std::vector<Key<D>> place_keys(const std::string& name_description, bool name_required) {
  std::vector<Key<D>> keys = selection_keys<D>(name_description, name_required);
  keys.push_back(key<D>("selection", [](auto& s) -> auto& { return s.selection.named; }, "Name of a [[selection]].",
                        {.example = R"("upper wall")", .one_of = {"where"}}));
  return keys;
}

template <class D>
std::vector<Key<D>> joined(std::vector<Key<D>> first, const std::vector<Key<D>>& second) {
  first.insert(first.end(), second.begin(), second.end());
  return first;
}

std::vector<Key<SelectionDefinition>> combination_keys() {
  using D = SelectionDefinition;
  return {
      key<D>("sphere", [](auto& s) -> auto& { return s.selection.sphere; }, "Selects what lies in a ball.",
             {.title = "sphere", .example = R"({center = [0, 0, 0], radius = "1 cm"})", .one_of = {"where"}}),
      key<D>("cylinder", [](auto& s) -> auto& { return s.selection.cylinder; }, "Selects what lies in a round bar.",
             {.title = "cylinder",
              .example = R"({start = [0, 0, 0], end = [0, 0, "1 cm"], radius = "1 cm"})",
              .one_of = {"where"}}),
      key<D>("half_space", [](auto& s) -> auto& { return s.selection.half_space; },
             "Selects what lies on one side of a plane.",
             {.title = "half_space", .example = R"({point = [0, 0, 0], normal = [0, 0, 1]})", .one_of = {"where"}}),
      key<D>("union", [](auto& s) -> auto& { return s.selection.any_of; },
             "Names of selections before this one: selects what is in any of them.",
             {.example = R"(["wall", "cap"])", .one_of = {"where"}}),
      key<D>("intersection", [](auto& s) -> auto& { return s.selection.all_of; },
             "Names of selections before this one: selects what is in all of them.",
             {.example = R"(["wall", "upper half"])", .one_of = {"where"}}),
      key<D>("difference", [](auto& s) -> auto& { return s.selection.first_of; },
             "Names of selections before this one: selects what is in the first and in none of the others.",
             {.example = R"(["wall", "window"])", .one_of = {"where"}}),
  };
}

bool has_twist(const BoundaryDefinition& boundary) {
  return std::any_of(boundary.twist.begin(), boundary.twist.end(), [](auto& angle) { return angle.has_value(); });
}

bool moves(const BoundaryDefinition& boundary) {
  const auto given = [](const std::optional<double>& value) { return value.has_value(); };
  return has_twist(boundary) || std::any_of(boundary.displacement.begin(), boundary.displacement.end(), given) ||
         std::any_of(boundary.velocity.begin(), boundary.velocity.end(), given);
}

}  // namespace

const std::vector<Key<SelectionDefinition>>& keys_of(Tag<SelectionDefinition>) {
  static const std::vector<Key<SelectionDefinition>> keys =
      joined(selection_keys<SelectionDefinition>("Name by which others refer to it.", true), combination_keys());
  return keys;
}

const std::vector<Key<SphereShape>>& keys_of(Tag<SphereShape>) {
  using D = SphereShape;
  static const std::vector<Key<D>> keys{key<D>("center", &D::center, "Centre.", corner_key(R"([0, 0, "5 mm"])")),
                                        key<D>("radius", &D::radius, "Radius.", radius_key())};
  return keys;
}

const std::vector<Key<CylinderShape>>& keys_of(Tag<CylinderShape>) {
  using D = CylinderShape;
  static const std::vector<Key<D>> keys{
      key<D>("start", &D::start, "One end of the axis.", corner_key(R"([0, 0, 0])")),
      key<D>("end", &D::end, "Other end of the axis.", corner_key(R"([0, 0, "20 mm"])")),
      key<D>("radius", &D::radius, "Radius.", radius_key())};
  return keys;
}

const std::vector<Key<HalfSpaceShape>>& keys_of(Tag<HalfSpaceShape>) {
  using D = HalfSpaceShape;
  static const std::vector<Key<D>> keys{
      key<D>("point", &D::point, "A point of the border plane.", corner_key(R"([0, 0, "5 mm"])")),
      key<D>("normal", &D::normal, "Direction that points out of the half-space.",
             {.required = true, .range = ranges::direction, .example = "[0, 0, 1]"})};
  return keys;
}

const std::vector<Key<BoundaryDefinition>>& keys_of(Tag<BoundaryDefinition>) {
  using D = BoundaryDefinition;
  const std::string motion = "a boundary with displacement, velocity or twist";
  const std::vector<std::string> motions{"displacement", "velocity", "twist"};
  static const std::vector<Key<D>> keys = joined(
      place_keys<D>("Name for messages and --set; unset: \"boundary 1\" and so on.", false),
      {
          key<D>("fix", &D::fix, "Components held at zero; rotations count only with rotational kinematics.",
                 {.example = R"(["x", "y", "z", "rx", "ry", "rz"])"}),
          key<D>("displacement", &D::displacement, "Prescribed displacements and rotations.",
                 {.dimension = Dimension::length,
                  .rotation = Dimension::angle,
                  .range = ranges::displacement,
                  .rotation_range = ranges::rotation,
                  .example = R"({z = "-0.08 mm"})"}),
          key<D>("velocity", &D::velocity, "Prescribed velocities and angular velocities.",
                 {.dimension = Dimension::velocity,
                  .rotation = Dimension::angular_velocity,
                  .range = ranges::velocity,
                  .rotation_range = ranges::angular_velocity,
                  .example = R"({z = "-0.1 cm/s"})"}),
          key<D>("twist", &D::twist, "Angle by which the selection turns as a rigid body about x, y or z.",
                 {.dimension = Dimension::angle, .range = ranges::rotation, .example = R"({z = "1 deg"})"}),
          key<D>("center", &D::center, "Point on the axis of the twist; unset: the mean of the selected nodes.",
                 {.dimension = Dimension::length, .range = ranges::position, .example = R"(["5 mm", "5 mm", "0 mm"])"})
              .only_for("a boundary with twist", {"twist"}, has_twist),
          key<D>("ramp", &D::ramp, "Time over which the motion rises linearly from zero.",
                 {.dimension = Dimension::time, .range = ranges::ramp, .example = R"("10 ms")"})
              .only_for(motion, motions, moves),
          key<D>("history", &D::history,
                 "Factor on the motion over time: pairs [time, factor], linear between, constant outside.",
                 {.example = R"([["0 s", 0], ["1 s", 1]])"})
              .only_for(motion, motions, moves),
          key<D>(
              "support", &D::support,
              "The surface holds the body at its true place: \"roller\" along its normal, so that the body slides upon "
              "it, \"bonded\" in every direction."),
      });
  return keys;
}

const std::vector<Key<LoadDefinition>>& keys_of(Tag<LoadDefinition>) {
  using D = LoadDefinition;
  static const std::vector<Key<D>> keys = joined(
      place_keys<D>("Name for messages and --set; unset: \"load 1\" and so on.", false),
      {
          key<D>("force", &D::force, "Total force on the selection.",
                 {.dimension = Dimension::force,
                  .range = ranges::force,
                  .example = R"(["9.8 N", "0 N", "0 N"])",
                  .one_of = {"what"}}),
          key<D>("traction", &D::traction, "Force per area.",
                 {.dimension = Dimension::pressure,
                  .range = ranges::pressure,
                  .example = R"([0, 0, "-2 MPa"])",
                  .one_of = {"what"}}),
          key<D>("pressure", &D::pressure, "Pressure against the outward normal of the face or surface.",
                 {.dimension = Dimension::pressure,
                  .range = ranges::pressure,
                  .example = R"("2 MPa")",
                  .one_of = {"what"}}),
          key<D>("acceleration", &D::acceleration, "Body force per mass, on the whole body.",
                 {.dimension = Dimension::acceleration,
                  .range = ranges::acceleration,
                  .example = R"([0, 0, "-9.80665 m/s^2"])",
                  .one_of = {"where", "what"}}),
          key<D>("distribution", &D::distribution,
                 "The total force is spread by the area each node stands for, or evenly over the nodes.")
              .only_for("a load with force", {"force"}, [](const D& load) { return load.force.has_value(); }),
          key<D>("profile", &D::profile, "Factor on the load in space and time: a formula in x, y, z [m] and t [s].",
                 {.example = R"f("max(0, 10 - z)")f"})
              .only_for("a load with traction, pressure or acceleration", {"traction", "pressure", "acceleration"},
                        [](const D& load) { return load.traction || load.pressure || load.acceleration; }),
          key<D>("history", &D::history,
                 "Factor on the load over time: pairs [time, factor], linear between, constant outside.",
                 {.example = R"([["0 s", 0], ["1 s", 1]])"}),
      });
  return keys;
}

const std::vector<Key<ProbeDefinition>>& keys_of(Tag<ProbeDefinition>) {
  using D = ProbeDefinition;
  static const std::vector<Key<D>> keys = joined(
      place_keys<D>("Name in summary.json and history.csv.", true),
      {
          key<D>("quantity", &D::quantity, "What is reported."),
          key<D>("reduce", &D::reduce,
                 "How the values of several nodes become one; unset: sum for reactions and moments, else mean."),
          key<D>("percentile", &D::percentile,
                 "Part of the nodes, in per cent, whose values are at most the reported one by size.",
                 {.range = ranges::percentile, .example = "95"})
              .only_for("reduce = \"percentile\"", {"reduce"},
                        [](const D& probe) { return probe.reduce == D::Reduce::percentile; }),
          key<D>("center", &D::center,
                 "Point about which the reactions' moment is taken; unset: the mean of the selected nodes.",
                 {.dimension = Dimension::length, .range = ranges::position, .example = R"(["5 mm", "5 mm", "0 mm"])"})
              .only_for("quantity \"moment\"", {"quantity"},
                        [](const D& probe) { return probe.quantity == D::Quantity::moment; }),
          key<D>(
              "minus", &D::minus,
              "Name of a [[selection]] whose mean is taken off: how far two places move apart, as the lips of a notch.",
              {.example = R"("lower lip")"}),
      });
  return keys;
}

}  // namespace koshi::io
