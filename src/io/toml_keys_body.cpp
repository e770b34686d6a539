// Keys of the whole input, [lattice], [body], [material.NAME] and [[region]].
#include <fmt/format.h>

#include <algorithm>

#include "io/toml_key.h"

namespace koshi::io {

using namespace model;

const std::vector<Key<Definition>>& keys_of(Tag<Definition>) {
  using D = Definition;
  static const std::vector<Key<D>> keys{
      key<D>("title", &D::title, "What the case is, for people."),
      key<D>("lattice", &D::lattice, "Unit cell, spacing and springs.", {.required = true}),
      key<D>("body", &D::body, "The box of cells.", {.required = true}),
      key<D>("material", &D::materials, "Elastic materials by name, [material.NAME].", {.required = true}),
      key<D>("region", &D::regions, "Shapes that give cells another material; later ones win."),
      key<D>("boundary", &D::boundaries, "Prescribed motions."),
      key<D>("load", &D::loads, "Forces on faces, boxes, points or the whole body."),
      key<D>("analysis", &D::analysis, "What is computed."),
      key<D>("probe", &D::probes, "Values reported by name."),
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
      key<D>("spacing", &D::spacing, "Side d of a cell.", {.dimension = Dimension::length, .required = true}),
      key<D>("springs", &D::springs, "Springs belong to cells (shared), or every bond carries its full stiffness."),
      key<D>("calibration", &D::calibration,
             "How E and nu become springs; unset: bending-exact for shared Cube-III, isotropic for shared Cube-I and "
             "-II, paper for plain springs."),
      key<D>("kinematics", &D::kinematics, "Three rotations per node, or the rotation fitted to each cell."),
      key<D>("equations", &D::equations,
             "Entries of C set equal to the elastic tensor, such as \"C1122\" or \"C1111-C1122\": one for Cube-I, two "
             "for Cube-II and -III; unset: those of the paper.")
          .only_for("calibration \"paper\"", deciding, paper),
      key<D>("axes", &D::axes, "Which body axes are 1, 2, 3 of C: a permutation of \"xyz\".")
          .only_for("calibration \"paper\"", deciding, paper),
  };
  return keys;
}

const std::vector<Key<BodyDefinition>>& keys_of(Tag<BodyDefinition>) {
  using D = BodyDefinition;
  const auto plain = [](const D& body) { return body.image.empty(); };
  const auto imaged = [](const D& body) { return !body.image.empty(); };
  static const std::vector<Key<D>> keys{
      key<D>("origin", &D::origin, "Lower corner of the box.", {.dimension = Dimension::length}),
      key<D>("size", &D::size, "Edges of the box, multiples of the spacing.",
             {.dimension = Dimension::length, .required = true})
          .only_for("a body without an image", {"image"}, plain),
      key<D>("material", &D::material, "Material of the cells, or \"void\".", {.required = true})
          .only_for("a body without an image", {"image"}, plain),
      key<D>("periodic", &D::periodic, "Opposite faces across x, y, z are joined."),
      key<D>("image", &D::image, "File of cell values (.npy, .vti, .mha, .mhd, .nrrd), one value a cell."),
      key<D>("materials", &D::image_materials, "Material, or \"void\", of each value in the image.", {.required = true})
          .only_for("a body with an image", {"image"}, imaged),
  };
  return keys;
}

const std::vector<Key<MaterialDefinition>>& keys_of(Tag<MaterialDefinition>) {
  using D = MaterialDefinition;
  static const std::vector<Key<D>> keys{
      key<D>("youngs_modulus", [](auto& m) -> auto& { return m.elastic.youngs_modulus; }, "Young's modulus E.",
             {.dimension = Dimension::pressure, .required = true}),
      key<D>("poissons_ratio", [](auto& m) -> auto& { return m.elastic.poissons_ratio; },
             "Poisson's ratio nu, between -1 and 0.5.", {.required = true}),
      key<D>("density", [](auto& m) -> auto& { return m.elastic.density; }, "Mass per volume.",
             {.dimension = Dimension::density, .required = true}),
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
  const About length{.dimension = Dimension::length, .required = true};
  static const std::vector<Key<D>> keys{
      key<D>("shape", &D::shape, "Cells whose centre lies inside the shape belong to the region.", {.required = true}),
      key<D>("material", &D::material, "A material's name, or \"void\".", {.required = true}),
      of({Shape::box}, key<D>("min", &D::min, "Lower corner.", length)),
      of({Shape::box}, key<D>("max", &D::max, "Upper corner.", length)),
      of({Shape::sphere}, key<D>("center", &D::center, "Centre.", length)),
      of({Shape::sphere, Shape::cylinder}, key<D>("radius", &D::radius, "Radius.", length)),
      of({Shape::cylinder}, key<D>("start", &D::start, "One end of the axis.", length)),
      of({Shape::cylinder}, key<D>("end", &D::end, "Other end of the axis.", length)),
      of({Shape::half_space}, key<D>("point", &D::point, "A point of the border plane.", length)),
      of({Shape::half_space},
         key<D>("normal", &D::normal, "Direction that points out of the half-space.", {.required = true})),
      of({Shape::stl}, key<D>("file", &D::file, "File of a closed surface.", {.required = true})),
      of({Shape::stl}, key<D>("scale", &D::scale, "Length of one unit of the file.", {.dimension = Dimension::length})),
  };
  return keys;
}

}  // namespace koshi::io
