// SPDX-License-Identifier: BSD-3-Clause
// A few dozen nodes and their triangles, to try on what a repair would bring: a node comes or goes,
// those around relax, and flips of edges keep the triangles Delaunay (C. Lawson, Mathematical
// Software III, 1977, 161-194). Nodes are known by their places in it.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "base/types.hpp"

namespace pnpbs {

// How good its triangles are, by 2 r_in / R.
struct MeshQuality {
  double loss;  // what they lack of 1: the sum of the squares
  double min;
};

class LocalMesh {
 public:
  using Corners = std::array<std::int32_t, 3>;

  void clear();
  void add_node(const Point<2>& x, bool moves);
  void add_triangle(const Corners& corners);  // counter-clockwise
  // Once all are there.
  void link_triangles();

  const Point<2>& position(std::int32_t place) const { return x_[static_cast<std::size_t>(place)]; }
  std::vector<Corners> triangles() const;

  // How far the nearest node is from a point.
  double gap_at(const Point<2>& x) const;

  // The largest triangle with this corner.
  std::int32_t largest_triangle_at(std::int32_t place) const;
  // The larger of the two with this edge.
  std::int32_t largest_triangle_at(std::int32_t place, std::int32_t other) const;

  // A new node in the middle of a triangle. Returns its place.
  std::int32_t insert(std::int32_t triangle);
  // False if the hole cannot be filled with triangles.
  bool remove(std::int32_t place);

  // The nodes that move go to the mean of their neighbours, step by step.
  void relax();

  MeshQuality quality() const;

 private:
  struct Triangle {
    Corners corner;
    Corners across;  // the triangles at the edges opposite to the corners, -1: none

    bool has(std::int32_t place) const;
    int side_towards(std::int32_t triangle) const;
  };

  double twice_area(const Triangle& t) const;
  double quality_of(const Corners& corner) const;
  bool in_ear(const Corners& ear, std::int32_t place) const;
  std::vector<std::int32_t> ring_around(std::int32_t place) const;
  bool fill(std::vector<std::int32_t> ring);
  void make_delaunay();
  bool flip(std::int32_t triangle, int side);
  void collect_edges();
  void step_to_means();

  std::vector<Point<2>> x_;
  std::vector<char> moves_;
  std::vector<Triangle> triangles_;
  std::vector<std::array<std::int32_t, 2>> edges_;
  std::vector<Point<2>> sum_;
  std::vector<double> neighbours_;
};

}  // namespace pnpbs
