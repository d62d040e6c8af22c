// SPDX-License-Identifier: BSD-3-Clause
#include "checkpoint/saved_warnings.hpp"

#include <charconv>
#include <cstddef>
#include <string_view>
#include <utility>

#include "base/error.hpp"

namespace pnpbs {

namespace {

// A reader of this text.
class WarningReader {
 public:
  explicit WarningReader(const std::string& saved) : rest_(saved) {}

  bool at_end() const { return rest_.empty(); }

  Warning next() {
    const auto code = static_cast<WarningCode>(number<std::int32_t>(' '));
    const auto count = number<std::int64_t>(' ');
    const auto value = number<double>(' ');
    const auto points = number<std::size_t>(' '), length = number<std::size_t>('\n');
    std::vector<NamedPoint> named;
    for (std::size_t k = 0; k < points; ++k) named.push_back(point(length));
    MessageText message(text(length), std::move(named));
    return {code, std::move(message), count, value};
  }

 private:
  [[noreturn]] static void fail() {
    throw Error(ErrorKind::file, "its warnings cannot be read: it is damaged");
  }

  template <class Number>
  Number number(char end) {
    Number value{};
    const auto read = std::from_chars(rest_.data(), rest_.data() + rest_.size(), value);
    const auto size = static_cast<std::size_t>(read.ptr - rest_.data());
    if (read.ec != std::errc() || size == rest_.size() || rest_[size] != end) fail();
    rest_.remove_prefix(size + 1);
    return value;
  }

  NamedPoint point(std::size_t length) {
    NamedPoint named;
    named.dimension = number<int>(' ');
    named.rounded = number<int>(' ') != 0;
    named.begin = number<std::size_t>(' ');
    named.end = number<std::size_t>(' ');
    for (const std::size_t k : {0, 1, 2}) named.x[k] = number<double>(k < 2 ? ' ' : '\n');
    if (named.begin < last_ || named.end < named.begin || named.end > length) fail();
    last_ = named.end;
    return named;
  }

  std::string text(std::size_t length) {
    last_ = 0;
    if (rest_.size() <= length || rest_[length] != '\n') fail();
    std::string text(rest_.substr(0, length));
    rest_.remove_prefix(length + 1);
    return text;
  }

  std::string_view rest_;
  std::size_t last_ = 0;  // end of the previous point in the message
};

}  // namespace

std::string saved_warnings(std::span<const Warning> warnings) {
  std::string saved;
  for (const Warning& warning : warnings) {
    const std::string& text = warning.message.text();
    const std::vector<NamedPoint>& points = warning.message.points();
    saved += std::to_string(static_cast<std::int32_t>(warning.code)) + " " +
             std::to_string(warning.count) + " " + number_text(warning.value) + " " +
             std::to_string(points.size()) + " " + std::to_string(text.size()) + "\n";
    for (const NamedPoint& point : points)
      saved += std::to_string(point.dimension) + " " + std::to_string(int{point.rounded}) + " " +
               std::to_string(point.begin) + " " + std::to_string(point.end) + " " +
               number_text(point.x[0]) + " " + number_text(point.x[1]) + " " +
               number_text(point.x[2]) + "\n";
    saved += text + "\n";
  }
  return saved;
}

std::vector<Warning> warnings_in(const std::string& saved) {
  std::vector<Warning> warnings;
  for (WarningReader reader(saved); !reader.at_end();) warnings.push_back(reader.next());
  return warnings;
}

}  // namespace pnpbs
