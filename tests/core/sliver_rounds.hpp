// SPDX-License-Identifier: BSD-3-Clause
// Rounds of the sliver repair, on one rank and on two.
#pragma once

#include <vector>

#include "quality/volume/sliver_repair.hpp"

inline constexpr pnpbs::SliverRule kSlivers{33};

inline std::int64_t one_round(pnpbs::SliverRepair& repair, std::int64_t round) {
  repair.draw(round);
  return repair.move();
}

inline std::vector<pnpbs::SliverDraw> all_draws(const pnpbs::SliverRepair& repair) {
  std::vector<pnpbs::SliverDraw> draws;
  for (const std::int32_t corner : repair.drawn_corners()) {
    const std::vector<pnpbs::SliverDraw> more = repair.draws_of(corner);
    draws.insert(draws.end(), more.begin(), more.end());
  }
  return draws;
}

// Draws in both repairs, and gives each the draws of the other.
inline void draw_on_both(pnpbs::SliverRepair& a, pnpbs::SliverRepair& b, std::int64_t round) {
  a.draw(round);
  b.draw(round);
  const std::vector<pnpbs::SliverDraw> of_a = all_draws(a), of_b = all_draws(b);
  a.take(of_b);
  b.take(of_a);
}
