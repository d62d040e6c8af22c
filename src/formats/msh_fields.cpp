// SPDX-License-Identifier: BSD-3-Clause
#include "formats/msh_fields.hpp"

#include <algorithm>

#include "base/error.hpp"
#include "base/limits.hpp"
#include "base/number_bytes.hpp"
#include "base/text_lines.hpp"
#include "formats/text_fields.hpp"

namespace pnpbs {

namespace {

constexpr std::string_view kBlanks = " \t\r\n\v\f";

std::string_view trimmed(std::string_view text) {
  const std::size_t begin = std::min(text.find_first_not_of(kBlanks), text.size());
  text.remove_prefix(begin);
  return text.substr(0, text.find_last_not_of(kBlanks) + 1);
}

}  // namespace

std::optional<std::string_view> MshFields::line() {
  while (remaining() > 0) {
    read_last_ = at_;
    std::string_view rest = bytes_.substr(at_);
    const std::string_view text = trimmed(take_line(rest));
    at_ = bytes_.size() - rest.size();
    if (!text.empty()) return text;
  }
  read_last_ = at_;
  return std::nullopt;
}

std::string_view MshFields::required_line(std::string_view what) {
  const auto text = line();
  if (!text) fail("the file ends, expected " + std::string(what));
  return *text;
}

void MshFields::skip_section(std::string_view section) {
  const std::string end = "$End" + std::string(section);
  std::size_t found = bytes_.find(end, at_);
  // A section without lines ends right here, any other one at the beginning of a line.
  while (found != std::string_view::npos && found > at_ && !is_line_end(bytes_[found - 1]))
    found = bytes_.find(end, found + 1);
  if (found == std::string_view::npos)
    fail("the section $" + std::string(section) + " has no end '" + end + "'");
  at_ = found;
  line();
}

template <class Number>
Number MshFields::raw(std::string_view what) {
  read_last_ = at_;
  if (remaining() < sizeof(Number)) fail("the file ends, expected " + std::string(what));
  const auto number = number_from_bytes<Number>(bytes_.data() + at_, order_);
  at_ += sizeof(Number);
  return number;
}

std::string_view MshFields::word(std::string_view what) {
  at_ = std::min(bytes_.find_first_not_of(kBlanks, at_), bytes_.size());
  read_last_ = at_;
  if (remaining() == 0) fail("the file ends, expected " + std::string(what));
  const std::size_t end = std::min(bytes_.find_first_of(kBlanks, at_), bytes_.size());
  const std::string_view text = bytes_.substr(at_, end - at_);
  at_ = end;
  return text;
}

std::int32_t MshFields::int32(std::string_view what) {
  if (binary_) return raw<std::int32_t>(what);
  const std::string_view text = word(what);
  std::int32_t value = 0;
  if (!parse_field(text, value)) fail_found(text, std::string(what) + " (a 32-bit integer)");
  return value;
}

std::int64_t MshFields::size(std::string_view what) {
  std::int64_t value = 0;
  if (binary_) {
    value = raw<std::int64_t>(what);
  } else if (const std::string_view text = word(what); !parse_field(text, value)) {
    fail_found(text, what);
  }
  if (value < 0) fail(std::string(what) + " is " + std::to_string(value));
  return value;
}

double MshFields::any_number(std::string_view what) {
  if (binary_) return raw<double>(what);
  const std::string_view text = word(what);
  double value = 0;
  if (!parse_field(text, value)) fail_found(text, what);
  return value;
}

double MshFields::coordinate(std::string_view what) {
  const double value = any_number(what);
  if (!is_usable(value))
    fail("found " + number_text(value) + ", expected " + std::string(what) +
         " (a number between -1e60 and 1e60)");
  return value;
}

std::int64_t MshFields::count(std::string_view what, std::size_t text_bytes,
                              std::size_t binary_bytes) {
  const std::int64_t value = size("the number of " + std::string(what));
  require_room(value, what, text_bytes, binary_bytes);
  return value;
}

void MshFields::require_room(std::int64_t count, std::string_view what, std::size_t text_bytes,
                             std::size_t binary_bytes) const {
  // The last number of a text file need not be followed by a separator.
  const std::size_t room = binary_ ? remaining() / binary_bytes : (remaining() + 1) / text_bytes;
  if (static_cast<std::uint64_t>(count) > room)
    fail("the file ends too early: it has no room for " + std::to_string(count) + " " +
         std::string(what));
}

void MshFields::fail_found(std::string_view found, std::string_view what) const {
  fail("found " + shown_field(found) + ", expected " + std::string(what));
}

void MshFields::fail(const std::string& message) const {
  std::string place = ": at byte " + std::to_string(read_last_);
  if (!binary_) {
    place = ":" + std::to_string(count_line_ends(bytes_.substr(0, read_last_)) + 1);
  }
  throw Error(ErrorKind::file, name_ + place + ": " + message);
}

}  // namespace pnpbs
