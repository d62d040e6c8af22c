// SPDX-License-Identifier: BSD-3-Clause
// Stable counting sort on several threads. Each thread counts the keys of its own part of the
// entries. The order does not depend on the number of threads because the sort is stable.
#pragma once

#include <algorithm>
#include <cstdint>
#include <utility>
#include <vector>

#include "base/execution.hpp"
#include "base/rank_limit.hpp"

namespace pnpbs {

// A sorted order of entries by small integer keys.
class CountingSort {
 public:
  // Counts entries 0 .. n-1 by key(i), which must be less than `keys`. Entries with a negative key
  // are left out. Throws Error(ErrorKind::memory) if `n` exceeds the limit of a rank.
  template <class Key>
  CountingSort(std::int64_t n, std::int32_t keys, const Key& key);

  // Returns the sorted index of the first entry of each key, followed by the number of sorted
  // entries.
  const std::vector<std::int32_t>& start() const { return start_; }
  // Returns true if the entries are in order already and none is left out.
  bool in_order() const { return in_order_; }

  // Calls visit(i, sorted_index) for each entry that is not left out, on all threads. `key` must be
  // the one of the constructor. May be called only once because it overwrites the counts.
  template <class Key, class Visit>
  void for_places(const Key& key, const Visit& visit);

 private:
  static constexpr std::int64_t kMaxParts = 16;       // bounds the memory for the counts
  static constexpr std::int64_t kMinEntries = 20000;  // per part

  std::int64_t begin(std::int64_t part) const { return part * n_ / parts_; }
  std::int32_t* counts_of(std::int64_t part) const { return counts_.data() + part * keys_; }

  std::int64_t n_, parts_, keys_;
  View<std::int32_t> counts_;  // by part and key: first the count, later the next sorted index
  std::vector<std::int32_t> start_;
  bool in_order_ = true;
};

template <class Key>
CountingSort::CountingSort(std::int64_t n, std::int32_t keys, const Key& key)
    : n_(n),
      parts_(std::clamp<std::int64_t>(n / kMinEntries, 1,
                                      std::min<std::int64_t>(Exec().concurrency(), kMaxParts))),
      keys_(keys),
      counts_(make_view<std::int32_t>("pnpbs::CountingSort::counts", parts_ * keys)) {
  require_fits_rank(n, "nodes to sort");
  std::vector<char> in_order(static_cast<std::size_t>(parts_));
  for_each("pnpbs::CountingSort::count", parts_, [&](std::int64_t part) {
    std::int32_t* const counts = counts_of(part);
    std::fill_n(counts, keys_, 0);
    bool ordered = true;
    std::int32_t before = begin(part) > 0 ? key(begin(part) - 1) : 0;
    for (std::int64_t i = begin(part); i < begin(part + 1); ++i) {
      const std::int32_t k = key(i);
      ordered = ordered && k >= 0 && before <= k;
      before = k;
      if (k >= 0) ++counts[k];
    }
    in_order[static_cast<std::size_t>(part)] = ordered;
  });
  in_order_ = std::find(in_order.begin(), in_order.end(), 0) == in_order.end();
  start_.resize(static_cast<std::size_t>(keys) + 1);
  std::int32_t next = 0;
  for (std::int32_t k = 0; k < keys; ++k) {
    start_[static_cast<std::size_t>(k)] = next;
    for (std::int64_t part = 0; part < parts_; ++part) {
      std::int32_t& count = counts_of(part)[k];
      next += std::exchange(count, next);
    }
  }
  start_.back() = next;
}

template <class Key, class Visit>
void CountingSort::for_places(const Key& key, const Visit& visit) {
  for_each("pnpbs::CountingSort::for_places", parts_, [&](std::int64_t part) {
    std::int32_t* const next = counts_of(part);
    for (std::int64_t i = begin(part); i < begin(part + 1); ++i) {
      const std::int32_t k = key(i);
      if (k >= 0) visit(i, next[k]++);
    }
  });
}

}  // namespace pnpbs
