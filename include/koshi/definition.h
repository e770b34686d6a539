// What a user can set: plain structs with defaults, SI units. The input file, the command line and Python fill the same
// structs; Model validates and freezes them. Names follow the keys of the input file.
#pragma once

#include <array>
#include <cstdint>
#include <limits>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "koshi/error.h"
#include "koshi/fracture.h"
#include "koshi/lattice.h"
#include "koshi/scan.h"
#include "koshi/scatter.h"
#include "koshi/springs.h"

namespace koshi::model {

/// [lattice]
struct LatticeDefinition {
  lattice::CellType cell = lattice::CellType::cube_iii;   ///< unit cell
  double spacing = 0;                                     ///< d [m], required; 0: of the image's voxels
  material::Sharing springs = material::Sharing::shared;  ///< shared between cells, or full
  /// Unset: bending-exact for shared Cube-III, isotropic for shared Cube-I and -II, paper for plain springs.
  std::optional<material::Calibration> calibration;
  material::Kinematics kinematics = material::Kinematics::rotational;  ///< of the bond law
  /// Calibration "paper": entries of C set equal to the elastic tensor, e.g. {"C1122", "C1212"} or {"C1111-C1122"};
  /// empty: Cube-I C1111-C1122, Cube-II C1122 and C1212, Cube-III C1122 and C1111.
  std::vector<std::string> equations;
  /// Calibration "paper": which body axes are 1, 2, 3 of C; a permutation of "xyz".
  std::string axes = "xyz";
  bool operator==(const LatticeDefinition&) const = default;
};

/// [body.grain_boundary]: solid cells with a face neighbour of another grain; exactly one of material and strength.
struct GrainBoundaryDefinition {
  std::string labels;              ///< file of whole numbers, one for each grain; empty: a grain is one of a material
  std::string material;            ///< that these cells become; empty: they stay what they are
  std::optional<double> strength;  ///< factor on their strength, > 0
  std::vector<std::int32_t> label_of_cells;  ///< x fastest; filled from the file, or by a program
  bool operator==(const GrainBoundaryDefinition&) const = default;
};

/// A material for the cells of a coarsened image that hold two solids.
struct Mixture {
  std::uint16_t material = 0;         ///< its index in the cells
  std::array<std::uint16_t, 2> of{};  ///< the two solids, by their indices
  double share = 0;                   ///< of the second of them, 0 < share < 1
  bool operator==(const Mixture&) const = default;
};

/// [body]
struct BodyDefinition {
  /// What becomes of a cell that a surface cuts: whole or empty by its centre, or the part of it inside.
  enum class Surface { stairs, cut };
  Vec3 origin{};                               ///< lower corner [m]
  Vec3 size{};                                 ///< [m], multiples of the spacing; unset with an image
  std::string material;                        ///< name of the cells' material; unset with an image's `materials`
  std::array<bool, 3> periodic{};              ///< opposite faces are joined
  Surface surface = Surface::stairs;           ///< of regions
  std::string image;                           ///< file of cell values (.npy, .vti, .mha, .mhd, .nrrd); empty: none
  std::map<int, std::string> image_materials;  ///< image value -> material name or "void" (key `materials`)
  std::optional<ScanDefinition> scan;          ///< how values become cells; unset: each value is a cell
  /// Material of each cell, x fastest, 0 = empty, k = materials[k - 1]; filled from the image, or by a program.
  std::vector<std::uint16_t> cells;
  std::vector<Mixture> mixtures{};  ///< among the materials; filled from the image
  std::string factor;  ///< file of factors 0 ... 1 on the cells' stiffness, in the formats of an image; empty: all 1
  /// Factor of each cell, x fastest; empty: all 1; filled from the file, or by a program. Shared springs only.
  std::vector<float> factors;
  /// Density of each cell over that of its material, x fastest; empty: all 1; filled from the image. Above 1 by little,
  /// where a mixture holds more of the heavier solid than its share in sixteenths.
  std::vector<float> density_shares;
  std::string strength;          ///< file of factors on the strength of the cells, in the same formats; empty: all 1
  std::vector<float> strengths;  ///< of each cell, x fastest, > 0; empty: all 1; filled from the file, or by a program
  std::optional<GrainBoundaryDefinition> grain_boundary{};  ///< unset: grains hold together as they are
  bool operator==(const BodyDefinition&) const = default;
};

/// [material.NAME]
struct MaterialDefinition {
  std::string name;                                      ///< not "void"
  material::Elastic elastic;                             ///< E, nu, density
  std::optional<material::Fracture> fracture{};          ///< unset: it does not crack
  std::optional<material::Scatter> stiffness_scatter{};  ///< of E from cell to cell; unset: none
  bool cracks() const { return fracture && fracture->law != material::FractureLaw::none; }  ///< may crack
  bool operator==(const MaterialDefinition&) const = default;
};

/// A cell that a surface from a file cuts: inside is what lies below a plane.
struct CutCell {
  std::int64_t cell = 0;  ///< its index in the box, x fastest
  Vec3 normal{};          ///< of the plane, of length 1, pointing out of the body
  double offset = 0;      ///< of the plane from the cell's centre along the normal, in spacings
  bool operator==(const CutCell&) const = default;
};

/// [[region]]: gives the cells whose centre lies inside the shape a material; later regions win.
struct RegionDefinition {
  /// stl: a surface from a file.
  enum class Shape { box, sphere, cylinder, half_space, stl };
  std::string name;                  ///< by which selections find its surface; empty: none
  Shape shape = Shape::box;          ///< decides which members count
  std::string material;              ///< a material's name or "void"
  Vec3 min{};                        ///< box: lower corner [m]
  Vec3 max{};                        ///< box: upper corner [m]
  Vec3 center{};                     ///< sphere [m]
  double radius = 0;                 ///< sphere, cylinder [m]
  Vec3 start{};                      ///< cylinder: one end of the axis [m]
  Vec3 end{};                        ///< cylinder: other end of the axis [m]
  Vec3 point{};                      ///< half-space: on its plane [m]
  Vec3 normal{};                     ///< half-space: the direction that points out of it
  std::string file;                  ///< stl: a closed surface
  double scale = 1;                  ///< stl: length of the file's unit [m]
  std::vector<std::uint8_t> inside;  ///< stl: 1 for each cell inside, x fastest; filled from the file
  std::vector<CutCell> cut_cells;    ///< stl, surface "cut": cells it cuts, by index; filled from the file
  /// stl: corners [m], counter-clockwise seen from outside; filled from the file where a selection names the surface.
  std::vector<std::array<Vec3, 3>> triangles;
  bool operator==(const RegionDefinition&) const = default;
};

/// [[crack]]: the cells that a piece of a plane cuts have cracked along it before the run begins.
struct CrackDefinition {
  /// The plane's piece.
  enum class Shape { disc, rectangle };
  std::string name;           ///< for messages
  Shape shape = Shape::disc;  ///< decides which members count
  Vec3 center{};              ///< [m]
  Vec3 normal{};              ///< of the plane
  double radius = 0;          ///< disc [m]
  Vec3 along{};               ///< rectangle: direction of its length; what of it lies in the plane
  double length = 0;          ///< rectangle: side along that [m]
  double width = 0;           ///< rectangle: other side [m]
  bool operator==(const CrackDefinition&) const = default;
};

/// Faces of the box of cells.
enum class Face { x_min, x_max, y_min, y_max, z_min, z_max };

/// A ball; selects what lies inside or on its border.
struct SphereShape {
  Vec3 center{};      ///< [m]
  double radius = 0;  ///< [m]
  bool operator==(const SphereShape&) const = default;
};
/// A round bar; the same.
struct CylinderShape {
  Vec3 start{};       ///< one end of the axis [m]
  Vec3 end{};         ///< the other [m]
  double radius = 0;  ///< [m]
  bool operator==(const CylinderShape&) const = default;
};
/// One side of a plane; the same.
struct HalfSpaceShape {
  Vec3 point{};   ///< on its plane [m]
  Vec3 normal{};  ///< the direction that points out of it
  bool operator==(const HalfSpaceShape&) const = default;
};

/// Nodes, or the part of a surface, that a boundary, load or probe applies to: exactly one member. A point selects the
/// nearest node, which must lie within half a spacing in every direction.
struct Selection {
  std::optional<Face> face;                  ///< of the box of cells
  std::optional<std::pair<Vec3, Vec3>> box;  ///< {min, max} [m], nodes inside or on the border
  std::optional<Vec3> point;                 ///< [m]
  std::optional<SphereShape> sphere;         ///< nodes inside or on the border
  std::optional<CylinderShape> cylinder;     ///< the same
  std::optional<HalfSpaceShape> half_space;  ///< the same
  std::string surface;                       ///< name of a region: what of its surface is surface of the body
  std::string named;                         ///< a selection by its name (key `selection`)
  std::vector<std::string> any_of;           ///< names of selections: what is in one of them (key `union`)
  std::vector<std::string> all_of;           ///< what is in all of them (key `intersection`)
  std::vector<std::string> first_of;         ///< what is in the first and in none of the others (key `difference`)
  bool operator==(const Selection&) const = default;
};

/// [[selection]]: a selection with a name, for others to use.
struct SelectionDefinition {
  std::string name;     ///< unlike any other
  Selection selection;  ///< what it stands for
  bool operator==(const SelectionDefinition&) const = default;
};

/// Factor over time, piecewise linear, constant outside; pairs {t [s], factor}, t ascending; empty: 1.
using History = std::vector<std::array<double, 2>>;

/// [[boundary]]: prescribed motion, or a support by a surface. Components 0..5 = x, y, z, rx, ry, rz.
struct BoundaryDefinition {
  /// How a surface holds the body: along its normal, so that it slides upon it, or in every direction.
  enum class Support { roller, bonded };
  std::string name;                                     ///< for messages and --set
  Selection selection;                                  ///< of nodes
  std::array<bool, 6> fix{};                            ///< held at zero
  std::array<std::optional<double>, 6> displacement{};  ///< [m], [rad]
  std::array<std::optional<double>, 6> velocity{};      ///< [m/s], [rad/s]
  /// The selection turns as a rigid body about an axis through `center`: angle [rad] about x, y or z; prescribes the
  /// two displacements across the axis and the rotation about it, and leaves the displacement along it free (warping).
  std::array<std::optional<double>, 3> twist{};
  std::optional<Vec3> center;  ///< of the twist [m]; unset: mean position of the selected nodes
  double ramp = 0;             ///< [s], displacement and twist rise linearly from 0; velocity too
  History history;             ///< factor on displacement, velocity and twist
  /// Of the surfaces that the selection names, by springs at their places; unset: none.
  std::optional<Support> support{};
  bool operator==(const BoundaryDefinition&) const = default;
};

/// [[load]]: exactly one of force, traction, pressure, acceleration.
struct LoadDefinition {
  /// By the area a node stands for, or evenly.
  enum class Distribution { area, nodes };
  std::string name;                                ///< for messages and --set
  Selection selection;                             ///< none for acceleration
  std::optional<Vec3> force;                       ///< total [N]
  Distribution distribution = Distribution::area;  ///< of the total force
  std::optional<Vec3> traction;                    ///< [Pa], on a face, the part of it in a box, or a surface
  std::optional<double> pressure;                  ///< [Pa], against the outward normal
  std::optional<Vec3> acceleration;                ///< body force per mass [m/s^2]
  /// Factor on a traction, pressure or acceleration: a formula in x, y, z [m] and t [s]; empty: 1.
  std::string profile;
  History history;  ///< factor on the load
  bool operator==(const LoadDefinition&) const = default;
};

/// Damping of the motion.
struct DampingDefinition {
  /// (N27) or (N1).
  enum class Kind { none, local, viscous };
  Kind kind = Kind::local;  ///< none: the other members do not count
  double factor = 0.8;      ///< local: alpha of (N27), 0 <= alpha < 1
  double rate = 0;          ///< viscous: c/m of (N1) [1/s]
  bool operator==(const DampingDefinition&) const = default;
};

/// Components xx, yy, zz, yz, xz, xy of a mean strain, those of the tensor: a shear is half of the engineering one.
struct MeanStrain {
  std::array<std::optional<double>, 6> components{};  ///< unset: not told
  bool operator==(const MeanStrain&) const = default;
};

/// Components xx, yy, zz, yz, xz, xy of a mean stress.
struct MeanStress {
  std::array<std::optional<double>, 6> components{};  ///< [Pa]; unset: not told
  bool operator==(const MeanStress&) const = default;
};

/// [macroscopic]: strain of a periodic body as a whole. A component of which neither the mean strain nor the mean
/// stress is given has no strain.
struct MacroscopicDefinition {
  std::optional<MeanStrain> strain{};  ///< of the components that are given
  std::optional<MeanStress> stress{};  ///< over the box, voids too; its components have the strain that leads to it
  History history{};                   ///< factor on both
  /// Mean stress that component c is to have [Pa]; unset: its strain is given.
  std::optional<double> stress_of(std::size_t c) const {
    if (!stress) return std::nullopt;
    return stress->components[c];
  }
  /// Mean strain that component c is to have, where no stress is given; unset: zero.
  std::optional<double> strain_of(std::size_t c) const {
    if (!strain) return std::nullopt;
    return strain->components[c];
  }
  bool operator==(const MacroscopicDefinition&) const = default;
};

/// [analysis.stop_when]: ends the run at the first sample of the history at which one of its conditions holds.
struct StopDefinition {
  std::string probe;         ///< of a reaction; empty: no such condition
  double below = 0;          ///< the reaction's size has fallen below this part of its largest, 0 < below < 1
  std::optional<Face> face;  ///< a cell at this face of the box has cracked through; unset: no such condition
  double after = 0;          ///< [s], nothing ends the run before
  bool operator==(const StopDefinition&) const = default;
};

/// [analysis]
struct AnalysisDefinition {
  /// Equilibrium at once, equilibrium by damped steps, motion, or free vibrations.
  enum class Type { statics, quasi_static, dynamic, modes };
  Type type = Type::statics;  ///< what is computed
  /// Statics: relative residual; quasi-static: unbalanced-force ratio; modes: relative error of squared frequencies.
  double tolerance = 1e-8;
  std::optional<double> duration;             ///< [s], required for dynamic; quasi-static: the most simulated time
  std::optional<double> time_step;            ///< [s]; unset: "auto"
  bool allow_unstable_step = false;           ///< run with a step above the stable limit all the same
  double safety = 0.9;                        ///< of the automatic step: its ratio to the stable limit
  DampingDefinition damping;                  ///< unset in a dynamic run: none
  int events = 1000;                          ///< statics of a body that can crack: the most events of cracking
  std::optional<int> steps{};                 ///< the same: equal steps through the histories; unset: event by event
  std::optional<StopDefinition> stop_when{};  ///< unset: the run goes on to its end
  std::string start_from;                     ///< output directory of an earlier run whose displacements are the start
  int count = 10;                             ///< modes
  double near = 0;                            ///< modes: those closest to this frequency [Hz]; 0: the lowest
  bool allow_floating = false;                ///< modes: of a body in several parts of which some are free

  /// Whether time goes on in steps.
  bool stepped() const { return type == Type::quasi_static || type == Type::dynamic; }
  bool operator==(const AnalysisDefinition&) const = default;
};

/// [[probe]]
struct ProbeDefinition {
  /// Of nodes, of supports, or of the cells around a node.
  enum class Quantity { displacement, rotation, velocity, reaction, moment, stress, strain };
  /// How the values of several nodes become one, of each component by itself; max: by size; percentile: the size that
  /// this part of the nodes does not exceed.
  enum class Reduce { mean, area_mean, sum, max, percentile };
  std::string name;                            ///< in the results
  Selection selection;                         ///< of nodes
  Quantity quantity = Quantity::displacement;  ///< what is reported
  std::optional<Reduce> reduce;                ///< unset: sum for reactions and moments, else mean
  double percentile = 95;                      ///< of reduce percentile, 0 ... 100
  std::optional<Vec3> center;  ///< of a moment of the reactions [m]; unset: mean position of the selected nodes
  std::string minus;           ///< name of a selection whose mean is taken off; empty: none

  /// The reduction in force: the one set, else the default of the quantity.
  Reduce reduction() const {
    const bool sums = quantity == Quantity::reaction || quantity == Quantity::moment;
    return reduce.value_or(sums ? Reduce::sum : Reduce::mean);
  }
  bool operator==(const ProbeDefinition&) const = default;
};

/// [output]
struct OutputDefinition {
  /// displacement, rotation, orientation, velocity, reaction, strain, stress, material, energy, damage,
  /// crack_opening; unset: displacement.
  std::vector<std::string> fields{"displacement"};
  std::optional<double> every;             ///< [s] simulated time between field samples; unset: the end only
  std::optional<int> every_events;         ///< events of cracking between field samples; unset: the end only
  std::optional<double> history_every;     ///< [s] simulated time between rows of history.csv; unset: 200 rows
  std::optional<double> checkpoint_every;  ///< [s] simulated time
  std::optional<double> checkpoint_wall;   ///< [s] wall time; key checkpoint_every_wall
  bool report = false;                     ///< write report.html
  bool crack_surface = false;              ///< write the surface of the cracks with each sample
  bool surface = false;  ///< write the surface of the regions, with the fields on it, with each sample
  bool operator==(const OutputDefinition&) const = default;
};

/// Where each key of the input stood, by path ("boundary[0].face"); empty for a definition made in code.
class Places {
 public:
  /// Notes where a key stood.
  void set(const std::string& path, const Place& place) { places_[path] = place; }
  /// Place of the key or of the nearest enclosing table that is known.
  Place find(std::string path) const;

 private:
  std::map<std::string, Place> places_;
};

/// A whole case.
struct Definition {
  std::string title;                                   ///< for people
  LatticeDefinition lattice;                           ///< [lattice]
  BodyDefinition body;                                 ///< [body]
  std::vector<MaterialDefinition> materials;           ///< [material.NAME]; index 1 in a cell is the first
  std::vector<RegionDefinition> regions;               ///< [[region]], later ones win
  std::vector<SelectionDefinition> selections;         ///< [[selection]]
  std::vector<CrackDefinition> pre_cracks;             ///< [[crack]]
  std::vector<BoundaryDefinition> boundaries;          ///< [[boundary]]
  std::vector<LoadDefinition> loads;                   ///< [[load]]
  std::optional<MacroscopicDefinition> macroscopic{};  ///< [macroscopic]; unset: periodic bodies keep their size
  AnalysisDefinition analysis;                         ///< [analysis]
  std::vector<ProbeDefinition> probes;                 ///< [[probe]]
  OutputDefinition output;                             ///< [output]

  Places places;                ///< for messages
  std::string directory = ".";  ///< relative file names (image, stl, start_from) are looked up here

  /// The calibration in force: the one set, else the default for the cell and sharing.
  material::Calibration calibration() const;
  /// Whether regions cut cells.
  bool cuts() const { return body.surface == BodyDefinition::Surface::cut && !regions.empty(); }
  /// Whether some material can crack.
  bool cracks() const;
  /// Whether it is bonds that break where a material can crack.
  bool breaks_bonds() const;
  /// Whether this is an equilibrium that follows its cracks.
  bool cracks_in_equilibrium() const { return analysis.type == AnalysisDefinition::Type::statics && cracks(); }
  /// Whether that goes from one cracking cell to the next, instead of in steps of the loads.
  bool follows_events() const { return cracks_in_equilibrium() && !analysis.steps; }
  /// Whether the stiffness of some material scatters.
  bool varies_in_stiffness() const;
  /// Whether some material can crack, and its cells do not all have its strength.
  bool varies_in_strength() const;

  /// Equal input; where it stood (places, directory) counts nothing.
  bool operator==(const Definition& other) const;
};

/// Checks all that a definition shows by itself, without the grid: ranges, names, contradictions.
/// Errors: InputError at the place of the wrong key; where no place is known, its path stands for it.
void check(const Definition& definition);

}  // namespace koshi::model
