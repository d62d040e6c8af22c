// SPDX-License-Identifier: BSD-3-Clause
// The smallest and the largest d of the nodes of all ranks, and bands of d between them.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>

#include "base/nodes.hpp"
#include "comm/communicator.hpp"

namespace pnpbs {

// A range of d. It is empty if there are no nodes.
struct SpacingRange {
  double min, max;
  bool empty() const { return min > max; }
};

// Returns the range of d(i) over the owned nodes i of all ranks. Collective.
template <int Dim, class Spacing>
SpacingRange spacing_range(const Communicator& comm, const Nodes<Dim>& nodes, const Spacing& d) {
  const auto max = [&](double sign) {
    return comm.allreduce_max(
        max_of("pnpbs::spacing_range", nodes.count, -kFarAway,
               [&](std::int64_t i) { return nodes.owned(i) ? sign * d(i) : -kFarAway; }));
  };
  const double min = -max(-1);
  return {min, max(1)};
}

template <int Dim>
SpacingRange spacing_range(const Communicator& comm, const Nodes<Dim>& nodes) {
  return spacing_range<Dim>(comm, nodes, [&](std::int64_t i) { return nodes.d(i); });
}

// Bands of d in which statistics are reported. They have equal widths in log d between the smallest
// and the largest d. There is one band if d is nearly constant.
class SpacingBands {
 public:
  static constexpr int kMaxBands = 8;
  // Ratio of the largest to the smallest d below which there is one band. Statistics of more bands
  // would show noise only.
  static constexpr double kNearlyConstant = 1.1;

  SpacingBands(double min, double max) : count_(max > kNearlyConstant * min ? kMaxBands : 1) {
    for (int band = 0; band <= count_; ++band)
      limits_[static_cast<std::size_t>(band)] = min * std::pow(max / min, 1.0 * band / count_);
    limits_[static_cast<std::size_t>(count_)] = max;
  }

  int count() const { return count_; }
  double from(int band) const { return limits_[static_cast<std::size_t>(band)]; }
  double to(int band) const { return limits_[static_cast<std::size_t>(band) + 1]; }

  // Returns the band of d. Comparisons are faster than a logarithm.
  int band_of(double d) const {
    int band = 0;
    for (int k = 1; k < count_; ++k) band += d >= limits_[static_cast<std::size_t>(k)];
    return band;
  }

 private:
  int count_;
  std::array<double, kMaxBands + 1> limits_{};
};

}  // namespace pnpbs
