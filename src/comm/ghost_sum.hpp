// SPDX-License-Identifier: BSD-3-Clause
// Values at ghosts on their way to the owners of these nodes, where they are added up: the way of
// GhostUpdate back. Buffers are kept from one sum to the next.
#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "comm/communicator.hpp"
#include "comm/exchange_pattern.hpp"

namespace pnpbs {

class GhostSum {
 public:
  // Copies the values of the ghosts. values: [nodes and ghosts][components]. Local.
  void pack(const Communicator& comm, const std::shared_ptr<const ExchangePattern>& pattern,
            std::int64_t components, const double* values);
  // Sends what is packed, and waits for what comes. All ranks do, after they have agreed that all
  // of them have packed. Throws Error(ErrorKind::mpi) on a rank that lacks some of it.
  void exchange();
  // Adds what has come to the values of the owned nodes, of which there are n: the exact sum,
  // rounded once, so that no order of ranks matters. Local.
  void add(std::int64_t n, double* values) const;

 private:
  // Something that came for an owned node: where it is in `parts_`.
  struct Part {
    std::int64_t node, place;
  };
  void list_parts();
  void add_exactly(const Part* first, const Part* last, double* value) const;

  std::shared_ptr<const ExchangePattern> pattern_;
  std::int64_t components_ = 0;
  std::vector<Bytes> outgoing_, incoming_;
  std::vector<Part> by_node_;                     // of the pattern
  std::vector<double> parts_;                     // [all that comes][components]
  std::unique_ptr<PersistentExchange> exchange_;  // between the buffers, and gone before them
};

}  // namespace pnpbs
