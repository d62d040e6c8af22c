// SPDX-License-Identifier: BSD-3-Clause
// A mesh of a few dozen nodes on which the effect of a repair is tried. A node is inserted or
// removed, the surrounding nodes relax, and edge flips keep the triangles Delaunay (C. Lawson,
// Mathematical Software III, 1977, 161-194). Nodes and triangles are identified by their indices in
// this mesh.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "base/types.hpp"

namespace pnpbs {

// Quality of the triangles of a mesh, by q = 2 r_in / R.
struct MeshQuality {
  double loss;  // sum of (1 - q)^2
  double min;
};

// A small triangulation that can be changed and relaxed.
class LocalMesh {
 public:
  using Corners = std::array<std::int32_t, 3>;

  void clear();
  void add_node(const Point<2>& x, bool moves);
  void add_triangle(const Corners& corners);  // `corners` must be counter-clockwise
  // Connects adjacent triangles. The caller must call this after adding the last triangle.
  void link_triangles();

  const Point<2>& position(std::int32_t place) const { return x_[static_cast<std::size_t>(place)]; }
  std::vector<Corners> triangles() const;

  // Returns the distance from x to the nearest node.
  double gap_at(const Point<2>& x) const;

  // Returns the largest triangle with this corner, or -1.
  std::int32_t largest_triangle_at(std::int32_t place) const;
  // Returns the larger of the triangles with this edge, or -1.
  std::int32_t largest_triangle_at(std::int32_t place, std::int32_t other) const;

  // Inserts a node at the centroid of a triangle and returns the node's index.
  std::int32_t insert(std::int32_t triangle);
  // Removes a node and triangulates the hole. Returns false, with an unusable mesh, if the hole
  // cannot be triangulated.
  bool remove(std::int32_t place);

  // Moves the nodes step by step towards the mean of their neighbours, with edge flips in between.
  void relax();

  MeshQuality quality() const;

 private:
  // A triangle with its neighbours.
  struct Triangle {
    Corners corner;
    Corners across;  // the adjacent triangles, opposite to each corner; -1: none

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
