#include "failure/crack_tracks.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "failure/fracturing.h"
#include "lattice/halo.h"

namespace koshi::failure {
namespace {

// Cells beside a crack that leads elsewhere crack at this times their strength. Below 1.3 cracks that go aslant through
// the cells still stay in their rows; from 2 on cracks that run fast do not branch.
constexpr double held = 1.5;

// Where such a cell cracks all the same, and the crack is no more than 30 degrees off those beside it, it is a part of
// theirs and not the beginning of another.
constexpr double same_crack = 0.866;

template <class F>
void for_each_neighbour(F&& f) {
  for (int k = -1; k <= 1; ++k)
    for (int j = -1; j <= 1; ++j)
      for (int i = -1; i <= 1; ++i)
        if (i != 0 || j != 0 || k != 0) f(std::array{i, j, k});
}

template <class T>
Vec3 vector_at(const lattice::Field<T>& field, int first, std::int64_t n) {
  return {field.component(first)[n], field.component(first + 1)[n], field.component(first + 2)[n]};
}

void set_vector(lattice::Field<float>& field, int first, std::int64_t n, const Vec3& v) {
  for (int a = 0; a < 3; ++a) field.component(first + a)[n] = static_cast<float>(v[static_cast<std::size_t>(a)]);
}

}  // namespace

CrackTracks::CrackTracks(const model::Model& model, const model::State& state)
    : model_(model), state_(state), plane_(model.layout(), plane_parts), ahead_(model.layout(), ahead_parts) {}

template <class F>
void CrackTracks::for_each_here(F&& f) const {
  const Int3& owned = model_.layout().owned();
  lattice::for_each(model_.layout(), {-1, -1, -1}, {owned[0] + 1, owned[1] + 1, owned[2] + 1}, f);
}

void CrackTracks::restore() {
  plane_.zero();
  ahead_.zero();
  for_each_here([&](auto, auto, auto, auto n) { take(n); });
  for_each_here([&](auto, auto, auto, auto n) { look_ahead_around(n); });
  model_.lattice.halo->exchange(ahead_);
}

void CrackTracks::follow(std::span<const std::int64_t> begun) {
  if (!model_.communicator.any(!begun.empty())) return;
  for (const std::int64_t n : begun) take(n);
  for (const std::int64_t n : begun) look_ahead_around(n);
  const lattice::Halo& halo = *model_.lattice.halo;
  if (!halo.active()) return;

  // Cells beyond the border have neighbours here, also those that touch no node of this rank.
  halo.exchange(plane_);
  for_each_here([&](auto i, auto j, auto k, auto n) {
    if (!model_.layout().owns({i, j, k})) look_ahead_around(n);
  });
  halo.exchange(ahead_);
}

void CrackTracks::take(std::int64_t n) {
  const double offset = state_.crack.component(Fracturing::offset)[n];
  if (state_.crack.component(Fracturing::kappa)[n] == 0 || std::isinf(offset)) return;
  set_vector(plane_, normal, n, vector_at(state_.crack, Fracturing::normal, n));
  plane_.component(from_middle)[n] = static_cast<float>(offset / model_.lattice.grid.d);
}

void CrackTracks::look_ahead_around(std::int64_t n) {
  const Vec3 across = vector_at(plane_, normal, n);
  if (across == Vec3{}) return;
  const lattice::Layout& layout = model_.layout();
  const Int3 cell = layout.place(n);
  for_each_neighbour([&](const std::array<int, 3>& s) {
    const Int3 other{cell[0] + s[0], cell[1] + s[1], cell[2] + s[2]};
    if (layout.owns(other)) look_ahead(layout.index(other));
  });
}

// The planes of the cells around, each of which counts by its closeness, as one plane through this cell; or, if none of
// them cuts it, the normal that they have.
void CrackTracks::look_ahead(std::int64_t n) {
  double weight = 0, above = 0;
  Vec3 led{}, near{};
  const auto add = [](Vec3& mean, const Vec3& across, double share) {
    const double side = dot(across, mean) < 0 ? -share : share;
    mean = mean + side * across;
    return side;
  };
  for_each_neighbour([&](const std::array<int, 3>& s) {
    const std::int64_t other = n + model_.layout().offset(s);
    const Vec3 across = vector_at(plane_, normal, other);
    if (across == Vec3{}) return;
    const Vec3 from_here{double(s[0]), double(s[1]), double(s[2])};
    const double share = 1 / dot(from_here, from_here);
    add(near, across, share);
    const double plane_above = plane_.component(from_middle)[other] + dot(across, from_here);
    if (std::abs(plane_above) > 0.5 * band_width(1, across)) return;
    weight += share;
    above += add(led, across, share) * plane_above;
  });
  if (near == Vec3{}) return;
  const Vec3& mean = weight > 0 ? led : near;
  set_vector(ahead_, others_normal, n, (1 / norm(mean)) * mean);
  ahead_.component(distance)[n] = weight > 0 ? static_cast<float>(above / weight) : 0;
  ahead_.component(beside)[n] = weight > 0 ? 0 : 1;
}

double CrackTracks::hold(std::int64_t n, const Crack& crack) const {
  return !crack.shear && ahead_.component(beside)[n] != 0 ? held : 1;
}

Vec3 CrackTracks::lead(std::int64_t n) const {
  return ahead_.component(beside)[n] != 0 ? Vec3{} : vector_at(ahead_, others_normal, n);
}

double CrackTracks::offset(std::int64_t n, const Crack& crack) const {
  const Vec3 others = vector_at(ahead_, others_normal, n);
  const bool same = ahead_.component(beside)[n] != 0 && std::abs(dot(others, crack.normal)) > same_crack;
  if (crack.shear || same) return std::numeric_limits<double>::infinity();
  const double d = model_.lattice.grid.d, half = 0.5 * band_width(d, crack.normal);
  return std::clamp(d * ahead_.component(distance)[n] * dot(others, crack.normal), -half, half);
}

}  // namespace koshi::failure
