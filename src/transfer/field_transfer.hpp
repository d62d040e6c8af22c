// SPDX-License-Identifier: BSD-3-Clause
// Values at the nodes there were, for the nodes there will be: the field that is linear on each of
// the old elements, or of second order there, told at any points. The elements stay with the ranks
// that owned them.
#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "results/nodal_results.hpp"

namespace pnpbs {

enum class TransferOrder { first, second };

class FieldTransfer {
 public:
  virtual ~FieldTransfer() = default;
  virtual int dimension() const = 0;
  std::int64_t components() const { return components_; }
  // Of a transfer of second order: nodes, on all ranks, about which it is linear. Otherwise -1.
  virtual std::int64_t nodes_of_first_order() const = 0;

  // x: [n][coordinates of a node, as it is handed out], on a sphere of points of it; values:
  // [n][components]. Collective; each rank asks what it wants.
  virtual void evaluate(std::int64_t n, const double* x, double* values) const = 0;
  // At this rank's nodes, in places. With `conserve` the field that is linear on the placement's
  // elements has the integral that the old one had on the old elements: every value is changed by
  // the same number. On a sphere an integral is the sum, over the triangles, of the area along the
  // sphere times the mean of the corners' values. Collective.
  virtual void evaluate_at_nodes(NodalResults& results, bool conserve, double* values) const = 0;

 protected:
  std::int64_t components_ = 0;
};

// values: [nodes of this rank][components]. Collective.
std::unique_ptr<FieldTransfer> make_field_transfer(NodalResults& results, TransferOrder order,
                                                   std::int64_t components, const double* values);

}  // namespace pnpbs
