// SPDX-License-Identifier: BSD-3-Clause
// Text of points and of lists of names in messages.
#pragma once

#include <array>
#include <charconv>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include "base/error.hpp"
#include "base/types.hpp"

namespace pnpbs {

// Returns a text such as "(1.5, 2)", with the point attached as data. number(x) gives the text of a
// coordinate.
template <std::size_t Dim, class NumberText>
MessageText text_of_point(const std::array<double, Dim>& point, bool rounded,
                          const NumberText& number) {
  static_assert(Dim == 2 || Dim == 3);
  NamedPoint named;
  named.dimension = static_cast<int>(Dim);
  named.rounded = rounded;
  std::string text = "(";
  for (std::size_t k = 0; k < Dim; ++k) {
    named.x[k] = point[k];
    text += (k > 0 ? ", " : "") + number(point[k]);
  }
  text += ")";
  named.end = text.size();
  return {std::move(text), {named}};
}

// Returns the text of a point with all digits.
template <std::size_t Dim>
MessageText point_text(const std::array<double, Dim>& point) {
  return text_of_point(point, false, number_text);
}

// Returns the number with four digits, for messages that show only a magnitude. Eastings and
// northings in metres are whole numbers.
inline std::string rounded_text(double value) {
  char text[40];
  const bool whole = std::abs(value) >= 1e4 && std::abs(value) < 1e8;
  const auto end =
      whole ? std::to_chars(text, text + sizeof text, value, std::chars_format::fixed, 0)
            : std::to_chars(text, text + sizeof text, value, std::chars_format::general, 4);
  return std::string(text, end.ptr);
}

// Returns the text of a point with rounded coordinates.
template <int Dim>
MessageText rounded_point_text(const Point<Dim>& point) {
  return text_of_point(point, true, rounded_text);
}

// Returns the text of a point on the Earth. Seven digits after the decimal point resolve a
// centimetre.
inline std::string degrees_text(const Point<2>& degrees) {
  const auto rounded = [](double value) { return number_text(std::round(value * 1e7) / 1e7); };
  return "longitude " + rounded(degrees[0]) + ", latitude " + rounded(degrees[1]);
}

// Returns the first names and the number of the others: "a, b, c and 4 more".
template <class Text>
Text list_text(const std::vector<Text>& names, std::size_t at_most = 3) {
  Text text;
  for (std::size_t i = 0; i < names.size() && i < at_most; ++i) {
    if (i > 0) text += ", ";
    text += names[i];
  }
  if (names.size() > at_most) text += " and " + std::to_string(names.size() - at_most) + " more";
  return text;
}

}  // namespace pnpbs
