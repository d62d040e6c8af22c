// SPDX-License-Identifier: BSD-3-Clause
// Random damage to files. The result depends on the seed only and not on the standard library.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <cstdlib>
#include <random>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

// Returns the integer in an environment variable, or `otherwise` if it is not set. Users can choose
// the amount and the seed of the damage with it.
inline std::uint64_t from_environment(const char* name, std::uint64_t otherwise) {
  const char* text = std::getenv(name);
  return text ? std::strtoull(text, nullptr, 10) : otherwise;
}

class Damage {
 public:
  explicit Damage(std::uint64_t seed) : random_(seed) {}

  std::string to(std::string text) {
    for (std::size_t hits = 1 + below(6) / 4; hits > 0; --hits) text = hit(std::move(text));
    return text;
  }

  // Returns the bytes of a binary file with damage.
  std::string to_bytes(std::string bytes) {
    for (std::size_t hits = 1 + below(6) / 4; hits > 0; --hits) bytes = hit_bytes(std::move(bytes));
    return bytes;
  }

 private:
  // The numbers of std::uniform_int_distribution differ between standard libraries.
  std::size_t below(std::size_t n) { return static_cast<std::size_t>(random_() % n); }

  std::string hit(std::string text) {
    if (text.empty()) return text;
    switch (below(10)) {
      case 0:
        text[below(text.size())] ^= static_cast<char>(1U << below(8));
        return text;
      case 1:
        text[below(text.size())] = static_cast<char>(below(256));
        return text;
      case 2:
        return text.substr(0, below(text.size()));
      case 3:
        return with_lines_damaged(text);
      case 4:
      case 5:
      case 6:
        return with_a_number_replaced(text);
      default:
        return with_a_digit_replaced(text);
    }
  }

  std::string hit_bytes(std::string bytes) {
    if (bytes.empty()) return bytes;
    const std::size_t begin = below(bytes.size());
    switch (below(6)) {
      case 0:
        bytes[begin] ^= static_cast<char>(1U << below(8));
        return bytes;
      case 1:
        bytes[begin] = static_cast<char>(below(256));
        return bytes;
      case 2:
        return bytes.substr(0, begin);
      case 3:
        return bytes.erase(begin, 1 + below(100));
      case 4:
        return bytes.insert(below(bytes.size()), bytes.substr(begin, 1 + below(100)));
      default:
        return with_an_extreme(std::move(bytes), begin);
    }
  }

  // Replaces four bytes by an extreme integer or float, an infinity or NaN.
  std::string with_an_extreme(std::string bytes, std::size_t begin) {
    static constexpr std::array<std::uint32_t, 9> extremes{
        0, 1, 0x7fffffff, 0x80000000, 0xffffffff, 0x7f800000, 0xff800000, 0x7fc00000, 0x7f7fffff};
    std::uint32_t bits = extremes[below(extremes.size())];
    // Position of the count in an STL file.
    if (below(4) == 0) begin = bytes.size() > 80 ? 80 : 0;
    for (std::size_t k = begin; k < std::min(begin + 4, bytes.size()); ++k, bits >>= 8)
      bytes[k] = static_cast<char>(bits & 0xff);
    return bytes;
  }

  std::string with_lines_damaged(const std::string& text) {
    std::vector<std::string> lines;
    std::istringstream stream(text);
    for (std::string line; std::getline(stream, line);) lines.push_back(line);
    if (lines.empty()) return text;
    const std::size_t a = below(lines.size()), b = below(lines.size());
    const auto at = [&lines](std::size_t i) {
      return lines.begin() + static_cast<std::ptrdiff_t>(i);
    };
    switch (below(3)) {
      case 0:
        lines.erase(at(a));
        break;
      case 1:
        lines.insert(at(b), std::string(lines[a]));
        break;
      default:
        std::swap(lines[a], lines[b]);
    }
    std::string result;
    for (const std::string& line : lines) result += line + "\n";
    return result;
  }

  std::string with_a_number_replaced(std::string text) {
    static constexpr std::array words{"nan",
                                      "-nan",
                                      "inf",
                                      "-inf",
                                      "1e308",
                                      "-1e308",
                                      "1e-308",
                                      "-1",
                                      "0",
                                      "1",
                                      "2",
                                      "3",
                                      "0.5",
                                      "1e16",
                                      "7e22",
                                      "",
                                      "x",
                                      "1e",
                                      "-",
                                      "0x10",
                                      "1,5",
                                      "4294967296",
                                      "9223372036854775807",
                                      "9223372036854775808",
                                      "99999999999999999999999999",
                                      "1e400",
                                      "0.1 0.2"};
    const char* const digits = "0123456789.-e";
    const std::size_t begin = text.find_first_of(digits, below(text.size()));
    if (begin == std::string::npos) return text;
    const std::size_t end = std::min(text.find_first_not_of(digits, begin), text.size());
    return text.replace(begin, end - begin, words[below(words.size())]);
  }

  // This is mostly valid for the format, but not for the geometry.
  std::string with_a_digit_replaced(std::string text) {
    const std::size_t at = text.find_first_of("0123456789", below(text.size()));
    if (at != std::string::npos) text[at] = static_cast<char>('0' + below(10));
    return text;
  }

  std::mt19937_64 random_;
};
