// SPDX-License-Identifier: BSD-3-Clause
// Replaces base/message_wording.cpp in a variant of the library: all letters of messages become x,
// except those of points. The behaviour of the command must not change (test_wording.py).
#include <cctype>

#include "base/message_text.hpp"

namespace pnpbs {

MessageText as_worded(MessageText message) {
  std::string text = message.text();
  auto point = message.points().begin();
  for (std::size_t k = 0; k < text.size(); ++k) {
    while (point != message.points().end() && k >= point->end) ++point;
    const bool in_point = point != message.points().end() && k >= point->begin;
    if (!in_point && std::isalpha(static_cast<unsigned char>(text[k])) != 0) text[k] = 'x';
  }
  return {std::move(text), message.points()};
}

}  // namespace pnpbs
