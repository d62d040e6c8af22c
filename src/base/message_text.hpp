// SPDX-License-Identifier: BSD-3-Clause
// Text of a message together with the points that it names. The points are data, so that code that
// has the chart of a sphere or a projection can replace them by longitude and latitude without
// parsing the text.
#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <string>
#include <utility>
#include <vector>

namespace pnpbs {

// A point that a message names, and the bytes [begin, end) of the text that show it.
struct NamedPoint {
  std::array<double, 3> x{};  // only the first `dimension` entries are used
  int dimension = 0;
  bool rounded = false;  // the text shows rounded coordinates; x is exact
  std::size_t begin = 0, end = 0;
};

// A text and the points in it. Concatenation keeps both consistent.
class MessageText {
 public:
  MessageText() = default;
  MessageText(std::string text) : text_(std::move(text)) {}  // NOLINT: implicit, for a + b
  MessageText(const char* text) : text_(text) {}             // NOLINT: likewise
  MessageText(std::string text, std::vector<NamedPoint> points)
      : text_(std::move(text)), points_(std::move(points)) {}

  const std::string& text() const { return text_; }
  const std::vector<NamedPoint>& points() const { return points_; }
  bool empty() const { return text_.empty(); }

  MessageText& operator+=(const MessageText& more) {
    for (NamedPoint point : more.points_) {
      point.begin += text_.size();
      point.end += text_.size();
      points_.push_back(point);
    }
    text_ += more.text_;
    return *this;
  }
  friend MessageText operator+(MessageText a, const MessageText& b) {
    a += b;
    return a;
  }

 private:
  std::string text_;
  std::vector<NamedPoint> points_;  // in the order of the text
};

// Returns the message with the text of each named point replaced by words(point, old_text). The
// points of the result are moved(point).
template <class Words, class Moved>
MessageText with_points_replaced(const MessageText& message, const Words& words,
                                 const Moved& moved) {
  MessageText result;
  std::size_t at = 0;
  for (const NamedPoint& point : message.points()) {
    result += message.text().substr(at, point.begin - at);
    const std::string text =
        words(point, message.text().substr(point.begin, point.end - point.begin));
    NamedPoint told = moved(point);
    told.begin = 0;
    told.end = text.size();
    result += MessageText(text, {told});
    at = point.end;
  }
  result += message.text().substr(at);
  return result;
}

// Returns the message in the form that callers see. The tests link another function here, which
// rewrites the words, to show that no code depends on them (tests/tool/wording.cpp).
MessageText as_worded(MessageText message);

}  // namespace pnpbs
