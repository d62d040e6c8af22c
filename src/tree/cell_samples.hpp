// SPDX-License-Identifier: BSD-3-Clause
// The points at which d is sampled in a cell of the background tree.
#pragma once

#include "base/types.hpp"

namespace pnpbs {

// Returns the sample points of a cell in units of its side: its centre and the centres of its
// children.
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

// Returns the point at the given fractions of the sides of a box.
template <int Dim>
Point<Dim> point_in(const Box<Dim>& box, const Point<Dim>& fraction) {
  Point<Dim> x;
  for (std::size_t k = 0; k < Dim; ++k)
    x[k] = box.low[k] + fraction[k] * (box.high[k] - box.low[k]);
  return x;
}

// Returns the centre of a box.
template <int Dim>
Point<Dim> middle_of(const Box<Dim>& box) {
  return point_in<Dim>(box, cell_samples<Dim>()[0]);
}

// Returns true if the number of a cell's samples inside the domain suffices to sample d in the
// cell. In space, a side of the domain that lies in cell faces, or a thin wall, leaves large cells
// with few or no samples inside. In the plane, boundary nodes are dense enough.
template <int Dim>
constexpr bool samples_suffice(std::size_t inside) {
  return Dim == 2 || inside >= 4;
}

// Appends the points that replace those samples of a cell that are outside the domain: the boundary
// points nearest to them, if they lie in the cell. If there is none, and no sample is inside the
// domain either, appends the boundary point nearest to the centre of the cell.
template <int Dim, class Inside, class Nearest>
void add_samples_of_boundary(const Box<Dim>& box, const Inside& inside, const Nearest& nearest,
                             std::vector<Point<Dim>>& points) {
  bool any = false;
  for (const Point<Dim>& fraction : cell_samples<Dim>()) {
    const Point<Dim> x = point_in<Dim>(box, fraction);
    const bool known = inside(x);
    const Point<Dim> y = known ? x : nearest(x);
    if (!known && in_closed_box(box, y)) points.push_back(y);
    any = any || known || in_closed_box(box, y);
  }
  if (!any) points.push_back(nearest(middle_of<Dim>(box)));
}

}  // namespace pnpbs
