// Fields of a run for ParaView: one image file per sample and a collection of all samples (docs/formats/output.md).
#pragma once

#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "koshi/model.h"

class vtkImageData;

namespace koshi::io {

/// One field of a sample, on the nodes or on the cells (a cell has the index of its lowest corner). Ghosts need not be
/// filled.
struct FieldData {
  std::string name;
  lattice::Field<double>* values = nullptr;
  int first_component = 0;                   ///< of `values`
  int components = 1;                        ///< number of components written
  std::vector<std::string> component_names;  ///< empty: VTK's own (0, 1, ...)
  bool on_cells = false;
  bool ghosts_filled = false;  ///< by the caller, as those of a body under a mean strain have to be
};

/// Writes `fields/sample_000000.vti` ... into the output directory and `fields.pvd`, which names them all with their
/// times. With several ranks a sample is a header `sample_000000.pvti` and a folder `sample_000000/` of one piece per
/// rank. Every sample also has the cell array `material` (index, 0 = empty); empty cells are marked as hidden.
/// A sample appears whole or not at all; its numbers do not depend on the number of ranks.
class FieldWriter {
 public:
  /// A new run removes the samples of an earlier one when it writes its first; a run restarted at `restart_time`
  /// removes those after that time and goes on (collective). The model must outlive the writer.
  FieldWriter(const model::Model& model, std::filesystem::path directory, std::optional<double> restart_time);

  /// Writes one sample (collective). A sample at the time of the last one replaces it. Exchanges the ghosts of fields
  /// on nodes that are not filled. Throws RunError with the system's reason on all ranks; earlier samples stay
  /// readable.
  void write(double time, std::span<const FieldData> fields);

 private:
  struct Sample {
    double time;
    std::string file;  // relative to the output directory
  };
  std::string write_single(std::size_t number, vtkImageData* image) const;
  std::string write_pieces(std::size_t number, vtkImageData* image) const;
  void read_collection(double restart_time);
  void write_collection() const;
  void remove_samples_from(std::size_t number) const;

  const model::Model& model_;
  std::filesystem::path directory_;
  std::vector<Sample> samples_;
  bool first_ = true;
  bool has_empty_cells_;
};

}  // namespace koshi::io
