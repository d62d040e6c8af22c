// SPDX-License-Identifier: BSD-3-Clause
// A polynomial of second order at each node through its value. It is fitted by least squares to the
// values of its neighbours in the stars and of their neighbours, so that it does not cross a
// boundary. A node that is reached several times has a corresponding weight.
//
// A rank needs only the stars of its own nodes. Each node sums up monomials around itself over its
// neighbours. The sums are exchanged like ghost values and shifted to adjacent nodes. They run in
// the order of ids, so that they do not depend on the partition.
#pragma once

#include <cstdint>
#include <vector>

#include "results/results.hpp"
#include "spacing/nodal_patch.hpp"

namespace pnpbs {

template <int Dim>
class QuadraticFits {
 public:
  // Fits the polynomials. `nodes` and `values` [nodes][components] have the order of the results
  // and include ghosts. Collective.
  QuadraticFits(Results<Dim>& results, std::vector<PatchNode<Dim>> nodes, std::int64_t components,
                const std::vector<double>& values);

  // Returns whether the node has a polynomial. It has none if its neighbours are too few or lie on
  // a curve of second order, which can be the case for nodes on surfaces alone.
  bool has(std::int32_t place) const { return fit(place)[0] != 0; }
  // Returns the difference between the polynomial at x and the value of the node.
  double rise(std::int32_t place, std::int64_t component, const Point<Dim>& x) const;
  // Returns the number of nodes on all ranks without a polynomial.
  std::int64_t nodes_without() const { return nodes_without_; }

 private:
  Point<Dim> way_from(std::int32_t place, const Point<Dim>& x) const;
  const double* fit(std::int32_t place) const {
    return fits_.data() + static_cast<std::int64_t>(place) * columns_;
  }

  std::vector<PatchNode<Dim>> nodes_;
  // A flag that is 1 if there is a polynomial, then coefficients by component.
  std::int64_t columns_ = 0;
  std::vector<double> fits_;  // [nodes][columns]
  std::int64_t nodes_without_ = 0;
};

extern template class QuadraticFits<2>;
extern template class QuadraticFits<3>;

}  // namespace pnpbs
