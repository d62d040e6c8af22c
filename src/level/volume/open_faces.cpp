// SPDX-License-Identifier: BSD-3-Clause
#include "level/volume/open_faces.hpp"

#include <algorithm>

namespace pnpbs {

bool has_side(const FaceFan& fan, std::int32_t from, std::int32_t to) {
  return std::ranges::binary_search(fan, FaceSide{from, to});
}

FaceFan open_faces(const Level<3>& level, std::int64_t i) {
  FaceFan all, open;
  if (level.stars.closed(i)) return open;
  // (i, a, b, c) turns right-handed: from outside, its faces with i turn as i, b, a.
  level.stars.for_simplices(i, [&](const Stars<3>::Corners& others) {
    for (std::size_t k = 0; k < 3; ++k) all.emplace_back(others[(k + 1) % 3], others[k]);
  });
  std::ranges::sort(all);
  for (const auto& [a, b] : all)
    if (!has_side(all, b, a)) open.emplace_back(a, b);
  return open;
}

std::int64_t disks_of(const FaceFan& fan) {
  for (std::size_t k = 1; k < fan.size(); ++k)
    if (fan[k].first == fan[k - 1].first) return 0;
  std::vector<char> walked(fan.size(), 0);
  std::int64_t disks = 0;
  for (std::size_t first = 0; first < fan.size(); ++first) {
    if (walked[first] != 0) continue;
    std::size_t at = first;
    do {
      walked[at] = 1;
      const auto next = std::ranges::lower_bound(fan, FaceSide{fan[at].second, -1});
      if (next == fan.end() || next->first != fan[at].second) return 0;
      at = static_cast<std::size_t>(next - fan.begin());
    } while (walked[at] == 0);
    if (at != first) return 0;
    ++disks;
  }
  return disks;
}

}  // namespace pnpbs
