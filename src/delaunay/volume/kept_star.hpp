// SPDX-License-Identifier: BSD-3-Clause
// Is the star of a node that was right before nodes moved right still? See stars_before.hpp.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "base/types.hpp"
#include "delaunay/volume/volume_stars.hpp"

namespace pnpbs {

class KeptStar {
 public:
  KeptStar(const VolumeStarInput& input, const VolumeStars& stars) : in_(input), stars_(stars) {}

  // Calls fails(j) for the nodes whose stars may be others by now, as far as tetrahedra and faces
  // show it of which node i is the first of all corners.
  template <class Fails>
  void check(std::int64_t i, const Fails& fails) {
    if (!gather(i)) return fails(static_cast<std::int32_t>(i));
    for (const Corners& triangle : triangles_) {
      const Sphere sphere = sphere_of(triangle);
      if (is_first(i, triangle) && !is_tetrahedron(i, triangle, sphere))
        fail_at(i, triangle, fails);
      for (std::size_t k = 0; k < 3; ++k) {
        const std::int32_t p = triangle[k], q = triangle[(k + 1) % 3];
        if (node(p) < i || node(q) < node(p)) continue;  // one of the two tetrahedra at the face
        const std::int32_t apex = beyond(p, q);
        if (apex >= 0 && surely_outside(sphere, apex)) continue;
        fail_at(i, triangle, fails);
        if (apex >= 0) fails(node(apex));
      }
    }
  }

 private:
  using Corners = VolumeStars::Corners;  // places among the neighbours
  // Of the points y around the node, those with volume * y * y < normal * y are inside.
  struct Sphere {
    Point<3> normal;
    double volume;
  };

  // More are rare, and such stars are found anew.
  static constexpr std::int32_t kMaxNeighbours = 64;

  static std::size_t index(std::int32_t k) { return static_cast<std::size_t>(k); }
  std::int32_t node(std::int32_t place) const { return nodes_[index(place)]; }
  // The third corner of the triangle on the other side of the edge from p to q.
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
  std::vector<Point<3>> to_;  // from node i
  std::vector<double> squares_;
  std::vector<Corners> triangles_;
  std::array<std::int8_t, kMaxNeighbours * kMaxNeighbours> third_;
  double volume_error_ = 0, sphere_error_ = 0;
};

}  // namespace pnpbs
