// SPDX-License-Identifier: BSD-3-Clause
// A polynomial of second order at each node, through its value, fitted by least squares to those of
// its neighbours and of their neighbours: in the stars, so across no boundary. A node counts as
// often as it is met.
//
// No rank needs more than the stars of its own nodes: each node sums up monomials around itself
// over its neighbours, which are exchanged as values of ghosts are, and shifted to the nodes next
// to it. Sums are in the order of ids, so it does not matter who makes them.
#pragma once

#include <cstdint>
#include <vector>

#include "results/results.hpp"
#include "spacing/nodal_patch.hpp"

namespace pnpbs {

template <int Dim>
class QuadraticFits {
 public:
  // nodes: at all places; values: [places][components]. Collective.
  QuadraticFits(Results<Dim>& results, std::vector<PatchNode<Dim>> nodes, std::int64_t components,
                const std::vector<double>& values);

  // Is there one? Not where the neighbours are too few, or lie on a curve of second order, as those
  // of nodes that are on surfaces alone may.
  bool has(std::int32_t place) const { return fit(place)[0] != 0; }
  // What is to be added to the node's own value at x.
  double rise(std::int32_t place, std::int64_t component, const Point<Dim>& x) const;
  // On all ranks.
  std::int64_t nodes_without() const { return nodes_without_; }

 private:
  Point<Dim> way_from(std::int32_t place, const Point<Dim>& x) const;
  const double* fit(std::int32_t place) const {
    return fits_.data() + static_cast<std::int64_t>(place) * columns_;
  }

  std::vector<PatchNode<Dim>> nodes_;
  std::int64_t columns_ = 0;  // 1 if there is one, then coefficients by component
  std::vector<double> fits_;  // [places][columns]
  std::int64_t nodes_without_ = 0;
};

extern template class QuadraticFits<2>;
extern template class QuadraticFits<3>;

}  // namespace pnpbs
