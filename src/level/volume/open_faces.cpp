// SPDX-License-Identifier: BSD-3-Clause
#include "level/volume/open_faces.hpp"

#include <algorithm>
#include <compare>

namespace pnpbs {

bool has_side(const FaceFan& fan, std::int32_t from, std::int32_t to) {
  return std::ranges::binary_search(fan, FaceSide{from, to});
}

namespace {

// A side packed into one number. The same side in the opposite direction is its neighbour in the
// order.
class PackedSide {
 public:
  PackedSide(std::int32_t from, std::int32_t to)
      : bits_(from < to ? packed(from, to) : packed(to, from) | 1) {}

  bool same_nodes(const PackedSide& other) const { return bits_ >> 1 == other.bits_ >> 1; }
  FaceSide side() const {
    const auto low = static_cast<std::int32_t>(bits_ >> 32),
               high = static_cast<std::int32_t>(bits_ >> 1 & 0x7fffffff);
    return (bits_ & 1) != 0 ? FaceSide{high, low} : FaceSide{low, high};
  }
  auto operator<=>(const PackedSide&) const = default;

 private:
  static std::uint64_t packed(std::int32_t low, std::int32_t high) {
    return static_cast<std::uint64_t>(low) << 32 | static_cast<std::uint64_t>(high) << 1;
  }

  std::uint64_t bits_;
};

// The corners (i, a, b, c) are right-handed, so as seen from outside the order of a face at i is i,
// b, a.
std::vector<PackedSide> sides_around(const Level<3>& level, std::int64_t i) {
  constexpr std::size_t kMostly = 72;  // for 24 tetrahedra
  std::vector<PackedSide> sides;
  sides.reserve(kMostly);
  level.stars.for_simplices(i, [&](const Stars<3>::Corners& others) {
    for (std::size_t k = 0; k < 3; ++k) sides.emplace_back(others[(k + 1) % 3], others[k]);
  });
  std::ranges::sort(sides);
  return sides;
}

}  // namespace

FaceFan open_faces(const Level<3>& level, std::int64_t i) {
  FaceFan open;
  if (level.stars.closed(i)) return open;
  const std::vector<PackedSide> sides = sides_around(level, i);
  for (auto begin = sides.begin(); begin != sides.end();) {
    const auto end = std::find_if_not(
        begin, sides.end(), [&](const PackedSide& side) { return side.same_nodes(*begin); });
    const bool one_way = *begin == *(end - 1);
    for (; begin != end; ++begin)
      if (one_way) open.push_back(begin->side());
  }
  std::ranges::sort(open);
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
