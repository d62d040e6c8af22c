// SPDX-License-Identifier: BSD-3-Clause
// Points and lists of names as messages show them.
#pragma once

#include <array>
#include <charconv>
#include <string>
#include <vector>

#include "base/error.hpp"
#include "base/types.hpp"

namespace pnpbs {

// "(1.5, 2)"
template <std::size_t Dim>
std::string point_text(const std::array<double, Dim>& point) {
  std::string text = "(";
  for (std::size_t k = 0; k < Dim; ++k) text += (k > 0 ? ", " : "") + number_text(point[k]);
  return text + ")";
}

// Four digits, of a number that only shows how large something is.
inline std::string rounded_text(double value) {
  char text[40];
  const auto end =
      std::to_chars(text, text + sizeof text, value, std::chars_format::general, 4).ptr;
  return std::string(text, end);
}

template <int Dim>
std::string rounded_point_text(const Point<Dim>& point) {
  std::string text = "(";
  for (int k = 0; k < Dim; ++k) text += (k > 0 ? ", " : "") + rounded_text(point[k]);
  return text + ")";
}

// The first few names, and how many more there are: "a, b, c and 4 more".
inline std::string list_text(const std::vector<std::string>& names, std::size_t at_most = 3) {
  std::string text;
  for (std::size_t i = 0; i < names.size() && i < at_most; ++i) {
    if (i > 0) text += ", ";
    text += names[i];
  }
  if (names.size() > at_most) text += " and " + std::to_string(names.size() - at_most) + " more";
  return text;
}

}  // namespace pnpbs
