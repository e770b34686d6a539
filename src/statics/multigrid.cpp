#include "statics/multigrid.h"

#include <string>

namespace koshi::statics {
namespace {

// Nodes below which a level is held by every rank, and unknowns below which it is solved directly.
constexpr std::int64_t gathered_nodes = 30000;
constexpr std::int64_t direct_unknowns = 8000;

// A box of a row field as bytes, and back.
template <class T>
std::string packed(const RowField<T>& field) {
  std::string bytes;
  const Int3& n = field.owned();
  for (std::int64_t k = 0; k < n[2]; ++k)
    for (std::int64_t j = 0; j < n[1]; ++j)
      for (int c = 0; c < field.components(); ++c)
        bytes.append(reinterpret_cast<const char*>(field.row(j, k) + c * field.pitch()),
                     static_cast<std::size_t>(n[0]) * sizeof(T));
  return bytes;
}

// Puts together what packed() made on all ranks.
template <class T>
void unpack(const std::string& bytes, const lattice::Partition& partition, int ranks, RowField<T>& field) {
  const char* from = bytes.data();
  for (int rank = 0; rank < ranks; ++rank) {
    const lattice::Layout box = partition.layout(rank);
    const std::size_t row = static_cast<std::size_t>(box.owned()[0]) * sizeof(T);
    for (std::int64_t k = 0; k < box.owned()[2]; ++k)
      for (std::int64_t j = 0; j < box.owned()[1]; ++j)
        for (int c = 0; c < field.components(); ++c, from += row)
          std::memcpy(field.row(j + box.begin()[1], k + box.begin()[2]) + c * field.pitch() + box.begin()[0], from,
                      row);
  }
}

RowField<float> constants_of(const Level& level) {
  RowField<float> constants(level.grid().owned(), mechanics::cell_constants);
  const Int3& n = constants.owned();
  for (std::int64_t k = 0; k < n[2]; ++k)
    for (std::int64_t j = 0; j < n[1]; ++j)
      for (int q = 0; q < mechanics::cell_constants; ++q)
        for (std::int64_t i = 0; i < n[0]; ++i)
          constants.row(j, k)[q * constants.pitch() + i] = level.springs().constant(level.springs().row(j, k), i, q);
  return constants;
}

LevelGrid on_one_rank(const LevelGrid& grid) {
  LevelGrid whole;
  whole.grid = grid.grid;
  auto partition = std::make_shared<const lattice::Partition>(lattice::make_partition(grid.grid, 1));
  whole.halo = std::make_shared<const lattice::Halo>(grid.grid, *partition, Communicator::self());
  whole.partition = std::move(partition);
  return whole;
}

FixedNodes gathered(const FixedNodes& fixed, const LevelGrid& grid, const LevelGrid& whole) {
  RowField<std::uint8_t> mask(grid.owned(), 1), all(whole.owned(), 1);
  for (const FixedNode& f : fixed) mask.row(f.node[1], f.node[2])[f.node[0]] = f.mask;
  RowField<float> spring(grid.owned(), 6), springs(whole.owned(), 6);
  for (const FixedNode& f : fixed)
    for (std::size_t s = 0; s < 6; ++s)
      spring.row(f.node[1], f.node[2])[static_cast<std::ptrdiff_t>(s) * spring.pitch() + f.node[0]] = f.spring[s];
  const Communicator& communicator = grid.halo->communicator();
  unpack(communicator.all_gather(packed(mask)), *grid.partition, communicator.size(), all);
  unpack(communicator.all_gather(packed(spring)), *grid.partition, communicator.size(), springs);
  FixedNodes result;
  for (std::int64_t k = 0; k < whole.owned()[2]; ++k)
    for (std::int64_t j = 0; j < whole.owned()[1]; ++j)
      for (std::int64_t i = 0; i < whole.owned()[0]; ++i) {
        FixedNode node{{i, j, k}, all.row(j, k)[i], {}};
        for (std::size_t s = 0; s < 6; ++s)
          node.spring[s] = springs.row(j, k)[static_cast<std::ptrdiff_t>(s) * springs.pitch() + i];
        if (node.mask != 0 || node.sprung()) result.push_back(node);
      }
  return result;
}

}  // namespace

/// The whole of a distributed level on this rank.
class Hierarchy::Gathered {
 public:
  Gathered(const Level& level, const CycleOptions& options) : level_(level), grid_(on_one_rank(level.grid())) {
    RowField<float> whole(grid_.owned(), mechanics::cell_constants);
    collect(constants_of(level), whole);
    whole.exchange(*grid_.halo);
    CycleOptions serial = options;
    serial.serial = true;
    hierarchy_ = std::make_unique<Hierarchy>(grid_, level.components(), std::move(whole),
                                             gathered(level.fixed(), level.grid(), grid_), serial);
  }

  void solve(Level& level) {
    Level& whole = hierarchy_->finest();
    collect(level.b, whole.b);
    hierarchy_->cycle();
    const lattice::Layout& box = level.grid().halo->layout();
    for (std::int64_t k = 0; k < box.owned()[2]; ++k)
      for (std::int64_t j = 0; j < box.owned()[1]; ++j)
        for (int c = 0; c < level.components(); ++c)
          std::memcpy(level.x.row(j, k) + c * level.x.pitch(),
                      whole.x.row(j + box.begin()[1], k + box.begin()[2]) + c * whole.x.pitch() + box.begin()[0],
                      static_cast<std::size_t>(box.owned()[0]) * sizeof(float));
  }

  int level_count() const { return hierarchy_->level_count(); }

 private:
  void collect(const RowField<float>& part, RowField<float>& whole) const {
    const Communicator& communicator = level_.grid().halo->communicator();
    unpack(communicator.all_gather(packed(part)), *level_.grid().partition, communicator.size(), whole);
  }

  const Level& level_;
  LevelGrid grid_;
  std::unique_ptr<Hierarchy> hierarchy_;
};

Hierarchy::Hierarchy(const LevelGrid& grid, int components, RowField<float> constants, const FixedNodes& fixed,
                     const CycleOptions& options)
    : options_(options) {
  options_.serial = options.serial || grid.halo->communicator().size() == 1;
  // What cells at surfaces add is known to the finest level alone, so that one is relaxed however small it is.
  SurfaceTerms* surface = options.surface;
  options_.surface = nullptr;
  LevelGrid fine = grid;
  FixedNodes held = fixed;
  while (true) {
    const std::int64_t nodes = fine.grid.node_count();
    const bool small = options_.serial ? nodes * components <= direct_unknowns : nodes <= gathered_nodes;
    const bool last = (small && surface == nullptr) || !fine.can_coarsen();
    const LevelGrid coarse = last ? LevelGrid{} : fine.coarsened();
    RowField<float> merged;
    if (!last) merged = coarsened(constants, fine, coarse);
    levels_.push_back(std::make_unique<Level>(fine, components, std::move(constants), std::move(held), surface));
    if (last) break;
    constants = std::move(merged);
    held = coarsened(levels_.back()->fixed(), fine.owned(), coarse.owned());
    fine = coarse;
    surface = nullptr;
  }
  if (options_.serial) {
    coarse_ = std::make_unique<CoarseSolver>(*levels_.back(), options_.shift);
  } else {
    gathered_ = std::make_unique<Gathered>(*levels_.back(), options_);
  }
}

Hierarchy::~Hierarchy() = default;

int Hierarchy::level_count() const {
  const int own = static_cast<int>(levels_.size());
  return gathered_ ? own - 1 + gathered_->level_count() : own;
}

void Hierarchy::cycle(std::size_t l) {
  Level& level = *levels_[l];
  if (l + 1 == levels_.size()) {
    options_.serial ? coarse_->solve(level) : gathered_->solve(level);
    return;
  }
  Level& coarse = *levels_[l + 1];
  level.relax(options_.degree, options_.bound, true);
  level.restrict_residual(coarse);
  cycle(l + 1);
  level.add_correction(coarse);
  level.relax(options_.degree, options_.bound, false);
}

}  // namespace koshi::statics
