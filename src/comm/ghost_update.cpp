// SPDX-License-Identifier: BSD-3-Clause
#include "comm/ghost_update.hpp"

#include <cstring>

#include "comm/exchange_buffers.hpp"

namespace pnpbs {

void GhostUpdate::pack(const Communicator& comm,
                       const std::shared_ptr<const ExchangePattern>& pattern,
                       std::int64_t components, const double* values) {
  const std::size_t bytes_of_node = static_cast<std::size_t>(components) * sizeof(double);
  if (pattern != pattern_ || components != components_) {
    exchange_.reset();
    pattern_.reset();  // until everything is allocated
    outgoing_ = exchange_buffers(pattern->send_offsets, bytes_of_node);
    incoming_ = exchange_buffers(pattern->receive_offsets, bytes_of_node);
    exchange_ = comm.persistent_exchange(pattern->ranks, outgoing_, incoming_);
    pattern_ = pattern;
    components_ = components;
  }
  auto node = pattern->send_nodes.begin();
  for (Bytes& bytes : outgoing_)
    for (std::size_t at = 0; at < bytes.size(); at += bytes_of_node)
      std::memcpy(bytes.data() + at, values + *node++ * components, bytes_of_node);
}

void GhostUpdate::start() {
  under_way_ = true;
  exchange_->start();
}

void GhostUpdate::wait() {
  try {
    exchange_->wait();
  } catch (...) {
    under_way_ = false;
    throw;
  }
}

void GhostUpdate::unpack(double* values) {
  const std::size_t bytes_of_node = static_cast<std::size_t>(components_) * sizeof(double);
  auto node = pattern_->receive_nodes.begin();
  for (const Bytes& bytes : incoming_)
    for (std::size_t at = 0; at < bytes.size(); at += bytes_of_node)
      std::memcpy(values + *node++ * components_, bytes.data() + at, bytes_of_node);
  under_way_ = false;
}

}  // namespace pnpbs
