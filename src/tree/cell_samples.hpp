// SPDX-License-Identifier: BSD-3-Clause
// Places in a cell of the background tree.
#pragma once

#include "base/types.hpp"

namespace pnpbs {

// Where d is sampled in a cell, in units of its side: in its middle, and in those of the cells it
// may be split into.
template <int Dim>
constexpr std::array<Point<Dim>, 1 + (1 << Dim)> cell_samples() {
  std::array<Point<Dim>, 1 + (1 << Dim)> samples{};
  for (std::size_t k = 0; k < Dim; ++k) {
    samples[0][k] = 0.5;
    for (std::size_t child = 0; child < samples.size() - 1; ++child)
      samples[child + 1][k] = (child >> k) & 1 ? 0.75 : 0.25;
  }
  return samples;
}

template <int Dim>
Point<Dim> point_in(const Box<Dim>& box, const Point<Dim>& fraction) {
  Point<Dim> x;
  for (std::size_t k = 0; k < Dim; ++k)
    x[k] = box.low[k] + fraction[k] * (box.high[k] - box.low[k]);
  return x;
}

template <int Dim>
Point<Dim> middle_of(const Box<Dim>& box) {
  return point_in<Dim>(box, cell_samples<Dim>()[0]);
}

}  // namespace pnpbs
