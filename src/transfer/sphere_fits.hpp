// SPDX-License-Identifier: BSD-3-Clause
// Polynomials of second order at the nodes on a sphere: in the chart from the one or the other of
// two opposite points, whichever is the farther from the node. So in the chart it is made in, the
// stretch is 2 at most, and nodes about a node are as far from it as they are on the sphere.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "sphere/stereographic_chart.hpp"
#include "transfer/quadratic_fits.hpp"

namespace pnpbs {

// The interface of QuadraticFits.
class SphereFits {
 public:
  // nodes: at all places, on the sphere; values: [places][components]. Collective.
  SphereFits(Results<2>& results, const std::vector<PatchNode<3>>& nodes, std::int64_t components,
             const std::vector<double>& values);

  bool has(std::int32_t place) const { return at(place).fits.has(place); }
  double rise(std::int32_t place, std::int64_t component, const Point<3>& x) const;
  std::int64_t nodes_without() const { return nodes_without_; }

 private:
  struct InChart {
    StereographicChart chart;
    QuadraticFits<2> fits;

    InChart(const StereographicChart& chart, Results<2>& results,
            const std::vector<PatchNode<3>>& nodes, std::int64_t components,
            const std::vector<double>& values);
  };

  const InChart& at(std::int32_t place) const {
    return charts_[static_cast<std::size_t>(chart_at_[static_cast<std::size_t>(place)])];
  }

  std::array<InChart, 2> charts_;
  std::vector<char> chart_at_;  // of each place
  std::int64_t nodes_without_ = 0;
};

}  // namespace pnpbs
