// SPDX-License-Identifier: BSD-3-Clause
// Which facets of a star are elements, and in what order they are handed out.
#include <bit>
#include <cmath>

#include "delaunay/volume/volume_star.hpp"
#include "delaunay/volume/word_of_bits.hpp"

namespace pnpbs {

namespace {

// Sorts by key(value), no two of which are the same. Of a few, it is counted how many are less than
// each, for all side by side: no branch can be guessed wrong.
template <class Value, class Key>
void sort_by(std::vector<Value>& values, const Key& key) {
  const std::size_t n = values.size(), padded = (n + kGroup - 1) & ~(kGroup - 1);
  if (n > kWord) {
    std::sort(values.begin(), values.end(),
              [&](const Value& a, const Value& b) { return key(a) < key(b); });
    return;
  }
  std::array<std::int64_t, kWord> keys{}, less{};
  std::array<Value, kWord> unsorted;
  for (std::size_t k = 0; k < n; ++k) {
    unsorted[k] = values[k];
    keys[k] = key(values[k]);
  }
  for (std::size_t k = 0; k < n; ++k) {
    const std::int64_t own = keys[k];
#pragma omp simd
    for (std::size_t l = 0; l < padded; ++l) less[l] += own < keys[l];
  }
  for (std::size_t k = 0; k < n; ++k) values[static_cast<std::size_t>(less[k])] = unsorted[k];
}

}  // namespace

bool VolumeStar::is_element(const Facet& facet) const {
  const auto& [a, b, c] = facet.corners;
  const VolumeNode &p = candidates_[index(a)], &q = candidates_[index(b)],
                   &r = candidates_[index(c)];
  // What is far from the limit, and not flat, needs no common order of the corners.
  constexpr double kSurelyNotFlat = 1e-4, kMargin = 1e-3;
  const Plane& plane = facet.plane;
  if (plane.offset > kSurelyNotFlat) {
    const double limit = 2 * kMaxRadius * std::min({centre_.d, p.d, q.d, r.d}) * plane.offset;
    const double diameter = unit_ * std::sqrt(dot(plane.normal, plane.normal));
    if (diameter < (1 - kMargin) * limit) return true;
    if (diameter > (1 + kMargin) * limit) return false;
  }
  return pnpbs::is_element(ordered_by_id({centre_, p, q, r}));
}

void VolumeStar::find_neighbours() {
  used_.assign((candidates_.size() + kWord - 1) / kWord, 0);
  for (const Corners& triangle : triangles_)
    for (const std::int32_t k : triangle)
      used_[index(k) / kWord] |= std::uint64_t{1} << (index(k) % kWord);
  neighbours_.clear();
  for (std::size_t w = 0; w < used_.size(); ++w)
    for (std::uint64_t left = used_[w]; left != 0; left &= left - 1)
      neighbours_.push_back(static_cast<std::int32_t>(w * kWord) + std::countr_zero(left));
  sort_by(neighbours_, [this](std::int32_t k) { return candidates_[index(k)].id; });
}

// Three places are sorted as one number; of those that begin with either of them, the smallest
// begins with the least.
void VolumeStar::number_corners() {
  find_neighbours();
  place_.resize(candidates_.size());
  for (std::size_t n = 0; n < neighbours_.size(); ++n)
    place_[index(neighbours_[n])] = static_cast<std::int32_t>(n);
  constexpr int kBits = 21;
  const auto pack = [](std::int64_t a, std::int64_t b, std::int64_t c) {
    return a << 2 * kBits | b << kBits | c;
  };
  packed_.clear();
  for (const Corners& triangle : triangles_) {
    const std::int32_t a = place_[index(triangle[0])], b = place_[index(triangle[1])],
                       c = place_[index(triangle[2])];
    packed_.push_back(std::min({pack(a, b, c), pack(b, c, a), pack(c, a, b)}));
  }
  sort_by(packed_, [](std::int64_t packed) { return packed; });
  const auto place = [](std::int64_t packed, int from_last) {
    constexpr std::int64_t kMask = (std::int64_t{1} << kBits) - 1;
    return static_cast<std::int32_t>(packed >> from_last * kBits & kMask);
  };
  for (std::size_t t = 0; t < packed_.size(); ++t)
    triangles_[t] = {place(packed_[t], 2), place(packed_[t], 1), place(packed_[t], 0)};
}

}  // namespace pnpbs
