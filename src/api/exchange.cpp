// SPDX-License-Identifier: BSD-3-Clause
// C interface: the halo exchange plan and contiguous node numbers, for solvers on several ranks.
#include <algorithm>

#include "api/copy_out.hpp"
#include "api/placement_calls.hpp"

using namespace pnpbs;
using namespace pnpbs::api;

pnpbs_status pnpbs_placement_exchange_sizes(pnpbs_placement placement, int32_t* neighbours,
                                            int64_t* sends, int64_t* receives) {
  return collective_results(placement, [&](NodalResults& results) {
    const auto exchange = results.exchange_pattern();
    const ExchangePattern& pattern = *exchange;
    if (neighbours) *neighbours = static_cast<int32_t>(pattern.ranks.size());
    if (sends) *sends = pattern.send_offsets.back();
    if (receives) *receives = pattern.receive_offsets.back();
    return PNPBS_OK;
  });
}

pnpbs_status pnpbs_placement_get_exchange(pnpbs_placement placement, int32_t neighbours,
                                          int64_t sends, int64_t receives, int32_t* ranks,
                                          int64_t* send_offsets, int64_t* send_nodes,
                                          int64_t* receive_offsets, int64_t* receive_nodes) {
  return collective_results(placement, [&](NodalResults& results) {
    const auto exchange = results.exchange_pattern();
    const ExchangePattern& pattern = *exchange;
    require_capacity(neighbours, static_cast<std::int64_t>(pattern.ranks.size()), "neighbours");
    require_capacity(sends, pattern.send_offsets.back(), "sends");
    require_capacity(receives, pattern.receive_offsets.back(), "receives");
    copy_out(pattern.ranks, ranks);
    copy_out(pattern.send_offsets, send_offsets);
    copy_out(pattern.send_nodes, send_nodes);
    copy_out(pattern.receive_offsets, receive_offsets);
    copy_out(pattern.receive_nodes, receive_nodes);
    return PNPBS_OK;
  });
}

pnpbs_status pnpbs_placement_get_numbering(pnpbs_placement placement, int64_t capacity,
                                           int64_t* first, int64_t* count, int64_t* ghost_numbers) {
  return collective_results(placement, [&](NodalResults& results) {
    const auto exchange = results.exchange_pattern();
    const ExchangePattern& pattern = *exchange;
    const std::int64_t owned = results.count(), begin = results.nodes_on_ranks_before();
    std::vector<std::int64_t> number(static_cast<std::size_t>(results.held()));
    for (std::int64_t i = 0; i < owned; ++i) number[static_cast<std::size_t>(i)] = begin + i;
    fill_ghosts(results.communicator(), pattern, number);
    if (ghost_numbers) {
      require_capacity(capacity, results.held() - owned);
      std::copy(number.begin() + owned, number.end(), ghost_numbers);
    }
    if (first) *first = begin;
    if (count) *count = owned;
    return PNPBS_OK;
  });
}
