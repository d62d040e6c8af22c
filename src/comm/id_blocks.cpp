// SPDX-License-Identifier: BSD-3-Clause
#include "comm/id_blocks.hpp"

#include <algorithm>
#include <limits>
#include <string>

#include "base/error.hpp"
#include "base/leading_count.hpp"
#include "comm/records.hpp"

namespace pnpbs {

namespace {

constexpr std::int64_t kSentAtOnce = 1 << 15;

// The ids of the owned nodes of this rank, in increasing order.
struct OwnedIds {
  std::int64_t count;
  const std::function<std::int64_t(std::int64_t)>& id;

  std::int64_t count_below(std::int64_t bound) const {
    return leading_count(count, [&](std::int64_t place) { return id(place) < bound; });
  }
};

// Returns for each number the smallest id that has at least so many smaller ids. All bisections run
// at the same time, and no rank needs the ids of the others. Collective.
std::vector<std::int64_t> ids_that_begin(const Communicator& comm, const OwnedIds& owned,
                                         const std::vector<std::int64_t>& numbers) {
  const double max =
      comm.allreduce_max(owned.count == 0 ? 0 : static_cast<double>(owned.id(owned.count - 1)));
  // The conversion to double may have lost the last bits of a large id.
  const std::int64_t bound = max < 0x1p62 ? static_cast<std::int64_t>(max * (1 + 0x1p-40)) + 2
                                          : std::numeric_limits<std::int64_t>::max();
  std::vector<std::int64_t> low(numbers.size(), 0), high(numbers.size(), bound);
  while (low != high) {
    std::vector<std::int64_t> middle(numbers.size()), below(numbers.size());
    for (std::size_t k = 0; k < numbers.size(); ++k) {
      middle[k] = low[k] + (high[k] - low[k]) / 2;
      below[k] = owned.count_below(middle[k]);
    }
    comm.allreduce_sum(below);
    for (std::size_t k = 0; k < numbers.size(); ++k) {
      if (low[k] == high[k]) continue;
      if (below[k] >= numbers[k])
        high[k] = middle[k];
      else
        low[k] = middle[k] + 1;
    }
  }
  return low;
}

}  // namespace

IdBlocks::IdBlocks(const Communicator& comm, std::int64_t owned,
                   const std::function<std::int64_t(std::int64_t)>& owned_id)
    : comm_(comm) {
  const std::int64_t total = span_of(comm, static_cast<std::size_t>(owned)).total;
  std::vector<std::int64_t> numbers{0};  // first number of each block
  // Equals total * r / size, computed without a product that could overflow.
  for (int r = 1; r <= comm.size(); ++r)
    numbers.push_back(total / comm.size() * r + total % comm.size() * r / comm.size());
  const auto rank = static_cast<std::size_t>(comm.rank());
  span_ = {numbers[rank], numbers[rank + 1] - numbers[rank], total};
  ids_.reserve(static_cast<std::size_t>(span_.count));
  numbers.erase(numbers.begin());
  numbers.pop_back();
  if (comm.size() > 1) begin_ = ids_that_begin(comm, {owned, owned_id}, numbers);
  // Sends the ids in portions, since all messages together would need several times the memory of
  // the ids.
  const auto max = static_cast<std::int64_t>(comm.allreduce_max(static_cast<double>(owned)));
  for (std::int64_t begin = 0; begin < max; begin += kSentAtOnce) {
    std::vector<std::int64_t> part;
    for (std::int64_t k = begin; k < std::min(owned, begin + kSentAtOnce); ++k)
      part.push_back(owned_id(k));
    for (const std::int64_t id :
         redistribute(comm, part, [this](std::int64_t i) { return rank_of(i); }))
      ids_.push_back(id);
  }
  std::ranges::sort(ids_);
}

std::vector<std::int64_t> IdBlocks::ids_at(const std::vector<std::int64_t>& numbers) const {
  std::vector<std::int64_t> ids(numbers.size(), 0);
  for (std::size_t k = 0; k < numbers.size(); ++k) {
    const std::int64_t place = numbers[k] - span_.first;
    if (place >= 0 && place < span_.count) ids[k] = ids_[static_cast<std::size_t>(place)];
  }
  comm_.allreduce_sum(ids);
  return ids;
}

int IdBlocks::rank_of(std::int64_t id) const {
  return static_cast<int>(std::upper_bound(begin_.begin(), begin_.end(), id) - begin_.begin());
}

std::int64_t IdBlocks::number_in_block(std::int64_t id) const {
  const auto found = std::lower_bound(ids_.begin(), ids_.end(), id);
  if (found == ids_.end() || *found != id)
    throw Error(ErrorKind::internal, "no rank owns the node with id " + std::to_string(id));
  return span_.first + (found - ids_.begin());
}

// Most ids lie in the block of this rank; for the others, the ranks with their blocks are queried.
std::vector<std::int64_t> IdBlocks::numbers_of(const std::vector<std::int64_t>& ids) const {
  Outbox questions, answers;
  for (const std::int64_t id : ids)
    if (rank_of(id) != comm_.rank()) pack(questions.to(rank_of(id)), id);
  const std::vector<Message> asked = comm_.sparse_all_to_all(questions.messages());
  collective_try(comm_, [&] {
    for (const Message& theirs : asked)
      for_records<std::int64_t>(theirs.bytes, [&](std::int64_t id) {
        pack(answers.to(theirs.rank), number_in_block(id));
      });
  });
  const std::vector<Message> told = comm_.sparse_all_to_all(answers.messages());
  std::vector<std::int64_t> numbers;
  collective_try(comm_, [&] {
    RankIndices places;
    for (const Message& theirs : told) places.add(theirs.rank);
    std::vector<std::size_t> at(told.size());  // answers are in the order of the questions
    for (const std::int64_t id : ids) {
      std::int64_t number;
      if (rank_of(id) == comm_.rank()) {
        number = number_in_block(id);
      } else {
        const auto k = static_cast<std::size_t>(places.of(rank_of(id)));
        std::memcpy(&number, told[k].bytes.data() + at[k], sizeof number);
        at[k] += sizeof number;
      }
      numbers.push_back(number);
    }
  });
  return numbers;
}

}  // namespace pnpbs
