// SPDX-License-Identifier: BSD-3-Clause
// Binary files that are a sequence of numbers, read one by one.
#pragma once

#include <algorithm>
#include <bit>
#include <string>
#include <string_view>
#include <utility>

#include "base/error.hpp"
#include "base/limits.hpp"
#include "base/number_bytes.hpp"

namespace pnpbs {

// A reader of numbers at a current byte, which names this byte in errors.
class ByteFields {
 public:
  // Starts at byte `begin`. `name` stands for the file in messages. `bytes` must outlive this
  // object.
  ByteFields(std::string_view bytes, std::size_t begin, std::endian order, std::string name)
      : bytes_(bytes), at_(begin), order_(order), name_(std::move(name)) {}

  std::size_t remaining() const { return bytes_.size() - at_; }

  // Returns the next number. `what` describes the expected number in messages. Throws Error "name:
  // at byte 84: found ..., expected what" if none exists.
  template <class Number>
  Number next(std::string_view what) {
    if (remaining() < sizeof(Number)) fail("the file ends, expected " + std::string(what));
    const auto number = number_from_bytes<Number>(bytes_.data() + at_, order_);
    at_ += sizeof(Number);
    return number;
  }

  // Returns the next number as a coordinate. Throws also if its absolute value exceeds 1e60.
  template <class Number>
  double coordinate(std::string_view what) {
    const auto value = static_cast<double>(next<Number>(what));
    if (!is_usable(value)) {
      at_ -= sizeof(Number);
      fail("found " + number_text(value) + ", expected " + std::string(what) +
           " (a number between -1e60 and 1e60)");
    }
    return value;
  }

  void skip(std::size_t count) { at_ += std::min(count, remaining()); }

  [[noreturn]] void fail(const std::string& message) const {
    throw Error(ErrorKind::file, name_ + ": at byte " + std::to_string(at_) + ": " + message);
  }

 private:
  std::string_view bytes_;
  std::size_t at_;
  std::endian order_;
  std::string name_;
};

}  // namespace pnpbs
