// SPDX-License-Identifier: BSD-3-Clause
// Text of a message together with the points that it names, as data: who knows the chart of a
// sphere or a projection can then tell longitude and latitude without parsing the text.
#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <string>
#include <utility>
#include <vector>

namespace pnpbs {

// A point that a message names, and the bytes [begin, end) of the text that name it.
struct NamedPoint {
  std::array<double, 3> x{};  // the first `dimension` of them
  int dimension = 0;
  bool rounded = false;  // in the text; x is not
  std::size_t begin = 0, end = 0;
};

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

// Returns the message with the text words(point, text) in the place of each named point. The points
// of the result are those of moved(point).
template <class Words, class Moved>
MessageText with_points_told(const MessageText& message, const Words& words, const Moved& moved) {
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

// Returns the message as it is handed out. A library of the tests has another function here, which
// rewrites the words, to show that they decide nothing (tests/tool/wording.cpp).
MessageText as_worded(MessageText message);

}  // namespace pnpbs
