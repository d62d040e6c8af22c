// SPDX-License-Identifier: BSD-3-Clause
// Places in the plane in the texts of messages, "(1.5, 2)", as point_text writes them.
#pragma once

#include <charconv>
#include <cmath>
#include <optional>
#include <string>
#include <string_view>

#include "base/error.hpp"
#include "base/types.hpp"

namespace pnpbs {

// "x, y)", and where in the text that ends.
struct PlaceInText {
  Point<2> point;
  std::size_t end;
};

inline std::optional<PlaceInText> place_in(const std::string& text, std::size_t begin) {
  PlaceInText place{};
  const char* at = text.data() + begin;
  const char* const end = text.data() + text.size();
  for (const std::size_t k : {std::size_t{0}, std::size_t{1}}) {
    const auto read = std::from_chars(at, end, place.point[k]);
    const std::string_view behind = k == 0 ? ", " : ")";
    if (read.ec != std::errc() || !std::string_view(read.ptr, end).starts_with(behind))
      return std::nullopt;
    at = read.ptr + behind.size();
  }
  place.end = static_cast<std::size_t>(at - text.data());
  return place;
}

// The text with words(point, "(x, y)") for each place in it.
template <class Words>
std::string with_places(const std::string& text, const Words& words) {
  std::string result;
  std::size_t at = 0;
  for (std::size_t begin; (begin = text.find('(', at)) != std::string::npos;) {
    const auto place = place_in(text, begin + 1);
    result.append(text, at, begin - at);
    at = place ? place->end : begin + 1;
    const std::string here = text.substr(begin, at - begin);
    result += place ? words(place->point, here) : here;
  }
  result.append(text, at);
  return result;
}

// Of a place on the Earth. Seven digits after the point are a centimetre.
inline std::string degrees_text(const Point<2>& degrees) {
  const auto rounded = [](double value) { return number_text(std::round(value * 1e7) / 1e7); };
  return "longitude " + rounded(degrees[0]) + ", latitude " + rounded(degrees[1]);
}

}  // namespace pnpbs
