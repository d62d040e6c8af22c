// SPDX-License-Identifier: BSD-3-Clause
// The lattices that fill space. If one lattice fills the whole domain, it is A15, with eight nodes
// per cubic cell that have 12 or 14 neighbours, because its tetrahedra are better. Where patches of
// different d meet, the body-centred cubic lattice relaxes better.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <span>

#include "base/lattice.hpp"
#include "base/periodic_cell.hpp"
#include "base/types.hpp"
#include "method/constants.hpp"

namespace pnpbs {

// An A15 or body-centred cubic lattice whose first layer lies near the low sides of a box.
class CubicLattice {
 public:
  // Chooses A15 if one lattice fills the `whole` domain. It is then stretched slightly, if
  // `stretched`, to end alike at all sides of `bounds`, or to continue across those of a periodic
  // cell.
  CubicLattice(double d, const Box<3>& bounds, bool whole, bool stretched = true,
               const PeriodicCell<3>& cell = {})
      : sites_(whole ? std::span<const Point<3>>(kA15) : kBodyCentred), low_(bounds.low) {
    const double first = d * (whole ? method::kFirstA15Layer : method::kFirstBodyCentredLayer);
    for (std::size_t k = 0; k < 3; ++k) {
      low_[k] += first;
      const double between = bounds.high[k] - bounds.low[k] - 2 * first;
      const double side = d * (whole ? std::cbrt(8 / method::kA15Density) : Lattice<3>::kCell);
      if (whole && cell.periodic(static_cast<int>(k)))
        cell_[k] = cell.period(static_cast<int>(k)) /
                   std::max(1.0, std::round(cell.period(static_cast<int>(k)) / side));
      else
        cell_[k] = whole && stretched ? fitted(side, between) : side;
    }
  }

  // Returns the number of nodes per unit of volume.
  double density() const {
    return static_cast<double>(sites_.size()) / (cell_[0] * cell_[1] * cell_[2]);
  }

  // Calls visit(x) for all nodes in the box and for some beside it.
  template <class Visit>
  void for_nodes(const Box<3>& box, const Visit& visit) const {
    for (const Point<3>& site : sites_) {
      std::array<std::int64_t, 3> first, end;
      for (std::size_t k = 0; k < 3; ++k) {
        first[k] = static_cast<std::int64_t>(std::ceil(cells(k, box.low[k]) - site[k] - kRoom));
        end[k] = static_cast<std::int64_t>(std::ceil(cells(k, box.high[k]) - site[k] + kRoom));
      }
      for (std::int64_t i2 = first[2]; i2 < end[2]; ++i2)
        for (std::int64_t i1 = first[1]; i1 < end[1]; ++i1)
          for (std::int64_t i0 = first[0]; i0 < end[0]; ++i0)
            visit(Point<3>{along(0, i0, site), along(1, i1, site), along(2, i2, site)});
    }
  }

 private:
  // Nodes of a cell, in units of its sides. Along each axis, A15 has layers of three nodes half a
  // cell apart, and a single node halfway between two layers.
  static constexpr std::array<Point<3>, 2> kBodyCentred{{{0, 0, 0}, {0.5, 0.5, 0.5}}};
  static constexpr std::array<Point<3>, 8> kA15{{{0, 0, 0},
                                                 {0.5, 0.5, 0.5},
                                                 {0.25, 0, 0.5},
                                                 {0.75, 0, 0.5},
                                                 {0.5, 0.25, 0},
                                                 {0.5, 0.75, 0},
                                                 {0, 0.5, 0.25},
                                                 {0, 0.5, 0.75}}};
  static constexpr double kRoom = 1e-3;  // margin for rounding [cells]

  static double fitted(double cell, double between) {
    const double half_cells = std::round(between / (0.5 * cell));
    return half_cells >= 8 ? 2 * between / half_cells : cell;
  }

  double cells(std::size_t k, double x) const { return (x - low_[k]) / cell_[k]; }
  double along(std::size_t k, std::int64_t i, const Point<3>& site) const {
    return low_[k] + cell_[k] * (static_cast<double>(i) + site[k]);
  }

  std::span<const Point<3>> sites_;
  Point<3> low_;   // low corner of the cell with index 0
  Point<3> cell_;  // sides of a cell
};

}  // namespace pnpbs
