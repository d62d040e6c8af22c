// SPDX-License-Identifier: BSD-3-Clause
#include "comm/ghost_sum.hpp"

#include <algorithm>
#include <cstring>

#include "base/exact_sum.hpp"
#include "comm/exchange_buffers.hpp"

namespace pnpbs {

void GhostSum::pack(const Communicator& comm, const std::shared_ptr<const ExchangePattern>& pattern,
                    std::int64_t components, const double* values) {
  const std::size_t bytes_of_node = static_cast<std::size_t>(components) * sizeof(double);
  if (pattern != pattern_ || components != components_) {
    exchange_.reset();
    pattern_.reset();  // until everything is allocated
    outgoing_ = exchange_buffers(pattern->receive_offsets, bytes_of_node);
    incoming_ = exchange_buffers(pattern->send_offsets, bytes_of_node);
    exchange_ = comm.persistent_exchange(pattern->ranks, outgoing_, incoming_);
    parts_.resize(pattern->send_nodes.size() * static_cast<std::size_t>(components));
    components_ = components;
    pattern_ = pattern;
    list_parts();
  }
  auto ghost = pattern->receive_nodes.begin();
  for (Bytes& bytes : outgoing_)
    for (std::size_t at = 0; at < bytes.size(); at += bytes_of_node)
      std::memcpy(bytes.data() + at, values + *ghost++ * components, bytes_of_node);
}

void GhostSum::list_parts() {
  by_node_.clear();
  for (const std::int64_t node : pattern_->send_nodes)
    by_node_.push_back({node, static_cast<std::int64_t>(by_node_.size())});
  std::ranges::stable_sort(by_node_, {}, &Part::node);
}

void GhostSum::exchange() {
  exchange_->start();
  exchange_->wait();
  double* to = parts_.data();
  for (const Bytes& bytes : incoming_) {
    if (!bytes.empty()) std::memcpy(to, bytes.data(), bytes.size());
    to += bytes.size() / sizeof(double);
  }
}

// Adds the values of one node to value[components].
void GhostSum::add_exactly(const Part* first, const Part* last, double* value) const {
  for (std::int64_t c = 0; c < components_; ++c) {
    const auto part = [&](const Part* p) {
      return parts_[static_cast<std::size_t>(p->place * components_ + c)];
    };
    if (last - first == 1) {  // the processor rounds the exact sum of two terms
      value[c] += part(first);
      continue;
    }
    ExactSum sum;
    sum.add(value[c]);
    for (const Part* p = first; p != last; ++p) sum.add(part(p));
    value[c] = sum.value();
  }
}

void GhostSum::add(std::int64_t n, double* values) const {
  const Part* const end = by_node_.data() + by_node_.size();
  for (const Part* first = by_node_.data(); first != end;) {
    const Part* last = first;
    while (last != end && last->node == first->node) ++last;
    add_exactly(first, last, values + first->node * components_);
    first = last;
  }
  // A sum that is 0 has to be +0. Adding 0.0 turns -0 into +0 at nodes that received nothing, too.
  for (double* value = values; value != values + n * components_; ++value) *value += 0.0;
}

}  // namespace pnpbs
