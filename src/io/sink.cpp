// SPDX-License-Identifier: BSD-3-Clause
#include "io/sink.hpp"

#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <stdexcept>

#include "base/error.hpp"

namespace pnpbs::io {

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
  if (used_ > 0) drain_({buffer_.data(), used_});
  used_ = 0;
}

Sink::Drain to_descriptor(int descriptor, std::string name, std::function<void()> before_write) {
  return [=](std::span<const char> bytes) {
    while (!bytes.empty()) {
      if (before_write) before_write();
      const ssize_t wrote = ::write(descriptor, bytes.data(), bytes.size());
      if (wrote >= 0) {
        bytes = bytes.subspan(static_cast<std::size_t>(wrote));
      } else if (errno != EINTR) {
        throw Error(ErrorKind::file, "cannot write " + name + ": " + std::strerror(errno));
      }
    }
  };
}

}  // namespace pnpbs::io
