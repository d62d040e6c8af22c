// SPDX-License-Identifier: BSD-3-Clause
#include "io/sink.hpp"

#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <stdexcept>

namespace pnpbs::io {

Sink::Sink(int descriptor, std::string name, std::function<void()> before_write)
    : descriptor_(descriptor),
      name_(std::move(name)),
      before_write_(std::move(before_write)),
      buffer_(1 << 16) {}

void Sink::bytes(const void* data, std::size_t size) {
  const char* next = static_cast<const char*>(data);
  while (size > 0) {
    if (used_ == buffer_.size()) flush();
    const std::size_t part = std::min(size, buffer_.size() - used_);
    std::memcpy(buffer_.data() + used_, next, part);
    used_ += part;
    next += part;
    size -= part;
  }
}

void Sink::flush() {
  for (std::size_t done = 0; done < used_;) {
    if (before_write_) before_write_();
    const ssize_t wrote = ::write(descriptor_, buffer_.data() + done, used_ - done);
    if (wrote >= 0) {
      done += static_cast<std::size_t>(wrote);
    } else if (errno != EINTR) {
      throw std::runtime_error("cannot write " + name_ + ": " + std::strerror(errno));
    }
  }
  used_ = 0;
}

}  // namespace pnpbs::io
