// SPDX-License-Identifier: BSD-3-Clause
#include "domain/plane/text_fields.hpp"

#include <algorithm>
#include <charconv>
#include <limits>
#include <system_error>
#include <utility>

#include "base/error.hpp"
#include "base/limits.hpp"

namespace pnpbs {

namespace {

constexpr std::string_view kBlank = " \t\r\v\f";
constexpr std::size_t kLongestShown = 24;

// As a message can show it.
std::string shown(std::string_view field) {
  std::string text;
  for (const char c : field.substr(0, kLongestShown)) {
    const bool printable = c >= ' ' && c <= '~';
    text += printable ? c : '?';
  }
  return "'" + text + (field.size() > kLongestShown ? "...'" : "'");
}

template <class Number>
bool parse(std::string_view field, Number& value, std::errc& problem) {
  if (field.size() > 1 && field[0] == '+' && field[1] != '-') field.remove_prefix(1);
  const char* end = field.data() + field.size();
  const auto result = std::from_chars(field.data(), end, value);
  problem = result.ec;
  return result.ec == std::errc() && result.ptr == end;
}

}  // namespace

TextFields::TextFields(std::string_view text, std::string name)
    : rest_(text), name_(std::move(name)) {
  constexpr std::string_view kByteOrderMark = "\xef\xbb\xbf";
  if (rest_.substr(0, kByteOrderMark.size()) == kByteOrderMark) {
    rest_.remove_prefix(kByteOrderMark.size());
  }
}

bool TextFields::next_line() {
  while (!rest_.empty()) {
    const std::size_t end = rest_.find('\n');
    line_ = rest_.substr(0, end);
    rest_.remove_prefix(end == std::string_view::npos ? rest_.size() : end + 1);
    ++line_number_;
    line_ = line_.substr(0, line_.find('#'));
    if (line_.find_first_not_of(kBlank) != std::string_view::npos) return true;
  }
  line_ = {};
  return false;
}

std::optional<std::string_view> TextFields::next() {
  const std::size_t begin = line_.find_first_not_of(kBlank);
  if (begin == std::string_view::npos) return std::nullopt;
  line_.remove_prefix(begin);
  const std::string_view field = line_.substr(0, line_.find_first_of(kBlank));
  line_.remove_prefix(field.size());
  return field;
}

std::string_view TextFields::required(const std::string& what) {
  const auto field = next();
  if (!field) fail("the line ends, expected " + what);
  return *field;
}

std::int64_t TextFields::integer(const std::string& what) {
  const std::string_view field = required(what);
  std::int64_t value = 0;
  std::errc problem{};
  if (!parse(field, value, problem)) fail_found(field, what);
  return value;
}

double TextFields::coordinate(const std::string& what) {
  const std::string_view field = required(what);
  double value = 0;
  std::errc problem{};
  if (!parse(field, value, problem) || !is_usable(value)) {
    fail_found(field, what + " (a number between -1e60 and 1e60)");
  }
  return value;
}

std::int32_t TextFields::tag(const std::string& what) {
  const std::string_view field = required(what);
  std::int32_t value = 0;
  std::errc problem{};
  if (!parse(field, value, problem)) fail_found(field, what + " (a 32-bit integer)");
  return value;
}

void TextFields::fail_found(std::string_view found, const std::string& what) const {
  fail("found " + shown(found) + ", expected " + what);
}

void TextFields::fail(const std::string& message) const {
  throw Error(
      ErrorKind::file,
      name_ + ":" + std::to_string(std::max<std::int64_t>(line_number_, 1)) + ": " + message);
}

}  // namespace pnpbs
