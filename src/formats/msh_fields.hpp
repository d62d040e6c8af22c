// SPDX-License-Identifier: BSD-3-Clause
// A file in Gmsh's MSH format, line by line and number by number. In a text file numbers are
// separated by blanks or ends of lines; in a binary one only lines that begin and end sections are
// text.
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

class MshFields {
 public:
  // `name` stands for the file in messages. Keeps a reference to the bytes.
  MshFields(std::string_view bytes, std::string name) : bytes_(bytes), name_(std::move(name)) {}

  // From here on numbers are binary, in this order of bytes.
  void set_binary(std::endian order) {
    binary_ = true;
    order_ = order;
  }
  bool is_binary() const { return binary_; }

  // The next line that is not blank, without blanks around it, in either kind of file; nothing at
  // the end.
  std::optional<std::string_view> line();
  // `what` is what it should be, for the message if there is none.
  std::string_view required_line(std::string_view what);
  // To the line "$End<section>", past whatever is before it.
  void skip_section(std::string_view section);

  // Each throws Error "name:line: found ..., expected what", or "name: at byte 84: ...".
  std::int32_t int32(std::string_view what);
  std::int64_t size(std::string_view what);  // 64 bits, not negative
  double coordinate(std::string_view what);
  double any_number(std::string_view what);  // whatever a double can be
  // How many follow that take so many bytes each, as text at least: no more than the file has room
  // for.
  std::int64_t count(std::string_view what, std::size_t text_bytes, std::size_t binary_bytes);
  void require_room(std::int64_t count, std::string_view what, std::size_t text_bytes,
                    std::size_t binary_bytes) const;

  // Told as lying at the number or line that was read last.
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
