// The inner loops of the lattice: forces on one row of nodes. The same source (row_kernels.cpp) is compiled for several
// instruction sets; the widest one the processor has is chosen at run time.
//
// Plain structs and pointers only: code compiled for one instruction set must not leak into the rest of the program.
#pragma once

#include <cstddef>
#include <cstdint>

namespace koshi::mechanics {

/// Force on a node deep inside one material as a 27-point stencil with cubic symmetry: F = -K u with constant
/// coefficients. Offsets o with one, two or three non-zero components are edges, faces, bodies. For the component along
/// axis a, "along" marks offsets with a component along a, "across" those without.
template <class T>
struct Stencil {
  /// Action of a vector field on itself (displacement on force, rotation on moment).
  struct Vector {
    T centre, edge_along, edge_across, face_along, face_across, body;  // same component, even in all directions
    T face_mixed, body_mixed;                                          // other component, odd in both their directions
  };
  /// sum_o c(o) o x v(o): rotation on force, displacement on moment.
  struct Cross {
    T edge, face, body;
  };
  Vector displacement, rotation;
  Cross coupling;
};

/// Force on a node in a flat face across x: four cells of one material on the side `toward` (1: above the node, -1:
/// below), none on the other. Columns of the matrix by neighbour (z slowest, y, then the node's own plane and the next
/// one towards the cells) and component, the force's components in the first lanes.
template <class T>
struct FaceStencil {
  static constexpr int neighbours = 18, lanes = 8;
  int toward;
  T column[neighbours][6][lanes];
};

/// One row of nodes seen by the kernels: pointers to node i = 0 of the row.
template <class T>
struct Row {
  const T* u[6];                 ///< ux, uy, uz, wx, wy, wz
  const std::uint8_t* bond[13];  ///< class of the forward bonds
  const std::uint8_t* cell;      ///< material of the cells
  std::ptrdiff_t pitch, plane;   ///< distance to the next row in y and in z
};

/// What classes and materials mean. The bond classes of a family have consecutive numbers.
template <class T>
struct Tables {
  static constexpr int entries = 256 + 32;  ///< one per number, and padding for vectors
  /// By class, zero for those of other families.
  struct Family {
    const T* kt;         ///< shear stiffness
    const T* kb;         ///< (kn - kt) / |s|^2
    std::uint8_t first;  ///< number before that of the family's first class
    int size;            ///< classes from `first` on
  };
  Family family[3];
  const T* volumetric;  ///< kappa d / 16 of a material
  const T* fit;         ///< (kt1/4 + kt2 + kt3) / 8 of a material: the least-squares rotation of shared springs
  int materials;        ///< in use, 0 (empty) included
  T half_d;             ///< d / 2
};

/// Work space of one row: `stencil` 18 rows, `cell` 4 rows; rows hold `length` elements, node i = 0 at `lead`.
template <class T>
struct Scratch {
  T* stencil[18];
  T* cell[4];
};

/// All functions handle nodes first <= i < last, but may write force beyond, up to whole vectors within the row's
/// padding.
template <class T>
struct RowKernels {
  /// Constant coefficients: force[c][i] = (-K u)_c.
  void (*uniform)(const Stencil<T>&, const Row<T>&, std::int64_t first, std::int64_t last, const Scratch<T>&,
                  T* const force[6]);
  void (*uniform_displacement)(const Stencil<T>&, const Row<T>&, std::int64_t first, std::int64_t last,
                               const Scratch<T>&, T* const force[6]);
  /// The same for the single node i in a face across x.
  void (*face)(const FaceStencil<T>&, const Row<T>&, std::int64_t i, T* const force[6]);
  void (*face_displacement)(const FaceStencil<T>&, const Row<T>&, std::int64_t i, T* const force[6]);
  /// Bonds of any class: sets force to the sum over the 26 bonds.
  void (*bonds)(const Tables<T>&, const Row<T>&, std::int64_t first, std::int64_t last, T* const force[6]);
  void (*bonds_displacement)(const Tables<T>&, const Row<T>&, std::int64_t first, std::int64_t last, T* const force[6]);
  /// Adds the volumetric springs of the eight cells around each node.
  void (*volumetric)(const Tables<T>&, const Row<T>&, std::int64_t first, std::int64_t last, const Scratch<T>&,
                     T* const force[6]);
  /// Adds what the least-squares rotation of shared springs takes off.
  void (*fit)(const Tables<T>&, const Row<T>&, std::int64_t first, std::int64_t last, const Scratch<T>&,
              T* const force[6]);
  const char* instruction_set;
};

/// Kernels for this processor.
template <class T>
const RowKernels<T>& row_kernels();

}  // namespace koshi::mechanics
