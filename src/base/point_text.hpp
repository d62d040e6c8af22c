// SPDX-License-Identifier: BSD-3-Clause
// Points and lists of names as messages show them.
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

// "(1.5, 2)", which is known as a point to the message that it becomes a part of.
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

template <std::size_t Dim>
MessageText point_text(const std::array<double, Dim>& point) {
  return text_of_point(point, false, number_text);
}

// Four digits, of a number that only shows how large something is.
inline std::string rounded_text(double value) {
  char text[40];
  const auto end =
      std::to_chars(text, text + sizeof text, value, std::chars_format::general, 4).ptr;
  return std::string(text, end);
}

template <int Dim>
MessageText rounded_point_text(const Point<Dim>& point) {
  return text_of_point(point, true, rounded_text);
}

// Of a point on the Earth. Seven digits after the decimal point are a centimetre.
inline std::string degrees_text(const Point<2>& degrees) {
  const auto rounded = [](double value) { return number_text(std::round(value * 1e7) / 1e7); };
  return "longitude " + rounded(degrees[0]) + ", latitude " + rounded(degrees[1]);
}

// The first few names, and how many more there are: "a, b, c and 4 more".
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
