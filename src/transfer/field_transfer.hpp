// SPDX-License-Identifier: BSD-3-Clause
// Transfers values from the nodes of a level to any points, such as those of another level. The
// field is linear on each of the old elements, or of second order there. The elements remain on the
// ranks that owned them.
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
  // Returns the number of nodes on all ranks around which a transfer of second order is only
  // linear, or -1 for a transfer of first order.
  virtual std::int64_t nodes_of_first_order() const = 0;

  // Evaluates the field at n points, which each rank chooses independently.
  // `x` is [n][coordinates of the user], on a sphere points of the sphere. `values` is
  // [n][components]. Collective.
  virtual void evaluate(std::int64_t n, const double* x, double* values) const = 0;
  // Evaluates the field at the nodes of this rank in the order of the results.
  // If `conserve` is set, a constant is added to each component so that the integral on the new
  // elements equals that on the old ones. On a sphere, an integral is the sum over the triangles of
  // their area on the sphere times the mean of the corners' values. Collective.
  virtual void evaluate_at_nodes(NodalResults& results, bool conserve, double* values) const = 0;

 protected:
  std::int64_t components_ = 0;
};

// Creates a transfer of the values at the nodes of this rank, [nodes][components]. Collective.
std::unique_ptr<FieldTransfer> make_field_transfer(NodalResults& results, TransferOrder order,
                                                   std::int64_t components, const double* values);

}  // namespace pnpbs
