// SPDX-License-Identifier: BSD-3-Clause
// Polynomials of second order at nodes on a sphere. Each is fitted in one of two charts with
// opposite projection centres, that whose centre is farther from the node. Therefore the stretch is
// at most 2, and distances around a node are nearly those on the sphere.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "sphere/stereographic_chart.hpp"
#include "transfer/quadratic_fits.hpp"

namespace pnpbs {

// Polynomials with the interface of QuadraticFits.
class SphereFits {
 public:
  // Fits the polynomials. `nodes` on the sphere and `values` [nodes][components] have the order of
  // the results and include ghosts. Collective.
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
  std::vector<char> chart_at_;  // Index of the chart of each node.
  std::int64_t nodes_without_ = 0;
};

}  // namespace pnpbs
