// SPDX-License-Identifier: BSD-3-Clause
// Places where d does not resolve the boundary, as warnings name the worst of them.
#pragma once

#include <algorithm>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "base/point_text.hpp"
#include "base/warning.hpp"
#include "sphere/embedding.hpp"

namespace pnpbs {

inline constexpr std::size_t kNamedWorst = 3;

struct Worst {
  double ratio;
  std::int32_t which;
  double distance, spacing;
  Point<2> at{};
  bool operator<(const Worst& other) const {
    return std::pair(ratio, which) < std::pair(other.ratio, other.which);
  }
};

// name(which); in the chart of a sphere, lengths are told along the sphere, and places as well: who
// takes coasts from files does not know which curve is which.
template <class Name>
MessageText worst_text(std::vector<Worst>& all, const char* length, const Embedding<2>& embedding,
                       const Name& name) {
  std::sort(all.begin(), all.end());
  std::vector<MessageText> names;
  for (const Worst& worst : all) {
    if (names.size() == kNamedWorst) break;
    const auto measured = [&](double chart_length) {
      return rounded_text(embedding.measured_length(worst.at, chart_length));
    };
    names.push_back(name(worst.which) + " (" + length + " " + measured(worst.distance) +
                    ", spacing " + measured(worst.spacing) +
                    (embedding.is_sphere() ? ", at " + point_text(worst.at) : MessageText()) + ")");
  }
  return list_text(names, kNamedWorst);
}

// The warning `begin`, the worst of all, `end`.
template <class Name>
Warning warning_of_worst(WarningCode code, const std::string& begin, std::vector<Worst>& all,
                         const char* length, const Embedding<2>& embedding, const Name& name,
                         const std::string& end = "") {
  MessageText text = begin + worst_text(all, length, embedding, name) + end;
  return {code, std::move(text), std::ssize(all), all.front().ratio};
}

// Where many of all edges of the boundary are short, no d makes a better mesh of it.
inline std::string advice_on_short_edges(std::size_t count, std::size_t edges) {
  constexpr std::size_t kSome = 100, kPart = 10;
  if (count < kSome || kPart * count < edges) return "";
  return ". That is much of the boundary, which has " + std::to_string(edges) +
         " edges: nodes and triangles beside it cannot follow d; leave out vertices (simplify), "
         "set the angle that makes a corner (corner_angle), or use a smaller d";
}

}  // namespace pnpbs
