// SPDX-License-Identifier: BSD-3-Clause
#include "partition/cell_sums.hpp"

#include <utility>

#include "base/fixed_point.hpp"
#include "comm/records.hpp"

namespace pnpbs {

std::vector<std::int64_t> cell_prefix_sums(const Communicator& comm, std::int64_t cells,
                                           const std::vector<CellSum>& own, std::int64_t& start) {
  const std::int64_t length = (cells + comm.size() - 1) / comm.size(), first = comm.rank() * length;
  Outbox counted, answers;
  for (const CellSum& entry : own) pack(counted.to(static_cast<int>(entry.cell / length)), entry);
  const std::vector<Message> asked = comm.sparse_all_to_all(counted.messages());

  // Sums before each cell of this rank's block.
  std::vector<std::int64_t> before(static_cast<std::size_t>(length), 0);
  const auto at = [&](const CellSum& entry) -> std::int64_t& {
    return before[static_cast<std::size_t>(entry.cell - first)];
  };
  for (const Message& theirs : asked)
    for_records<CellSum>(theirs.bytes, [&](const CellSum& entry) {
      at(entry) = wrapping_sum(at(entry), entry.sum);
    });
  std::int64_t in_block = 0;
  for (std::int64_t& entry : before) entry = std::exchange(in_block, wrapping_sum(in_block, entry));
  const std::int64_t before_block = wrapping_sum(start, comm.exclusive_scan(in_block));
  start = wrapping_sum(
      start, static_cast<std::int64_t>(comm.allreduce_sum(static_cast<std::uint64_t>(in_block))));

  for (const Message& theirs : asked)
    for_records<CellSum>(theirs.bytes, [&](const CellSum& entry) {
      pack(answers.to(theirs.rank), wrapping_sum(before_block, at(entry)));
    });
  // The answers come by rank, so in the order of the cells.
  std::vector<std::int64_t> sums;
  sums.reserve(own.size());
  for (const Message& theirs : comm.sparse_all_to_all(answers.messages()))
    for_records<std::int64_t>(theirs.bytes, [&](std::int64_t sum) { sums.push_back(sum); });
  return sums;
}

}  // namespace pnpbs
