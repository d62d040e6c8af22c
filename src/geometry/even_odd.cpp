// SPDX-License-Identifier: BSD-3-Clause
#include "geometry/even_odd.hpp"

#include "base/index.hpp"

namespace pnpbs {

std::vector<char> inside_by_parity(std::size_t regions,
                                   const std::vector<RegionContact>& contacts) {
  struct Way {
    std::int32_t to;
    bool crosses;
  };
  std::vector<std::vector<Way>> ways(regions);
  for (const auto& [a, b, crosses] : contacts) {
    ways[index(a)].push_back({b, crosses});
    ways[index(b)].push_back({a, crosses});
  }
  std::vector<char> inside(regions, 2);  // The value 2 marks regions that are not reached yet.
  inside[0] = 0;
  std::vector<std::int32_t> reached{0};
  while (!reached.empty()) {
    const std::int32_t region = reached.back();
    reached.pop_back();
    for (const Way& way : ways[index(region)]) {
      if (inside[index(way.to)] != 2) continue;
      inside[index(way.to)] = static_cast<char>((inside[index(region)] != 0) != way.crosses);
      reached.push_back(way.to);
    }
  }
  return inside;
}

}  // namespace pnpbs
