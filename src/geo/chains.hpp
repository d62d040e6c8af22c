// SPDX-License-Identifier: BSD-3-Clause
// Edges between places, put in order: curves from where they meet to where they meet.
#pragma once

#include <cstdint>
#include <vector>

#include "geo/outlines.hpp"

namespace pnpbs::geo {

enum class EdgeRole { boundary, inner, line };

struct Edge {
  std::int64_t begin, end;
  EdgeRole role;  // line: not known yet
  std::int32_t tag;
  std::int64_t order;
  bool of_line;
};

// Closed lines that neither meet a polygon nor lie in one bound the domain; the others are inner
// curves. Throws Error where lines branch so that none can tell.
void settle_lines(std::vector<Edge>& edges, const std::vector<Point<2>>& points,
                  const WordsFor& where);

// Every edge is in one of them; they are in the order of their first edges.
std::vector<Curve> chains_of(const std::vector<Edge>& edges, std::int64_t places);

}  // namespace pnpbs::geo
