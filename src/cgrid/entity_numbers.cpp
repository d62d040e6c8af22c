// SPDX-License-Identifier: BSD-3-Clause
#include "cgrid/entity_numbers.hpp"

#include <algorithm>

#include "comm/id_blocks.hpp"
#include "comm/records.hpp"

namespace pnpbs {

namespace {

struct Entry {
  std::int64_t id;
  std::int32_t rank;  // that has the node
  LedEntities led;
};

// What the entries before each one count, from `next` on.
void count_up(std::vector<Entry>& entries, LedEntities next) {
  for (Entry& entry : entries) {
    const LedEntities count = entry.led;
    entry.led = next;
    next += count;
  }
}

LedEntities sum_of(const std::vector<Entry>& entries) {
  LedEntities sum;
  for (const Entry& entry : entries) sum += entry.led;
  return sum;
}

}  // namespace

std::vector<LedEntities> first_numbers(const Communicator& comm,
                                       const std::vector<std::int64_t>& ids,
                                       const std::vector<LedEntities>& counts, LedEntities& total) {
  std::vector<Entry> entries;
  entries.reserve(ids.size());
  for (std::size_t k = 0; k < ids.size(); ++k) entries.push_back({ids[k], comm.rank(), counts[k]});
  if (comm.size() > 1) {
    const IdBlocks blocks(comm, std::ssize(ids),
                          [&](std::int64_t k) { return ids[static_cast<std::size_t>(k)]; });
    entries = redistribute<Entry>(comm, entries,
                                  [&](const Entry& entry) { return blocks.rank_of(entry.id); });
    std::ranges::sort(entries, {}, &Entry::id);
  }
  const LedEntities here = sum_of(entries);
  count_up(entries, {comm.sum_before(here.cells), comm.sum_before(here.edges),
                     comm.sum_before(here.vertices)});
  std::vector<std::int64_t> sums{here.cells, here.edges, here.vertices};
  comm.allreduce_sum(sums);
  total = {sums[0], sums[1], sums[2]};
  if (comm.size() > 1) {
    entries = redistribute<Entry>(comm, entries, [](const Entry& entry) { return entry.rank; });
    std::ranges::sort(entries, {}, &Entry::id);
  }
  std::vector<LedEntities> first;
  first.reserve(entries.size());
  for (const Entry& entry : entries) first.push_back(entry.led);
  return first;
}

}  // namespace pnpbs
