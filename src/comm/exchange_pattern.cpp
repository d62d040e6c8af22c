// SPDX-License-Identifier: BSD-3-Clause
#include "comm/exchange_pattern.hpp"

#include <algorithm>

namespace pnpbs {

namespace {

struct Request {
  std::int64_t id;
  std::int32_t from, by;  // the owner, and the rank that has the node as a ghost
};

// Pairs (rank, node index).
using Entries = std::vector<std::pair<std::int32_t, std::int64_t>>;

void make_rows(const std::vector<std::int32_t>& ranks, Entries entries,
               std::vector<std::int64_t>& offsets, std::vector<std::int64_t>& places) {
  std::sort(entries.begin(), entries.end());  // node indices increase with the ids
  offsets.assign(1, 0);
  for (const std::int32_t rank : ranks) {
    for (std::size_t k = places.size(); k < entries.size() && entries[k].first == rank; ++k)
      places.push_back(entries[k].second);
    offsets.push_back(static_cast<std::int64_t>(places.size()));
  }
}

}  // namespace

ExchangePattern make_exchange_pattern(const Communicator& comm, std::int64_t owned,
                                      const std::vector<std::int64_t>& ids,
                                      const std::vector<std::int32_t>& owners) {
  Entries sends, receives;
  std::vector<Request> requests;
  for (std::size_t g = 0; g < owners.size(); ++g) {
    const std::int64_t place = owned + static_cast<std::int64_t>(g);
    receives.emplace_back(owners[g], place);
    requests.push_back({ids[static_cast<std::size_t>(place)], owners[g], comm.rank()});
  }
  const auto end = ids.begin() + owned;
  for (const Request& request : redistribute<Request>(
           comm, requests, [](const Request& w) { return static_cast<int>(w.from); })) {
    const auto found = std::lower_bound(ids.begin(), end, request.id);
    if (found == end || *found != request.id)
      throw Error(ErrorKind::internal, "node " + std::to_string(request.id) +
                                           " is a ghost of this rank on rank " +
                                           std::to_string(request.by) + ", but is not owned here");
    sends.emplace_back(request.by, found - ids.begin());
  }
  ExchangePattern pattern;
  for (const auto& entry : sends) pattern.ranks.push_back(entry.first);
  for (const auto& entry : receives) pattern.ranks.push_back(entry.first);
  std::sort(pattern.ranks.begin(), pattern.ranks.end());
  pattern.ranks.erase(std::unique(pattern.ranks.begin(), pattern.ranks.end()), pattern.ranks.end());
  make_rows(pattern.ranks, std::move(sends), pattern.send_offsets, pattern.send_nodes);
  make_rows(pattern.ranks, std::move(receives), pattern.receive_offsets, pattern.receive_nodes);
  return pattern;
}

}  // namespace pnpbs
