// SPDX-License-Identifier: BSD-3-Clause
// Update of the values at ghosts from those of their owners. The values to send are copied when the
// update begins, and received values are written when it ends. Buffers are kept from one update to
// the next.
#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "comm/communicator.hpp"
#include "comm/exchange_pattern.hpp"

namespace pnpbs {

// A halo exchange of node values, performed by pack(), start(), wait() and unpack() in this order.
class GhostUpdate {
 public:
  bool under_way() const { return under_way_; }
  // Returns true if the current or last update follows this pattern.
  bool follows(const std::shared_ptr<const ExchangePattern>& pattern) const {
    return pattern_ == pattern;
  }
  std::int64_t components() const { return components_; }

  // Copies the values of the owned nodes. `values` has the shape [nodes and ghosts][components].
  // Local.
  void pack(const Communicator& comm, const std::shared_ptr<const ExchangePattern>& pattern,
            std::int64_t components, const double* values);
  // Sends the packed values. All ranks must call it, after they have agreed that all of them have
  // packed.
  void start();
  // Waits for the values of this rank's ghosts. Local. Throws Error(ErrorKind::mpi) and ends the
  // update if some of them did not arrive.
  void wait();
  // Writes the received values to the ghosts and ends the update. Local.
  void unpack(double* values);
  // Discards the received values and ends the update.
  void drop() { under_way_ = false; }

 private:
  std::shared_ptr<const ExchangePattern> pattern_;
  std::int64_t components_ = 0;
  std::vector<Bytes> outgoing_, incoming_;
  std::unique_ptr<PersistentExchange> exchange_;  // refers to the buffers, hence declared last
  bool under_way_ = false;
};

}  // namespace pnpbs
