#include "statics/parts.h"

#include <algorithm>
#include <cstring>
#include <numeric>
#include <string>
#include <tuple>

#include "lattice/halo.h"

namespace koshi::statics {
namespace {

/// Sets that grow together (union-find, the smaller number represents).
class Sets {
 public:
  explicit Sets(std::size_t count) : parent_(count) { std::iota(parent_.begin(), parent_.end(), 0); }
  std::int32_t find(std::int32_t a) {
    while (parent_[static_cast<std::size_t>(a)] != a) {
      std::int32_t& up = parent_[static_cast<std::size_t>(a)];
      up = parent_[static_cast<std::size_t>(up)];
      a = up;
    }
    return a;
  }
  void join(std::int32_t a, std::int32_t b) {
    a = find(a);
    b = find(b);
    parent_[static_cast<std::size_t>(std::max(a, b))] = std::min(a, b);
  }

 private:
  std::vector<std::int32_t> parent_;
};

template <class T>
std::vector<T> all_gathered(const Communicator& communicator, const std::vector<T>& own) {
  const std::string bytes =
      communicator.all_gather(std::string(reinterpret_cast<const char*>(own.data()), own.size() * sizeof(T)));
  std::vector<T> all(bytes.size() / sizeof(T));
  if (!all.empty()) std::memcpy(all.data(), bytes.data(), bytes.size());
  return all;
}

}  // namespace

Parts::Parts(const model::SpringLattice& body) : owned_(body.layout.owned()) {
  find_runs(body);
  join_across_ranks(body);
}

// Runs of solid cells along x, each numbered by the connected set of runs it belongs to on this rank.
void Parts::find_runs(const model::SpringLattice& body) {
  const std::uint16_t* const cell = body.cell.component(0);
  for (std::int64_t k = -1; k < owned_[2]; ++k)
    for (std::int64_t j = -1; j < owned_[1]; ++j) {
      row_runs_.push_back(static_cast<std::int64_t>(runs_.size()));
      const std::int64_t n = body.layout.index(0, j, k);
      for (std::int64_t i = -1; i < owned_[0]; ++i) {
        if (cell[n + i] == 0) continue;
        const auto at = static_cast<std::int32_t>(i);
        if (static_cast<std::int64_t>(runs_.size()) == row_runs_.back() || runs_.back().last != at)
          runs_.push_back({at, at, static_cast<std::int32_t>(runs_.size())});
        runs_.back().last = at + 1;
      }
    }
  row_runs_.push_back(static_cast<std::int64_t>(runs_.size()));

  // Runs in neighbouring rows touch when a node of one is a node of the other.
  Sets sets(runs_.size());
  const auto join_rows = [&](std::size_t a, std::size_t b) {
    std::int64_t q = row_runs_[b];
    for (std::int64_t p = row_runs_[a]; p < row_runs_[a + 1]; ++p) {
      const Run& run = runs_[static_cast<std::size_t>(p)];
      while (q < row_runs_[b + 1] && runs_[static_cast<std::size_t>(q)].last < run.first) ++q;
      for (std::int64_t r = q; r < row_runs_[b + 1] && runs_[static_cast<std::size_t>(r)].first <= run.last; ++r)
        sets.join(static_cast<std::int32_t>(p), static_cast<std::int32_t>(r));
    }
  };
  for (std::int64_t k = -1; k < owned_[2]; ++k)
    for (std::int64_t j = -1; j < owned_[1]; ++j) {
      if (j >= 0) join_rows(row(j, k), row(j - 1, k));
      if (k < 0) continue;
      for (std::int64_t dj = -1; dj <= 1; ++dj)
        if (j + dj >= -1 && j + dj < owned_[1]) join_rows(row(j, k), row(j + dj, k - 1));
    }
  for (std::size_t r = 0; r < runs_.size(); ++r) runs_[r].part = sets.find(static_cast<std::int32_t>(r));
}

void Parts::join_across_ranks(const model::SpringLattice& body) {
  // Sets of this rank get numbers that no other rank uses.
  std::vector<std::int32_t> number(runs_.size(), -1);
  std::int32_t count = 0;
  for (Run& run : runs_) {
    std::int32_t& n = number[static_cast<std::size_t>(run.part)];
    if (n < 0) n = count++;
    run.part = n;
  }
  const Communicator& communicator = body.halo->communicator();
  const std::vector<std::int32_t> counts = all_gathered(communicator, std::vector<std::int32_t>{count});
  const std::int32_t offset = std::accumulate(counts.begin(), counts.begin() + communicator.rank(), 0);
  const std::int32_t total = std::accumulate(counts.begin(), counts.end(), 0);
  for (Run& run : runs_) run.part += offset;

  // A node that two ranks know joins their sets: compare the owner's number with one's own on the ghosts.
  Sets sets(static_cast<std::size_t>(total));
  if (body.halo->active()) {
    lattice::Field<std::int32_t> owner(body.layout, 1);
    lattice::for_each_owned(body.layout, [&](auto i, auto j, auto k, auto n) {
      owner.component(0)[n] = of_node({i, j, k}) + 1;
    });
    body.halo->exchange(owner);
    std::vector<std::array<std::int32_t, 2>> pairs;
    const Int3 end{owned_[0] + 1, owned_[1] + 1, owned_[2] + 1};
    lattice::for_each(body.layout, {-1, -1, -1}, end, [&](auto i, auto j, auto k, auto n) {
      if (body.layout.owns({i, j, k})) return;
      const std::int32_t theirs = owner.component(0)[n] - 1, own = of_node({i, j, k});
      if (theirs >= 0 && own >= 0 && sets.find(theirs) != sets.find(own)) {
        sets.join(theirs, own);
        pairs.push_back({theirs, own});
      }
    });
    for (const auto& [a, b] : all_gathered(communicator, pairs)) sets.join(a, b);
  }

  // Sizes and boxes; a cell belongs to the rank that owns its lowest corner.
  struct Piece {
    std::int32_t set;
    Part part;
  };
  std::vector<Piece> own(static_cast<std::size_t>(count), Piece{-1, {}});
  const Int3& begin = body.layout.begin();
  const auto extend = [](Part& part, const Int3& lo, const Int3& hi) {
    for (int a = 0; a < 3; ++a) {
      part.lo[a] = part.cells == 0 ? lo[a] : std::min(part.lo[a], lo[a]);
      part.hi[a] = part.cells == 0 ? hi[a] : std::max(part.hi[a], hi[a]);
    }
  };
  for (std::int64_t k = 0; k < owned_[2]; ++k)
    for (std::int64_t j = 0; j < owned_[1]; ++j)
      for (std::int64_t r = row_runs_[row(j, k)]; r < row_runs_[row(j, k) + 1]; ++r) {
        const Run& run = runs_[static_cast<std::size_t>(r)];
        const std::int64_t first = std::max(run.first, 0);
        if (first >= run.last) continue;
        Piece& piece = own[static_cast<std::size_t>(run.part - offset)];
        piece.set = sets.find(run.part);
        extend(piece.part, {begin[0] + first, begin[1] + j, begin[2] + k},
               {begin[0] + run.last, begin[1] + j + 1, begin[2] + k + 1});
        piece.part.cells += run.last - first;
      }
  std::vector<Piece> merged(static_cast<std::size_t>(total), Piece{-1, {}});
  for (const Piece& piece : all_gathered(communicator, own)) {
    if (piece.part.cells == 0) continue;
    Piece& whole = merged[static_cast<std::size_t>(piece.set)];
    whole.set = piece.set;
    extend(whole.part, piece.part.lo, piece.part.hi);
    whole.part.cells += piece.part.cells;
  }
  std::erase_if(merged, [](const Piece& piece) { return piece.set < 0; });
  std::sort(merged.begin(), merged.end(), [](const Piece& a, const Piece& b) {
    return std::tie(b.part.cells, a.part.lo[2], a.part.lo[1], a.part.lo[0], a.set) <
           std::tie(a.part.cells, b.part.lo[2], b.part.lo[1], b.part.lo[0], b.set);
  });
  std::vector<std::int32_t> place(static_cast<std::size_t>(total), -1);
  for (const Piece& piece : merged) {
    place[static_cast<std::size_t>(piece.set)] = static_cast<std::int32_t>(parts_.size());
    parts_.push_back(piece.part);
  }
  for (Run& run : runs_) run.part = place[static_cast<std::size_t>(sets.find(run.part))];
}

std::int32_t Parts::of_node(const Int3& node) const {
  // A run that touches the node in one of the four rows of cells around it.
  for (int side = 0; side < 4; ++side) {
    const std::int64_t j = node[1] - (side & 1), k = node[2] - (side >> 1);
    if (j < -1 || k < -1 || j >= owned_[1] || k >= owned_[2]) continue;
    const auto begin = runs_.begin() + row_runs_[row(j, k)], end = runs_.begin() + row_runs_[row(j, k) + 1];
    const auto run = std::lower_bound(begin, end, node[0], [](const Run& r, std::int64_t i) { return r.last < i; });
    if (run != end && run->first <= node[0]) return run->part;
  }
  return -1;
}

}  // namespace koshi::statics
