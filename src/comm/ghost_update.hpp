// SPDX-License-Identifier: BSD-3-Clause
// Values at nodes on their way to the ghosts of other ranks: what is sent is copied when the update
// begins, and what has come is handed out when it ends. Buffers are kept from one update to the
// next.
#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "comm/communicator.hpp"
#include "comm/exchange_pattern.hpp"

namespace pnpbs {

class GhostUpdate {
 public:
  bool under_way() const { return under_way_; }
  // Whether it goes, or went last, by this pattern.
  bool follows(const std::shared_ptr<const ExchangePattern>& pattern) const {
    return pattern_ == pattern;
  }
  std::int64_t components() const { return components_; }

  // Copies what is to be sent. values: [nodes and ghosts][components]. Local.
  void pack(const Communicator& comm, const std::shared_ptr<const ExchangePattern>& pattern,
            std::int64_t components, const double* values);
  // Sends what is packed. All ranks start, after they have agreed that all of them have packed.
  void start();
  // Waits for the values of this rank's ghosts. Local. Throws Error(ErrorKind::mpi) if some did not
  // come, which ends the update.
  void wait();
  // Fills the values of the ghosts. Local.
  void unpack(double* values);
  // Forgets what has come.
  void drop() { under_way_ = false; }

 private:
  std::shared_ptr<const ExchangePattern> pattern_;
  std::int64_t components_ = 0;
  std::vector<Bytes> outgoing_, incoming_;
  std::unique_ptr<PersistentExchange> exchange_;  // between the buffers, and gone before them
  bool under_way_ = false;
};

}  // namespace pnpbs
