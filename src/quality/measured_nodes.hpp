// SPDX-License-Identifier: BSD-3-Clause
// Nodes with lengths measured as users see them. On a sphere, positions are in a chart; here
// spacings and distances are those along the sphere, without the stretch of the chart.
#pragma once

#include "base/nodes.hpp"
#include "sphere/embedding.hpp"

namespace pnpbs {

// A view of nodes and their embedding. `nodes` must outlive this object.
template <int Dim>
struct MeasuredNodes {
  const Nodes<Dim>& nodes;
  Embedding<Dim> embedding{};

  // Returns the spacing at node i.
  double d(std::int64_t i) const {
    return embedding.measured_length(nodes.position(i), nodes.d(i));
  }

  double distance_between(std::int64_t i, std::int64_t j) const {
    return distance_to(i, nodes.position(j));
  }
  double distance_to(std::int64_t i, const Point<Dim>& x) const {
    return embedding.distance(nodes.position(i), x);
  }

  // Stores node i as a corner of an element: in its own coordinates, or in space for nodes in a
  // chart of a sphere.
  void put(std::int64_t i, Point<Dim>& corner) const { corner = nodes.position(i); }
  void put(std::int64_t i, Point<3>& corner) const requires(Dim == 2) {
    corner = embedding.in_space(nodes.position(i));
  }
};

}  // namespace pnpbs
