// Sum of the values at ghosts into the values of their owners, the reverse of GhostUpdate. Buffers
// are kept from one sum to the next.
#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "comm/communicator.hpp"
#include "comm/exchange_pattern.hpp"

namespace pnpbs {

// A sum over ghosts, performed by pack(), exchange() and add() in this order.
class GhostSum {
 public:
  // Copies the values of the ghosts. `values` has the shape [nodes and ghosts][components]. Local.
  void pack(const Communicator& comm, const std::shared_ptr<const ExchangePattern>& pattern,
            std::int64_t components, const double* values);
  // Sends the packed values and waits for those of other ranks. All ranks must call it, after they
  // have agreed that all of them have packed. Throws Error(ErrorKind::mpi) on a rank that lacks a
  // message.
  void exchange();
  // Adds the received values to the n owned nodes. The sum at a node is exact and rounded once, so
  // it does not depend on the order of ranks. Local.
  void add(std::int64_t n, double* values) const;

 private:
  // A received value: the owned node that it belongs to and its row in `parts_`.
  struct Part {
    std::int64_t node, place;
  };
  void list_parts();
  void add_exactly(const Part* first, const Part* last, double* value) const;

  std::shared_ptr<const ExchangePattern> pattern_;
  std::int64_t components_ = 0;
  std::vector<Bytes> outgoing_, incoming_;
  std::vector<Part> by_node_;  // received values sorted by node, fixed by the pattern
  std::vector<double> parts_;  // [received values][components]
  std::unique_ptr<PersistentExchange> exchange_;  // refers to the buffers, hence declared last
};

}  // namespace pnpbs
