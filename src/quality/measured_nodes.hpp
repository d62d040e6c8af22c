// SPDX-License-Identifier: BSD-3-Clause
// Nodes as they are measured: those in a chart of a sphere along the sphere, where it is without
// the stretch of the chart.
#pragma once

#include "base/nodes.hpp"
#include "sphere/embedding.hpp"

namespace pnpbs {

template <int Dim>
struct MeasuredNodes {
  const Nodes<Dim>& nodes;
  Embedding<Dim> embedding{};

  double d(std::int64_t i) const {
    return embedding.measured_length(nodes.position(i), nodes.d(i));
  }

  double distance_between(std::int64_t i, std::int64_t j) const {
    return distance_to(i, nodes.position(j));
  }
  double distance_to(std::int64_t i, const Point<Dim>& x) const {
    return embedding.distance(nodes.position(i), x);
  }

  // As a corner of an element: in space those of the plane's nodes, which are in a chart.
  void put(std::int64_t i, Point<Dim>& corner) const { corner = nodes.position(i); }
  void put(std::int64_t i, Point<3>& corner) const requires(Dim == 2) {
    corner = embedding.in_space(nodes.position(i));
  }
};

}  // namespace pnpbs
