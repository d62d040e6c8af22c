// SPDX-License-Identifier: BSD-3-Clause
// Bytes in a row, raw or as base64 (RFC 4648) with blanks anywhere. Of the latter parts may be
// padded each for itself.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>

namespace pnpbs {

class ByteSource {
 public:
  // Keeps a reference to the bytes.
  ByteSource(std::string_view bytes, bool is_raw) : rest_(bytes), is_raw_(is_raw) {}

  // False if there are not so many.
  bool take(std::size_t count, std::string& bytes);
  // No more than this can be taken.
  std::size_t room() const { return is_raw_ ? rest_.size() : held_.size() + rest_.size(); }

 private:
  bool decode();

  std::string_view rest_;
  bool is_raw_;
  std::string held_;  // decoded and not taken yet
};

}  // namespace pnpbs
