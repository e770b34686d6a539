#include "lattice/halo.h"

#include <mpi.h>

#include <cstring>

#include "base/poison.h"

namespace koshi::lattice {
namespace {

/// What goes to and comes from the neighbour in one of the 26 directions.
struct Link {
  int rank;
  int send_tag, receive_tag;    // the direction as the sender sees it
  Int3 send_lo, send_hi;        // owned nodes at the border
  Int3 receive_lo, receive_hi;  // ghost nodes
  std::vector<std::byte> send, receive;

  std::size_t node_count() const {
    std::size_t n = 1;
    for (int a = 0; a < 3; ++a) n *= static_cast<std::size_t>(send_hi[a] - send_lo[a]);
    return n;
  }
};

int tag(const std::array<int, 3>& s) { return s[0] + 1 + 3 * (s[1] + 1) + 9 * (s[2] + 1); }

// Copies the rows of a box between node values and a buffer; `to_values` says which way. `bytes`: distances in memory.
template <bool to_values>
void copy_box(const Int3& lo, const Int3& hi, std::byte* origin, std::byte* buffer, int components,
              const Halo::Strides& bytes, std::int64_t element) {
  const std::size_t row = static_cast<std::size_t>((hi[0] - lo[0]) * element);
  for (int c = 0; c < components; ++c)
    for (std::int64_t k = lo[2]; k < hi[2]; ++k)
      for (std::int64_t j = lo[1]; j < hi[1]; ++j, buffer += row) {
        std::byte* at = origin + c * bytes.component + k * bytes.z + j * bytes.y + lo[0] * element;
        if constexpr (to_values)
          std::memcpy(at, buffer, row);
        else
          std::memcpy(buffer, at, row);
      }
}

}  // namespace

struct Halo::Implementation {
  Layout layout;
  Communicator communicator;
  std::vector<Link> links;
  std::vector<MPI_Request> requests;
  // The values on their way.
  std::byte* origin = nullptr;
  int components = 0;
  Strides bytes{};
  std::int64_t element = 0;
};

Halo::Halo(const Grid& grid, const Partition& partition, const Communicator& communicator)
    : self_(new Implementation{partition.layout(communicator.rank()), communicator, {}, {}}) {
  const Int3 here = partition.position(communicator.rank());
  const Int3& owned = self_->layout.owned();
  for (int z = -1; z <= 1; ++z)
    for (int y = -1; y <= 1; ++y)
      for (int x = -1; x <= 1; ++x) {
        const std::array<int, 3> s{x, y, z};
        if (s == std::array{0, 0, 0}) continue;
        Int3 there;
        bool outside = false;
        for (int a = 0; a < 3; ++a) {
          there[a] = here[a] + s[a];
          if (there[a] < 0 || there[a] >= partition.dims[a]) {
            outside = outside || !grid.periodic[a];
            there[a] = (there[a] + partition.dims[a]) % partition.dims[a];
          }
        }
        if (outside) continue;
        Link link{partition.rank(there), tag(s), tag({-x, -y, -z}), {}, {}, {}, {}, {}, {}};
        // Send the border towards s; receive the ghosts on that side.
        for (int a = 0; a < 3; ++a) {
          link.send_lo[a] = s[a] > 0 ? owned[a] - 1 : 0;
          link.send_hi[a] = s[a] < 0 ? 1 : owned[a];
          link.receive_lo[a] = s[a] < 0 ? -1 : s[a] > 0 ? owned[a] : 0;
          link.receive_hi[a] = s[a] < 0 ? 0 : s[a] > 0 ? owned[a] + 1 : owned[a];
        }
        self_->links.push_back(std::move(link));
      }
  self_->requests.reserve(2 * self_->links.size());
}

Halo::~Halo() = default;
Halo::Halo(Halo&&) noexcept = default;
Halo& Halo::operator=(Halo&&) noexcept = default;

bool Halo::active() const { return !self_->links.empty(); }
const Layout& Halo::layout() const { return self_->layout; }
const Communicator& Halo::communicator() const { return self_->communicator; }

void Halo::begin_bytes(std::byte* origin, int components, const Strides& strides, std::int64_t element) const {
  Implementation& h = *self_;
  h.origin = origin;
  h.components = components;
  h.bytes = strides;
  h.element = element;
  const MPI_Comm comm = MPI_Comm_f2c(h.communicator.handle());
  h.requests.clear();
  for (Link& link : h.links) {
    const std::size_t bytes = link.node_count() * static_cast<std::size_t>(components * element);
    link.send.resize(bytes);
    link.receive.resize(bytes);
    poison(link.receive.data(), bytes);
    MPI_Irecv(link.receive.data(), static_cast<int>(bytes), MPI_BYTE, link.rank, link.receive_tag, comm,
              &h.requests.emplace_back());
  }
  for (Link& link : h.links) {
    copy_box<false>(link.send_lo, link.send_hi, origin, link.send.data(), components, strides, element);
    MPI_Isend(link.send.data(), static_cast<int>(link.send.size()), MPI_BYTE, link.rank, link.send_tag, comm,
              &h.requests.emplace_back());
  }
}

void Halo::end() const {
  Implementation& h = *self_;
  MPI_Waitall(static_cast<int>(h.requests.size()), h.requests.data(), MPI_STATUSES_IGNORE);
  for (Link& link : h.links)
    copy_box<true>(link.receive_lo, link.receive_hi, h.origin, link.receive.data(), h.components, h.bytes, h.element);
}

}  // namespace koshi::lattice
