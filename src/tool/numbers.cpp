// SPDX-License-Identifier: BSD-3-Clause
#include "tool/numbers.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>

namespace pnpbs::tool {

std::string grouped(std::int64_t count) {
  std::string digits = std::to_string(count);
  for (int at = static_cast<int>(digits.size()) - 3; at > (count < 0); at -= 3) {
    digits.insert(static_cast<std::size_t>(at), 1, ' ');
  }
  return digits;
}

std::string short_number(double value, int digits) {
  char text[48];
  const auto end =
      std::to_chars(text, text + sizeof text, value, std::chars_format::general, digits);
  return {text, end.ptr};
}

std::string measure(double value) {
  if (!(value >= 1e4 && value < 1e9)) return short_number(value, 4);
  return grouped(static_cast<std::int64_t>(std::round(value)));
}

std::string size_in_bytes(double bytes) {
  const char* const units[] = {" bytes", " KiB", " MiB", " GiB", " TiB"};
  int unit = 0;
  for (; bytes >= 1000 && unit < 4; ++unit) bytes /= 1024;
  return short_number(bytes, 3) + units[unit];
}

std::string duration(double seconds) {
  if (!(seconds >= 0 && seconds < 1e9)) return "?";
  if (seconds < 9.95) return short_number(seconds, 2) + " s";
  const auto whole = static_cast<std::int64_t>(std::round(seconds));
  if (whole < 60) return std::to_string(whole) + " s";
  if (whole < 3600) return std::to_string(whole / 60) + " min " + std::to_string(whole % 60) + " s";
  return std::to_string(whole / 3600) + " h " + std::to_string(whole % 3600 / 60) + " min";
}

std::optional<std::vector<double>> numbers_between_commas(const std::string& text) {
  std::vector<double> numbers;
  for (std::size_t begin = 0; begin <= text.size();) {
    const std::size_t end = std::min(text.find(',', begin), text.size());
    const std::size_t first = std::min(text.find_first_not_of(" \t", begin), end);
    const std::size_t last = text.find_last_not_of(" \t", end - 1);
    const char* from = text.data() + first + (first < end && text[first] == '+');
    const char* to = text.data() + (first < end ? last + 1 : end);
    double value = 0;
    const auto result = std::from_chars(from, to, value);
    if (result.ec != std::errc() || result.ptr != to || !std::isfinite(value)) return std::nullopt;
    numbers.push_back(value);
    begin = end + 1;
  }
  return numbers;
}

}  // namespace pnpbs::tool
