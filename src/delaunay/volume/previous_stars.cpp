// SPDX-License-Identifier: BSD-3-Clause
#include "delaunay/volume/previous_stars.hpp"

#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

#include "base/index_by_id.hpp"
#include "base/space_vectors.hpp"
#include "base/types.hpp"
#include "delaunay/volume/domain_rule.hpp"
#include "delaunay/volume/element_rule.hpp"
#include "delaunay/volume/volume_stars.hpp"

namespace pnpbs {
namespace {

// Checks whether a previously correct star of a node is still correct. See stars_before.hpp.
class KeptStar {
 public:
  KeptStar(const VolumeStarInput& input, const VolumeStars& stars) : in_(input), stars_(stars) {}

  // Calls fails(j) for the nodes whose stars may have changed. Each tetrahedron and face is
  // examined at the first of its corners, so that all nodes together examine each once.
  template <class Fails>
  void check(std::int64_t i, const Fails& fails) {
    if (!gather(i)) return fails(static_cast<std::int32_t>(i));
    for (const Corners& triangle : triangles_) {
      const Sphere sphere = sphere_of(triangle);
      if (is_first(i, triangle) && !is_tetrahedron(i, triangle, sphere))
        fail_at(i, triangle, fails);
      for (std::size_t k = 0; k < 3; ++k) {
        const std::int32_t p = triangle[k], q = triangle[(k + 1) % 3];
        // Selects one of the two tetrahedra at each face.
        if (node(p) < i || node(q) < node(p)) continue;
        const std::int32_t apex = beyond(p, q);
        if (apex >= 0 && surely_outside(sphere, apex)) continue;
        fail_at(i, triangle, fails);
        if (apex >= 0) fails(node(apex));
      }
    }
  }

 private:
  using Corners = VolumeStars::Corners;  // Indices among the neighbours.
  // A circumsphere. Points y relative to the node are inside if volume * y * y < normal * y.
  struct Sphere {
    Point<3> normal;
    double volume;
  };

  // Stars with more neighbours are rare and are found again.
  static constexpr std::int32_t kMaxNeighbours = 64;

  static std::size_t index(std::int32_t k) { return static_cast<std::size_t>(k); }
  std::int32_t node(std::int32_t place) const { return nodes_[index(place)]; }
  // Returns the third corner of the triangle on the other side of the edge from p to q.
  std::int32_t beyond(std::int32_t p, std::int32_t q) const {
    return third_[index(q * kMaxNeighbours + p)];
  }
  bool is_first(std::int64_t i, const Corners& triangle) const {
    return node(triangle[0]) > i && node(triangle[1]) > i && node(triangle[2]) > i;
  }
  template <class Fails>
  void fail_at(std::int64_t i, const Corners& triangle, const Fails& fails) const {
    fails(static_cast<std::int32_t>(i));
    for (const std::int32_t place : triangle) fails(node(place));
  }

  bool gather(std::int64_t i);
  Sphere sphere_of(const Corners& triangle) const;
  bool surely_outside(const Sphere& sphere, std::int32_t place) const;
  bool is_tetrahedron(std::int64_t i, const Corners& triangle, const Sphere& sphere) const;

  const VolumeStarInput& in_;
  const VolumeStars& stars_;
  std::vector<std::int32_t> nodes_;
  std::vector<Point<3>> to_;  // Relative to node i.
  std::vector<double> squares_;
  std::vector<Corners> triangles_;
  std::array<std::int8_t, kMaxNeighbours * kMaxNeighbours> third_;
  double volume_error_ = 0, sphere_error_ = 0;
};

// Relative rounding error. Each component of a difference of positions has an error of half an ulp.
// With edges of at most 1, the error of a volume (six times that of the tetrahedron) is then less
// than 60 half ulps, and that of the sphere test less than 300.
constexpr double kRounding = 0x1p-44;

// Collects positions, triangles and the third corners beyond their edges. Returns whether the star
// can be checked.
bool KeptStar::gather(std::int64_t i) {
  nodes_.clear();
  to_.clear();
  squares_.clear();
  triangles_.clear();
  const std::int32_t n = stars_.size(i);
  if (n > kMaxNeighbours || !stars_.closed(i)) return false;
  const Point<3> x = in_.nodes.position(i);
  double longest = 0;
  stars_.for_neighbours(i, [&](std::int64_t j) {
    nodes_.push_back(static_cast<std::int32_t>(j));
    to_.push_back(difference(in_.nodes.position(j), x));
    squares_.push_back(dot(to_.back(), to_.back()));
    longest = std::max(longest, squares_.back());
  });
  const double length = std::sqrt(longest);
  volume_error_ = kRounding * longest * length;
  sphere_error_ = volume_error_ * longest;
  for (std::int32_t p = 0; p < n; ++p)
    std::fill_n(third_.begin() + p * kMaxNeighbours, n, std::int8_t{-1});
  stars_.for_triangles_of_indices(i, [&](const Corners& triangle) {
    triangles_.push_back(triangle);
    for (std::size_t k = 0; k < 3; ++k)
      third_[index(triangle[k] * kMaxNeighbours + triangle[(k + 1) % 3])] =
          static_cast<std::int8_t>(triangle[(k + 2) % 3]);
  });
  return true;
}

KeptStar::Sphere KeptStar::sphere_of(const Corners& triangle) const {
  const std::size_t a = index(triangle[0]), b = index(triangle[1]), c = index(triangle[2]);
  const Point<3> bc = cross(to_[b], to_[c]), ca = cross(to_[c], to_[a]), ab = cross(to_[a], to_[b]);
  Sphere sphere{{}, dot(to_[a], bc)};
  for (std::size_t k = 0; k < 3; ++k)
    sphere.normal[k] = squares_[a] * bc[k] + squares_[b] * ca[k] + squares_[c] * ab[k];
  return sphere;
}

bool KeptStar::surely_outside(const Sphere& sphere, std::int32_t place) const {
  const std::size_t k = index(place);
  return sphere.volume * squares_[k] - dot(sphere.normal, to_[k]) > sphere_error_;
}

// Returns whether the tetrahedron is certainly of positive orientation, small enough for an element
// and part of the domain.
bool KeptStar::is_tetrahedron(std::int64_t i, const Corners& triangle, const Sphere& sphere) const {
  constexpr double kSurely = 0.999;
  if (!(sphere.volume > volume_error_)) return false;
  double d = in_.nodes.d(i);
  for (const std::int32_t place : triangle) d = std::min(d, in_.nodes.d(node(place)));
  const double limit = kSurely * 2 * kMaxRadius * d * sphere.volume;
  return dot(sphere.normal, sphere.normal) < limit * limit &&
         in_domain(in_, {i, node(triangle[0]), node(triangle[1]), node(triangle[2])});
}

constexpr std::int64_t kChunk = VolumeStars::kChunk;

std::size_t index(std::int64_t i) { return static_cast<std::size_t>(i); }

// Sets a flag. Several threads may do so at the same time.
void set(std::vector<char>& flags, std::int64_t i) {
  std::atomic_ref<char>(flags[index(i)]).store(1, std::memory_order_relaxed);
}

template <class Body>
void for_chunks(const char* label, std::int64_t count, const Body& body) {
  for_each(label, (count + kChunk - 1) / kChunk,
           [&](std::int64_t c) { body(c * kChunk, std::min((c + 1) * kChunk, count)); });
}

// Number of rows of each chunk that are still to be used by any thread.
class Uses {
 public:
  explicit Uses(std::int64_t rows) : left_(index((rows + kChunk - 1) / kChunk)) {}
  void add(std::int64_t row) { ++left_[index(row / kChunk)]; }
  bool was_last(std::int64_t row) {
    return std::atomic_ref<std::int32_t>(left_[index(row / kChunk)]).fetch_sub(1) == 1;
  }

 private:
  std::vector<std::int32_t> left_;
};

// Returns flags of the nodes whose kept stars may be wrong.
std::vector<char> doubted(const VolumeStarInput& input, const VolumeStars& stars,
                          const std::vector<char>& kept) {
  std::vector<char> fails(kept.size(), 0);
  for_chunks("pnpbs::PreviousStars::check", input.nodes.count,
             [&](std::int64_t i, std::int64_t end) {
               KeptStar star(input, stars);
               for (; i < end; ++i)
                 if (kept[index(i)]) star.check(i, [&](std::int32_t j) { set(fails, j); });
             });
  return fails;
}

// Returns whether the star of node i contains the tetrahedron with these other corners, which have
// positive orientation with it.
bool has_tetrahedron(const VolumeStars& stars, std::int64_t i,
                     const VolumeStars::Corners& corners) {
  VolumeStars::Corners places{-1, -1, -1};
  std::int32_t place = 0;
  stars.for_neighbours(i, [&](std::int64_t j) {
    for (std::size_t k = 0; k < 3; ++k)
      if (corners[k] == j) places[k] = place;
    ++place;
  });
  const std::size_t first =
      static_cast<std::size_t>(std::min_element(places.begin(), places.end()) - places.begin());
  return places[first] >= 0 &&
         stars.has_triangle_of_indices(
             i, {places[first], places[(first + 1) % 3], places[(first + 2) % 3]});
}

// Returns flags of the nodes whose kept stars are wrong. A kept star is wrong if it has a
// tetrahedron that a star found in the last round lacks, or the other way round.
std::vector<char> contradicted(const VolumeStarInput& input, const VolumeStars& stars,
                               const std::vector<char>& kept, const std::vector<char>& found) {
  std::vector<char> wrong(kept.size(), 0);
  // `others` are flags of the nodes with whose stars that of node i is compared.
  const auto compare = [&](std::int64_t i, const std::vector<char>& others) {
    bool beside = false;
    stars.for_neighbours(i, [&](std::int64_t j) { beside = beside || others[index(j)]; });
    if (!beside) return;
    const auto node = static_cast<std::int32_t>(i);
    const auto look_at = [&](std::int32_t j, const VolumeStars::Corners& corners) {
      if (others[index(j)] && !has_tetrahedron(stars, j, corners))
        set(wrong, kept[index(i)] ? i : j);
    };
    stars.for_simplices(i, [&](const VolumeStars::Corners& c) {
      look_at(c[0], {node, c[2], c[1]});
      look_at(c[1], {node, c[0], c[2]});
      look_at(c[2], {node, c[1], c[0]});
    });
  };
  for_chunks("pnpbs::PreviousStars::compare", input.nodes.count,
             [&](std::int64_t i, std::int64_t end) {
               for (; i < end; ++i)
                 if (kept[index(i)] || found[index(i)]) compare(i, kept[index(i)] ? found : kept);
             });
  return wrong;
}

bool any_set(const std::vector<char>& flags) {
  return std::find(flags.begin(), flags.end(), 1) != flags.end();
}

}  // namespace

void PreviousStars::take(const Nodes<3>& nodes, VolumeStars& stars, std::uint64_t digest) {
  if (!stars.are_of(nodes)) return;
  ids_.assign(nodes.id.data(), nodes.id.data() + nodes.count);
  owned_.assign(nodes.owned.data(), nodes.owned.data() + nodes.count);
  digest_ = digest;
  stars_ = std::exchange(stars, VolumeStars());
  std::vector<char> ghosts(owned_.size());
  std::ranges::transform(owned_, ghosts.begin(), [](char owned) { return owned == 0; });
  if (any_set(ghosts)) stars_.remove(ghosts);
}

void PreviousStars::forget() { *this = PreviousStars(); }

template <class Counts>
PreviousStars::Places PreviousStars::find_places(const Nodes<3>& nodes,
                                                 const Counts& counts) const {
  const IndexById by_id(nodes, counts);
  Places places{std::vector<std::int32_t>(ids_.size()),
                std::vector<std::int32_t>(index(nodes.count), -1)};
  for (std::size_t k = 0; k < ids_.size(); ++k) {
    const std::int32_t now = by_id.of(ids_[k]);
    places.now[k] = now;
    if (now >= 0 && owned_[k]) places.before[index(now)] = static_cast<std::int32_t>(k);
  }
  return places;
}

// Puts back the stars of the nodes i for which keeps(i, previous index) holds, if all nodes of the
// star still exist. Returns flags of these nodes.
template <class Keeps>
std::vector<char> PreviousStars::put_in_place(const Places& places, const Keeps& keeps,
                                              VolumeStars& stars) {
  std::vector<char> kept(places.before.size(), 0);
  Uses uses(std::ssize(ids_));
  for (std::size_t i = 0; i < kept.size(); ++i) {
    const std::int32_t k = places.before[i];
    if (k < 0 || !keeps(static_cast<std::int64_t>(i), k)) continue;
    bool all = true;
    stars_.for_neighbours(k, [&](std::int64_t j) { all = all && places.now[index(j)] >= 0; });
    kept[i] = all;
    if (all) uses.add(k);
  }
  stars.replace(kept, [&](std::int64_t i, std::vector<std::int32_t>& out) {
    const std::int32_t k = places.before[index(i)];
    VolumeStars::renumber(
        stars_.row(k), [&](std::int32_t j) { return places.now[index(j)]; }, out);
    if (uses.was_last(k)) stars_.drop_chunk(k / VolumeStars::kChunk);
  });
  forget();
  return kept;
}

std::vector<char> PreviousStars::restore(const VolumeStarInput& input, VolumeStars& stars) {
  const Nodes<3>& nodes = input.nodes;
  return put_in_place(
      find_places(nodes, [](std::int64_t) { return true; }),
      [&](std::int64_t i, std::int32_t before) {
        return nodes.owned(i) != 0 && stars_.found(before) && stars_.needs(before) == 0;
      },
      stars);
}

void PreviousStars::find_stars(const VolumeStarInput& input, std::vector<char> wanted,
                               VolumeStars& stars) {
  const Nodes<3>& nodes = input.nodes;
  std::vector<char> kept = put_in_place(
      find_places(nodes, [&](std::int64_t i) { return nodes.owned(i) != 0; }),
      [&](std::int64_t i, std::int32_t before) {
        return wanted[index(i)] && stars_.closed(before);
      },
      stars);
  const auto give_up = [&](const std::vector<char>& some) {
    for (std::size_t i = 0; i < kept.size(); ++i) kept[i] = kept[i] && !some[i];
  };
  give_up(doubted(input, stars, kept));
  for (std::size_t i = 0; i < kept.size(); ++i) wanted[i] = wanted[i] && !kept[i];
  stars.add(input, wanted);
  // Compare with all other stars, including those found earlier. A star that cannot be found yet is
  // empty, so the kept stars that contain its node are found again.
  std::vector<char> found(kept.size());
  for (std::size_t i = 0; i < kept.size(); ++i) {
    found[i] = nodes.owned(static_cast<std::int64_t>(i)) && !kept[i];
  }
  while (any_set(found)) {
    wanted = contradicted(input, stars, kept, found);
    give_up(wanted);
    stars.add(input, wanted);
    found.swap(wanted);
  }
}

}  // namespace pnpbs
