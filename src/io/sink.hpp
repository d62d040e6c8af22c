// SPDX-License-Identifier: BSD-3-Clause
// Where writers put their bytes: a buffered file descriptor.
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

class Sink {
 public:
  // name: for messages. before_write: called now and then; may throw to give up.
  Sink(int descriptor, std::string name, std::function<void()> before_write);

  void bytes(const void* data, std::size_t size);
  void text(std::string_view characters) { bytes(characters.data(), characters.size()); }
  // Shortest text that reads back as the same number, in every locale.
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

  int descriptor_;
  std::string name_;
  std::function<void()> before_write_;
  std::vector<char> buffer_;
  std::size_t used_ = 0;
};

}  // namespace pnpbs::io
