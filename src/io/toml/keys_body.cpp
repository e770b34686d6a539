// Keys of the whole input, [lattice], [body], [material.NAME] and [[region]].
#include <fmt/format.h>

#include <algorithm>

#include "io/toml/key.h"

namespace koshi::io {

using namespace model;

const std::vector<Key<Definition>>& keys_of(Tag<Definition>) {
  using D = Definition;
  static const std::vector<Key<D>> keys{
      key<D>("title", &D::title, "What the case is, for people.", {.example = R"("Cantilever, exact springs")"}),
      key<D>("lattice", &D::lattice, "Unit cell, spacing and springs.", {.required = true}),
      key<D>("body", &D::body, "The box of cells.", {.required = true}),
      key<D>("material", &D::materials, "Elastic materials by name, [material.NAME]; at least one.",
             {.required = true}),
      key<D>("region", &D::regions, "Shapes, [[region]], that give cells another material or none; later ones win."),
      key<D>("crack", &D::pre_cracks,
             "Cracks, [[crack]], that a body of materials with a fracture has from the start."),
      key<D>("selection", &D::selections,
             "Selections, [[selection]], by name: a shape, a surface, or what others have together."),
      key<D>("boundary", &D::boundaries, "Prescribed motions, [[boundary]], each of the nodes of one selection."),
      key<D>("load", &D::loads,
             "Loads, [[load]]: one of force, traction, pressure on one selection, or an "
             "acceleration of "
             "the whole body."),
      key<D>("macroscopic", &D::macroscopic,
             "Mean strain and mean stress of a periodic body; unset: it keeps its periods."),
      key<D>("analysis", &D::analysis, "What is computed."),
      key<D>("probe", &D::probes, "Values reported by name, [[probe]], each from the nodes of one selection."),
      key<D>("output", &D::output, "Fields, samples and checkpoints."),
  };
  return keys;
}

const std::vector<Key<LatticeDefinition>>& keys_of(Tag<LatticeDefinition>) {
  using D = LatticeDefinition;
  const std::vector<std::string> deciding{"calibration", "springs", "cell"};
  const auto paper = [](const D& lattice) {
    Definition definition;
    definition.lattice = lattice;
    return definition.calibration() == material::Calibration::paper;
  };
  static const std::vector<Key<D>> keys{
      key<D>("cell", &D::cell, "Unit cell: edges, face diagonals (II, III), body diagonals (III)."),
      key<D>("spacing", &D::spacing, "Side d of a cell; \"image\": of the voxels of the image, in its body.scan.unit.",
             {.dimension = Dimension::length, .required = true, .range = ranges::spacing, .example = R"("0.2 cm")"})
          .or_word(
              "image", [](D& lattice) { lattice.spacing = 0; }, [](const D& lattice) { return lattice.spacing == 0; }),
      key<D>("springs", &D::springs, "Springs belong to cells (shared), or every bond carries its full stiffness."),
      key<D>("calibration", &D::calibration,
             "How E and nu become springs; unset: bending-exact for shared Cube-III, isotropic for shared Cube-I and "
             "-II, paper for plain springs."),
      key<D>("kinematics", &D::kinematics, "Three rotations per node, or the rotation fitted to each cell."),
      key<D>("equations", &D::equations,
             "Entries of C set equal to the elastic tensor, such as \"C1122\" or \"C1111-C1122\": one for Cube-I, two "
             "for Cube-II and -III; unset: those of the paper.",
             {.example = R"(["C1122", "C1212"])"})
          .only_for("calibration \"paper\"", deciding, paper),
      key<D>("axes", &D::axes, "Which body axes are 1, 2, 3 of C: a permutation of \"xyz\".", {.example = R"("yxz")"})
          .only_for("calibration \"paper\"", deciding, paper),
  };
  return keys;
}

const std::vector<Key<BodyDefinition>>& keys_of(Tag<BodyDefinition>) {
  using D = BodyDefinition;
  const auto plain = [](const D& body) { return body.image.empty(); };
  const auto dense = [](const D& body) { return body.scan && !body.scan->grey.empty(); };
  static const std::vector<Key<D>> keys{
      key<D>("origin", &D::origin, "Lower corner of the box.",
             {.dimension = Dimension::length, .range = ranges::position, .example = R"(["0 mm", "0 mm", "-5 mm"])"}),
      key<D>("size", &D::size, "Edges of the box, multiples of the spacing.",
             {.dimension = Dimension::length,
              .required = true,
              .range = ranges::size,
              .example = R"(["1.8 cm", "7.8 cm", "1.8 cm"])"})
          .only_for("a body without an image", {"image"}, plain),
      key<D>("material", &D::material, "Material of the cells, or \"void\".",
             {.required = true, .example = R"("rock")"})
          .only_for("a body without an image, or with scan.grey", {"image", "scan"},
                    [=](const D& body) { return plain(body) || dense(body); }),
      key<D>("periodic", &D::periodic, "Opposite faces across x, y, z are joined.", {.example = R"(["x", "y"])"}),
      key<D>(
          "surface", &D::surface,
          "Cells that a region's surface passes through: whole or empty by their centre (stairs), or with the part of "
          "their stiffness and mass that is inside (cut)."),
      key<D>(
          "image", &D::image,
          "File of cell values, one a cell (.npy, .vti, .mha, .mhd, .nrrd, .nhdr, .nii, .nii.gz, .tif, .tiff, .raw); "
          "a folder of numbered TIFF slices, or \"*\" in place of the number of a slice.",
          {.example = R"("scan.nrrd")"}),
      key<D>("materials", &D::image_materials, "Material, or \"void\", of each value in the image.",
             {.required = true, .example = R"({0 = "void", 1 = "rock"})"})
          .only_for("a body with an image and without scan.grey", {"image", "scan"},
                    [=](const D& body) { return !plain(body) && !dense(body); }),
      key<D>("scan", &D::scan, "How the values of the image become cells; unset: each value is a cell.",
             {.title = "scan", .example = R"({coarsen = 2, thresholds = [80, 160]})"}),
      key<D>("factor", &D::factor,
             "File of factors, 0 to 1, on the stiffness of each cell (.npy, .vti, .mha, .mhd, .nrrd); unset: 1.",
             {.example = R"("damage.npy")"}),
      key<D>("strength", &D::strength,
             "File of factors, above 0, on the strength of each cell, in the same formats; unset: 1.",
             {.example = R"("strength.npy")"}),
      key<D>("grain_boundary", &D::grain_boundary,
             "What becomes of the cells along the boundaries of grains; unset: nothing.",
             {.title = "grain_boundary", .example = R"({labels = "grains.npy", strength = 0.5})"}),
  };
  return keys;
}

const std::vector<Key<MaterialDefinition>>& keys_of(Tag<MaterialDefinition>) {
  using D = MaterialDefinition;
  static const std::vector<Key<D>> keys{
      key<D>("youngs_modulus", [](auto& m) -> auto& { return m.elastic.youngs_modulus; }, "Young's modulus E.",
             {.dimension = Dimension::pressure,
              .required = true,
              .range = ranges::youngs_modulus,
              .example = R"("1112 MPa")"}),
      key<D>("poissons_ratio", [](auto& m) -> auto& { return m.elastic.poissons_ratio; }, "Poisson's ratio nu.",
             {.required = true, .range = ranges::poissons_ratio, .example = "0.18"}),
      key<D>(
          "density", [](auto& m) -> auto& { return m.elastic.density; }, "Mass per volume.",
          {.dimension = Dimension::density, .required = true, .range = ranges::density, .example = R"("2000 kg/m^3")"}),
      key<D>("stiffness_scatter", &D::stiffness_scatter, "How the stiffness differs from cell to cell; unset: not.",
             {.title = "stiffness_scatter", .example = R"({distribution = "normal", variation = 0.1})"}),
      key<D>("fracture", &D::fracture, "What it takes to crack the material; unset: it never does.",
             {.title = "fracture", .example = R"({tensile_strength = "3 MPa", fracture_energy = "100 J/m^2"})"}),
  };
  return keys;
}

const std::vector<Key<material::Fracture>>& keys_of(Tag<material::Fracture>) {
  using D = material::Fracture;
  using material::FractureLaw;
  // Without a law that cracks the numbers of either stay, so that one word switches it off and on.
  const auto cracks = [](const D& fracture) { return fracture.law != FractureLaw::none; };
  const auto bonds = [](Key<D> key) {
    return std::move(key).only_for("law \"bonds\" or \"none\"", {"law"},
                                   [](const D& fracture) { return fracture.law != FractureLaw::cohesive; });
  };
  const auto cells = [](Key<D> key) {
    return std::move(key).only_for("law \"cohesive\" or \"none\"", {"law"},
                                   [](const D& fracture) { return fracture.law != FractureLaw::bonds; });
  };
  const About limit{.range = ranges::bond_limit, .example = "2e-4"};
  static const std::vector<Key<D>> keys{
      key<D>("law", &D::law,
             "Cells that crack by strength and energy, bonds that break by their stretch, or \"none\": the material "
             "stays whole."),
      cells(
          key<D>(
              "tensile_strength", &D::tensile_strength, "Tension at which a crack starts.",
              {.dimension = Dimension::pressure, .required = true, .range = ranges::strength, .example = R"("3 MPa")"}))
          .needed_if(cracks),
      bonds(key<D>("critical_stretch", &D::critical_stretch,
                   "Stretch at which a bond breaks, of its length; unset: from fracture_energy.", limit)),
      bonds(key<D>("critical_shear", &D::critical_shear,
                   "Shear across a bond at which it breaks too, of its length; unset: none.", limit)),
      key<D>("fracture_energy", &D::fracture_energy, "Energy that an area of crack takes.",
             {.dimension = Dimension::energy_per_area,
              .required = true,
              .range = ranges::fracture_energy,
              .example = R"("100 J/m^2")"})
          .only_for("no critical_stretch, or law \"none\"", {"law", "critical_stretch"},
                    [cracks](const D& fracture) { return !cracks(fracture) || !fracture.critical_stretch; })
          .needed_if(cracks),
      cells(
          key<D>("softening", &D::softening, "How the stress falls as the crack opens: exponentially, or on a line.")),
      cells(key<D>("cohesion", &D::cohesion,
                   "Shear strength without pressure; unset: the material cracks in tension only.",
                   {.dimension = Dimension::pressure, .range = ranges::strength, .example = R"("8 MPa")"})),
      key<D>("friction_angle", &D::friction_angle, "Growth of the shear strength with the pressure.",
             {.dimension = Dimension::angle, .range = ranges::friction_angle, .example = R"("40 deg")"})
          .only_for("a cohesion", {"law", "cohesion"}, [](const D& fracture) { return fracture.cohesion.has_value(); }),
      cells(key<D>("residual_friction_angle", &D::residual_friction_angle,
                   "Friction of closed crack faces on each other.",
                   {.dimension = Dimension::angle, .range = ranges::friction_angle, .example = R"("30 deg")"})),
      key<D>("strength_scatter", &D::strength_scatter,
             "How strength and cohesion, alike, differ from cell to cell; unset: not.",
             {.title = "strength_scatter", .example = R"({modulus = 10})"}),
  };
  return keys;
}

const std::vector<Key<RegionDefinition>>& keys_of(Tag<RegionDefinition>) {
  using D = RegionDefinition;
  using Shape = D::Shape;
  // A key that some shapes have and then need.
  const auto of = [](const std::vector<Shape>& shapes, Key<D> key) {
    std::string condition;
    for (const Shape shape : shapes)
      condition += (condition.empty() ? "shape " : " or ") + toml_text(choice_name(shape));
    return std::move(key).only_for(condition, {"shape"}, [shapes](const D& region) {
      return std::find(shapes.begin(), shapes.end(), region.shape) != shapes.end();
    });
  };
  const About size{.dimension = Dimension::length, .required = true, .range = ranges::size, .example = R"("12 mm")"};
  const auto at = [](const std::string& example) {
    return About{.dimension = Dimension::length, .required = true, .range = ranges::position, .example = example};
  };
  static const std::vector<Key<D>> keys{
      key<D>("name", &D::name, "Name by which selections find its surface.", {.example = R"("bore")"}),
      key<D>("shape", &D::shape, "Cells whose centre lies inside the shape belong to the region.", {.required = true}),
      key<D>("material", &D::material, "A material's name, or \"void\".", {.required = true, .example = R"("clay")"}),
      of({Shape::box}, key<D>("min", &D::min, "Lower corner.", at(R"([0, 0, 0])"))),
      of({Shape::box}, key<D>("max", &D::max, "Upper corner.", at(R"(["10 mm", "10 mm", "5 mm"])"))),
      of({Shape::sphere}, key<D>("center", &D::center, "Centre.", at(R"(["20 mm", "20 mm", "50 mm"])"))),
      of({Shape::sphere, Shape::cylinder}, key<D>("radius", &D::radius, "Radius.", size)),
      of({Shape::cylinder}, key<D>("start", &D::start, "One end of the axis.", at(R"(["30 mm", "0 mm", "25 mm"])"))),
      of({Shape::cylinder}, key<D>("end", &D::end, "Other end of the axis.", at(R"(["30 mm", "40 mm", "25 mm"])"))),
      of({Shape::half_space}, key<D>("point", &D::point, "A point of the border plane.", at(R"([0, 0, "3 mm"])"))),
      of({Shape::half_space}, key<D>("normal", &D::normal, "Direction that points out of the half-space.",
                                     {.required = true, .range = ranges::direction, .example = "[0, 0, 1]"})),
      of({Shape::stl},
         key<D>("file", &D::file, "File of a closed surface.", {.required = true, .example = R"("implant.stl")"})),
      of({Shape::stl}, key<D>("scale", &D::scale, "Length of one unit of the file.",
                              {.dimension = Dimension::length, .range = ranges::size, .example = R"("1 mm")"})),
  };
  return keys;
}

}  // namespace koshi::io
