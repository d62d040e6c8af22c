// SPDX-License-Identifier: BSD-3-Clause
// A buffer for the bytes of writers, which is drained when full.
#pragma once

#include <charconv>
#include <concepts>
#include <cstddef>
#include <functional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace pnpbs::io {

// A buffered output. The owner must call flush() at the end.
class Sink {
 public:
  using Drain = std::function<void(std::span<const char>)>;

  explicit Sink(Drain drain, std::size_t capacity = std::size_t{1} << 16)
      : drain_(std::move(drain)), buffer_(capacity) {}

  void bytes(const void* data, std::size_t size);
  void text(std::string_view characters) { bytes(characters.data(), characters.size()); }
  // Writes the shortest text that is read back as the same number, in any locale.
  template <typename Number>
  requires std::integral<Number> || std::floating_point<Number>
  void number(Number value) {
    if (buffer_.size() - used_ < longest_number) flush();
    char* begin = buffer_.data() + used_;
    used_ +=
        static_cast<std::size_t>(std::to_chars(begin, begin + longest_number, value).ptr - begin);
  }
  template <typename Value>
  void array(std::span<const Value> values) {
    bytes(values.data(), values.size_bytes());
  }
  void flush();

 private:
  static constexpr std::size_t longest_number = 32;

  Drain drain_;
  std::vector<char> buffer_;
  std::size_t used_ = 0;
};

// Returns a drain that writes to an open file. `name` is its name in messages. `before_write` is
// called before every write; it may be empty, and may throw to cancel.
Sink::Drain to_descriptor(int descriptor, std::string name, std::function<void()> before_write);

}  // namespace pnpbs::io
