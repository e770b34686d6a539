#include "io/surface.h"

#include <fmt/format.h>
#include <vtkFeatureEdges.h>
#include <vtkImageStencilData.h>
#include <vtkNew.h>
#include <vtkPolyData.h>
#include <vtkPolyDataToImageStencil.h>
#include <vtkSTLReader.h>

#include <algorithm>

#include "io/vtk_errors.h"
#include "koshi/error.h"

namespace koshi::io {
namespace {

vtkSmartPointer<vtkPolyData> read_stl(const std::filesystem::path& file) {
  vtkNew<vtkSTLReader> reader;
  const VtkErrors errors;
  reader->SetFileName(file.c_str());
  reader->Update();
  if (!errors.first().empty() || reader->GetErrorCode() != 0)
    throw InputError("cannot be read as STL" + (errors.first().empty() ? "" : ": " + errors.first()));
  vtkSmartPointer<vtkPolyData> surface = reader->GetOutput();
  if (surface->GetNumberOfCells() == 0) throw InputError("holds no triangles");
  return surface;
}

// Inside and outside are known only where every edge joins two triangles (or any even number that closes).
void check_closed(vtkPolyData* surface) {
  vtkNew<vtkFeatureEdges> edges;
  edges->SetInputData(surface);
  edges->FeatureEdgesOff();
  edges->ManifoldEdgesOff();
  edges->NonManifoldEdgesOff();
  edges->BoundaryEdgesOn();
  edges->Update();
  if (const auto open = edges->GetOutput()->GetNumberOfCells(); open > 0)
    throw InputError(
        fmt::format("is no closed surface: {} of its edges belong to one triangle only; close its holes", open));
}

}  // namespace

std::vector<std::uint8_t> cells_inside(const std::filesystem::path& file, double scale, const lattice::Grid& grid) {
  const vtkSmartPointer<vtkPolyData> surface = read_stl(file);
  check_closed(surface);

  // The stencil's points are the cell centres, in the file's unit.
  const Int3& n = grid.cells;
  const double d = grid.d / scale;
  vtkNew<vtkPolyDataToImageStencil> voxels;
  voxels->SetInputData(surface);
  voxels->SetOutputSpacing(d, d, d);
  voxels->SetOutputOrigin(grid.origin[0] / scale + 0.5 * d, grid.origin[1] / scale + 0.5 * d,
                          grid.origin[2] / scale + 0.5 * d);
  voxels->SetOutputWholeExtent(0, static_cast<int>(n[0]) - 1, 0, static_cast<int>(n[1]) - 1, 0,
                               static_cast<int>(n[2]) - 1);
  voxels->Update();

  // The stencil lists, for each row of points, the stretches inside.
  vtkImageStencilData* stencil = voxels->GetOutput();
  std::vector<std::uint8_t> inside(static_cast<std::size_t>(n[0] * n[1] * n[2]), 0);
  std::int64_t count = 0;
  for (int k = 0; k < n[2]; ++k)
    for (int j = 0; j < n[1]; ++j) {
      int first = 0, last = 0, stretch = 0;
      while (stencil->GetNextExtent(first, last, 0, static_cast<int>(n[0]) - 1, j, k, stretch) != 0) {
        const auto row = inside.begin() + (j + n[1] * k) * n[0];
        std::fill(row + first, row + last + 1, 1);
        count += last + 1 - first;
      }
    }
  if (count == 0) {
    const double* b = surface->GetBounds();
    throw InputError(
        fmt::format("holds no cell's centre: it reaches from ({:.4g}, {:.4g}, {:.4g}) to ({:.4g}, {:.4g}, {:.4g}) m; "
                    "check scale and origin",
                    scale * b[0], scale * b[2], scale * b[4], scale * b[1], scale * b[3], scale * b[5]));
  }
  return inside;
}

}  // namespace koshi::io
