// SPDX-License-Identifier: BSD-3-Clause
// The tetrahedra of the stars in space.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <map>
#include <set>
#include <vector>

#include "bubbles.hpp"
#include "delaunay/volume/volume_stars.hpp"
#include "predicates/space.hpp"
#include "quick_assert.hpp"

namespace volume_tetrahedra {

using Ids = std::array<std::int64_t, 4>;

inline pnpbs::VolumeStarInput input_of(const Bubbles<3>& b, const pnpbs::KnownRegion<3>& known) {
  return {b.nodes, b.tree, b.buckets, b.lists, known};
}

// A node's star by ids, in the order in which it is visited.
struct Star {
  std::vector<std::int64_t> neighbours;
  std::vector<Ids> tetrahedra;
  bool closed;

  bool operator==(const Star&) const = default;
};

inline Star star_by_ids(const pnpbs::Nodes<3>& nodes, const pnpbs::VolumeStars& stars,
                        std::int64_t i) {
  Star star{{}, {}, stars.closed(i)};
  stars.for_neighbours(i, [&](std::int64_t j) { star.neighbours.push_back(nodes.id(j)); });
  stars.for_simplices(i, [&](const pnpbs::VolumeStars::Corners& t) {
    star.tetrahedra.push_back({nodes.id(i), nodes.id(t[0]), nodes.id(t[1]), nodes.id(t[2])});
  });
  return star;
}

// Returns all tetrahedra, each as often as it is in stars (or in updated stars).
template <class Stars>
std::multiset<Ids> in_stars(const pnpbs::Nodes<3>& nodes, const Stars& stars) {
  std::multiset<Ids> all;
  for (std::int64_t i = 0; i < nodes.count; ++i)
    stars.for_simplices(i, [&](const pnpbs::VolumeStars::Corners& t) {
      Ids ids{nodes.id(i), nodes.id(t[0]), nodes.id(t[1]), nodes.id(t[2])};
      std::sort(ids.begin(), ids.end());
      all.insert(ids);
    });
  return all;
}

using Places = std::map<std::int64_t, Point<3>>;

inline Places places_by_id(const pnpbs::Nodes<3>& nodes) {
  Places all;
  for (std::int64_t i = 0; i < nodes.count; ++i) all[nodes.id(i)] = nodes.position(i);
  return all;
}

// Returns six times the volume of the tetrahedron of node i and three others.
inline double six_volumes(const pnpbs::Nodes<3>& nodes, std::int64_t i,
                          const pnpbs::VolumeStars::Corners& t) {
  const Point<3> o = nodes.position(i);
  double u[3][3];
  for (std::size_t c = 0; c < 3; ++c)
    for (std::size_t k = 0; k < 3; ++k) u[c][k] = nodes.position(t[c])[k] - o[k];
  return u[0][0] * (u[1][1] * u[2][2] - u[1][2] * u[2][1]) -
         u[0][1] * (u[1][0] * u[2][2] - u[1][2] * u[2][0]) +
         u[0][2] * (u[1][0] * u[2][1] - u[1][1] * u[2][0]);
}

struct Mesh {
  std::set<Ids> tetrahedra;                          // by id
  std::map<std::array<std::int64_t, 3>, int> faces;  // with the number of their tetrahedra
  double volume = 0;
};

// Returns the mesh, and checks its invariants: the stars of all corners agree, tetrahedra have
// positive orientation, a face has at most two, and neighbours are corners.
inline Mesh mesh_of(const pnpbs::Nodes<3>& nodes, const pnpbs::VolumeStars& stars) {
  std::map<Ids, int> found;
  Mesh mesh;
  for (std::int64_t i = 0; i < nodes.count; ++i) {
    std::set<std::int64_t> corners, neighbours;
    std::int64_t last = -1;
    stars.for_neighbours(i, [&](std::int64_t j) {
      quick_assert(nodes.id(j) > last);
      last = nodes.id(j);
      neighbours.insert(j);
    });
    stars.for_simplices(i, [&](const pnpbs::VolumeStars::Corners& t) {
      quick_assert(pnpbs::orientation(nodes.position(i), nodes.position(t[0]), nodes.position(t[1]),
                                      nodes.position(t[2])) > 0);
      Ids ids{nodes.id(i), nodes.id(t[0]), nodes.id(t[1]), nodes.id(t[2])};
      std::sort(ids.begin(), ids.end());
      if (++found[ids] == 1) mesh.volume += six_volumes(nodes, i, t) / 6;
      corners.insert(t.begin(), t.end());
    });
    quick_assert(corners == neighbours);
    quick_assert(std::ssize(neighbours) == stars.size(i));
  }
  for (const auto& [ids, count] : found) {
    quick_assert_msg(count == 4, "a tetrahedron is in %d stars", count);
    mesh.tetrahedra.insert(ids);
    for (std::size_t k = 0; k < 4; ++k) {
      const int faces =
          ++mesh.faces[{ids[k == 0 ? 1 : 0], ids[k <= 1 ? 2 : 1], ids[k <= 2 ? 3 : 2]}];
      quick_assert(faces <= 2);
    }
  }
  return mesh;
}

}  // namespace volume_tetrahedra
