// SPDX-License-Identifier: BSD-3-Clause
// Files in Gmsh's MSH format, read line by line and number by number. In a text file, blanks and
// line ends separate numbers. In a binary file only the lines that begin and end sections are text.
#pragma once

#include <array>
#include <bit>
#include <cstdint>
#include <cstring>
#include <optional>
#include <string>
#include <string_view>
#include <utility>

namespace pnpbs {

// A reader of MSH files at a current byte, which names the line or byte in errors.
class MshFields {
 public:
  // `name` stands for the file in messages. `bytes` must outlive this object.
  MshFields(std::string_view bytes, std::string name) : bytes_(bytes), name_(std::move(name)) {}

  // Switches to binary numbers in this byte order.
  void set_binary(std::endian order) {
    binary_ = true;
    order_ = order;
  }
  bool is_binary() const { return binary_; }

  // Returns the next line that is not blank, without surrounding blanks, in text and binary files.
  // Returns nothing at the end of the file.
  std::optional<std::string_view> line();
  // Returns the next line. `what` describes the expected line in the error if none exists.
  std::string_view required_line(std::string_view what);
  // Skips everything up to and including the line "$End<section>".
  void skip_section(std::string_view section);

  // Return the next number. Each throws Error "name:line: found ..., expected what", or "name: at
  // byte 84: ..." for binary files.
  std::int32_t int32(std::string_view what);
  std::int64_t size(std::string_view what);  // 64 bits, not negative
  double coordinate(std::string_view what);
  double any_number(std::string_view what);  // also infinite or not a number
  // Returns a number of items that follow. Throws if the file is too short for items of at least
  // this many bytes each.
  std::int64_t count(std::string_view what, std::size_t text_bytes, std::size_t binary_bytes);
  void require_room(std::int64_t count, std::string_view what, std::size_t text_bytes,
                    std::size_t binary_bytes) const;

  // Throws Error at the number or line that was read last.
  [[noreturn]] void fail(const std::string& message) const;
  [[noreturn]] void fail_found(std::string_view found, std::string_view what) const;

 private:
  template <class Number>
  Number raw(std::string_view what);
  std::string_view word(std::string_view what);
  std::size_t remaining() const { return bytes_.size() - at_; }

  std::string_view bytes_;
  std::string name_;
  std::size_t at_ = 0, read_last_ = 0;
  bool binary_ = false;
  std::endian order_ = std::endian::native;
};

}  // namespace pnpbs
