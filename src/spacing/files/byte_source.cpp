// SPDX-License-Identifier: BSD-3-Clause
#include "spacing/files/byte_source.hpp"

#include <algorithm>
#include <cstdint>

#include "spacing/files/xml_tags.hpp"

namespace pnpbs {

namespace {

// Of a letter; -1 if it is none.
int value_in_base64(char c) {
  if (c >= 'A' && c <= 'Z') return c - 'A';
  if (c >= 'a' && c <= 'z') return c - 'a' + 26;
  if (c >= '0' && c <= '9') return c - '0' + 52;
  return c == '+' ? 62 : c == '/' ? 63 : -1;
}

}  // namespace

bool ByteSource::take(std::size_t count, std::string& bytes) {
  if (count > room()) return false;
  bytes.clear();
  bytes.reserve(count);
  if (is_raw_) {
    bytes = rest_.substr(0, count);
    rest_.remove_prefix(count);
    return true;
  }
  while (bytes.size() < count) {
    if (held_.empty() && !decode()) return false;
    const std::size_t part = std::min(count - bytes.size(), held_.size());
    bytes += held_.substr(0, part);
    held_.erase(0, part);
  }
  return true;
}

// Four letters are up to three bytes.
bool ByteSource::decode() {
  std::uint32_t bits = 0;
  int letters = 0, padding = 0;
  while (letters < 4) {
    if (rest_.empty()) return false;
    const char c = rest_.front();
    rest_.remove_prefix(1);
    if (kXmlBlanks.find(c) != std::string_view::npos) continue;
    const int value = value_in_base64(c);
    if (c == '=')
      ++padding;
    else if (value < 0 || padding > 0)
      return false;
    bits = bits << 6 | static_cast<std::uint32_t>(std::max(value, 0));
    ++letters;
  }
  for (int k = 0; k < 3 - padding; ++k) held_ += static_cast<char>(bits >> (16 - 8 * k));
  return padding < 3;
}

}  // namespace pnpbs
