// SPDX-License-Identifier: BSD-3-Clause
#include "formats/text_fields.hpp"

#include <algorithm>
#include <array>
#include <cerrno>
#include <charconv>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <memory>
#include <system_error>
#include <utility>

#include "base/error.hpp"
#include "base/limits.hpp"
#include "base/text_lines.hpp"

namespace pnpbs {
namespace {

constexpr std::size_t kLongestShown = 24;

constexpr bool is_blank(char c) { return c == ' ' || c == '\t' || c == '\v' || c == '\f'; }

std::string_view without_leading_blanks(std::string_view text) {
  const auto begin = std::find_if_not(text.begin(), text.end(), is_blank);
  text.remove_prefix(static_cast<std::size_t>(begin - text.begin()));
  return text;
}

}  // namespace

std::string shown_field(std::string_view field) {
  std::string text;
  for (const char c : field.substr(0, kLongestShown)) {
    const bool printable = c >= ' ' && c <= '~';
    text += printable ? c : '?';
  }
  return "'" + text + (field.size() > kLongestShown ? "...'" : "'");
}

template <class Number>
bool parse_field(std::string_view field, Number& value) {
  if (field.size() > 1 && field[0] == '+' && field[1] != '-') field.remove_prefix(1);
  const char* end = field.data() + field.size();
  const auto result = std::from_chars(field.data(), end, value);
  return result.ec == std::errc() && result.ptr == end;
}
template bool parse_field(std::string_view, std::int32_t&);
template bool parse_field(std::string_view, std::int64_t&);
template bool parse_field(std::string_view, double&);

TextFields::TextFields(std::string_view text, std::string name, Comments comments)
    : rest_(text), name_(std::move(name)), comments_(comments) {
  constexpr std::string_view kByteOrderMark = "\xef\xbb\xbf";
  if (rest_.starts_with(kByteOrderMark)) rest_.remove_prefix(kByteOrderMark.size());
}

bool TextFields::next_line() {
  while (!rest_.empty()) {
    line_ = without_leading_blanks(take_line(rest_));
    ++line_number_;
    if (comments_ == Comments::anywhere) line_ = line_.substr(0, line_.find('#'));
    if (!line_.empty() && line_.front() != '#') return true;
  }
  line_ = {};
  return false;
}

std::optional<std::string_view> TextFields::next() {
  line_ = without_leading_blanks(line_);
  if (line_.empty()) return std::nullopt;
  const auto end = std::find_if(line_.begin(), line_.end(), is_blank);
  const std::string_view field = line_.substr(0, static_cast<std::size_t>(end - line_.begin()));
  line_.remove_prefix(field.size());
  return field;
}

std::string_view TextFields::rest_of_line() const {
  std::string_view text = without_leading_blanks(line_);
  while (!text.empty() && is_blank(text.back())) text.remove_suffix(1);
  return text;
}

std::string_view TextFields::required(std::string_view what) {
  const auto field = next();
  if (!field) fail("the line ends, expected " + std::string(what));
  return *field;
}

std::int64_t TextFields::integer(std::string_view what) { return integer_in(required(what), what); }

std::int64_t TextFields::integer_in(std::string_view field, std::string_view what) const {
  std::int64_t value = 0;
  if (!parse_field(field, value)) fail_found(field, what);
  return value;
}

double TextFields::coordinate(std::string_view what) {
  const std::string_view field = required(what);
  double value = 0;
  if (!parse_field(field, value) || !is_usable(value)) {
    fail_found(field, std::string(what) + " (a number between -1e60 and 1e60)");
  }
  return value;
}

std::int32_t TextFields::tag(std::string_view what) {
  const std::string_view field = required(what);
  std::int32_t value = 0;
  if (!parse_field(field, value)) fail_found(field, std::string(what) + " (a 32-bit integer)");
  return value;
}

void TextFields::fail_found(std::string_view found, std::string_view what) const {
  fail("found " + shown_field(found) + ", expected " + std::string(what));
}

void TextFields::fail(const std::string& message) const {
  throw Error(
      ErrorKind::file,
      name_ + ":" + std::to_string(std::max<std::int64_t>(line_number_, 1)) + ": " + message);
}

void expect_text(std::string_view text, const std::string& name, const std::string& format) {
  if (text.find('\0') == std::string_view::npos) return;
  throw Error(ErrorKind::file, name + ": holds zero bytes, expected text in " + format + " format");
}

std::string part_of(std::int64_t part, std::int64_t whole, const std::string& what) {
  return std::to_string(part) + " of " + std::to_string(whole) + " " + what;
}

std::string read_whole_file(const std::string& path) {
  const auto fail = [&path](const std::string& why) {
    throw Error(ErrorKind::file, path + ": cannot be read: " + why);
  };
  const std::unique_ptr<std::FILE, int (*)(std::FILE*)> file(std::fopen(path.c_str(), "rb"),
                                                             &std::fclose);
  if (!file) fail(std::strerror(errno));
  std::error_code ignored;
  const bool is_device = std::filesystem::is_character_file(path, ignored);
  std::string bytes;
  std::array<char, 65536> part;
  while (const std::size_t count = std::fread(part.data(), 1, part.size(), file.get())) {
    bytes.append(part.data(), count);
    // Stop at zero bytes, because a device such as /dev/zero never ends.
    if (is_device && std::memchr(part.data(), 0, count) != nullptr) break;
  }
  if (std::ferror(file.get())) fail(std::strerror(errno));
  return bytes;
}

}  // namespace pnpbs
