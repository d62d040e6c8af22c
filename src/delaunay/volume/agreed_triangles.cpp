// SPDX-License-Identifier: BSD-3-Clause
#include "delaunay/volume/agreed_triangles.hpp"

#include <algorithm>

#include "base/space_vectors.hpp"

namespace pnpbs {

// Returns whether `node` finds the triangle (node, a, b). A node whose ring has not been found yet
// counts as finding it.
bool AgreedTriangles::found_by(std::int32_t node, std::int64_t a, std::int64_t b) const {
  if (rings_.needs(node) > 0) return true;
  const std::size_t n = rings_.size(node);
  for (std::size_t k = 0; k < n; ++k) {
    const SurfaceRings::Entry entry = rings_.at(node, k);
    if (entry.triangle && entry.node == a && rings_.at(node, (k + 1) % n).node == b) return true;
  }
  return false;
}

bool AgreedTriangles::is_agreed(std::int64_t i, std::size_t k) const {
  const std::int32_t a = rings_.at(i, k).node, b = rings_.at(i, (k + 1) % rings_.size(i)).node;
  return found_by(a, b, i) && found_by(b, i, a);
}

// Finds the runs of triangles that node i finds and other corners do not.
void AgreedTriangles::find_gaps(std::int64_t i, std::vector<Gap>& gaps) const {
  gaps.clear();
  const std::size_t n = rings_.size(i);
  const auto open = [&](std::size_t k) { return rings_.at(i, k).triangle && !is_agreed(i, k); };
  for (std::size_t k = 0; k < n; ++k) {
    if (!open(k) || open((k + n - 1) % n)) continue;
    std::size_t end = (k + 1) % n;
    while (open(end)) end = (end + 1) % n;
    gaps.push_back({k, end});
  }
}

// Returns the corner of the hole that follows `node` if `from` precedes it, or -1 if none exists.
std::int32_t AgreedTriangles::next_around_hole(std::int32_t node, std::int64_t from) {
  find_gaps(node, gaps_there_);
  for (const Gap& gap : gaps_there_)
    if (rings_.at(node, gap.end).node == from) return rings_.at(node, gap.begin).node;
  return -1;
}

bool AgreedTriangles::walk_around_hole(std::int64_t i, const Gap& gap) {
  hole_.assign(1, static_cast<std::int32_t>(i));
  std::int32_t here = rings_.at(i, gap.begin).node;
  while (here != i) {
    if (hole_.size() == kMaxHole) return false;
    const std::int32_t from = hole_.back();
    hole_.push_back(here);
    here = next_around_hole(here, from);
    if (here < 0) return false;
  }
  return hole_.size() >= 3 && hole_.back() == rings_.at(i, gap.end).node;
}

void AgreedTriangles::begin_with_least_id() {
  const auto least =
      std::ranges::min_element(hole_, {}, [this](std::int32_t node) { return nodes_.id(node); });
  std::rotate(hole_.begin(), least, hole_.end());
}

Point<3> AgreedTriangles::hole_normal() const {
  const Point<3> first = nodes_.position(hole_[0]);
  Point<3> normal{};
  for (std::size_t k = 1; k + 1 < hole_.size(); ++k)
    normal = shifted(normal, 1,
                     cross(difference(nodes_.position(hole_[k]), first),
                           difference(nodes_.position(hole_[k + 1]), first)));
  return normal;
}

// Returns the quality of the triangle at corner k of the hole: its area over the sum of its squared
// sides, negative if it is turned over.
double AgreedTriangles::ear_quality(std::size_t k, const Point<3>& normal) const {
  const std::size_t n = hole_.size();
  const Point<3> a = nodes_.position(hole_[(k + n - 1) % n]), b = nodes_.position(hole_[k]),
                 c = nodes_.position(hole_[(k + 1) % n]);
  const Point<3> area = cross(difference(b, a), difference(c, a));
  const double sides =
      squared_distance<3>(a, b) + squared_distance<3>(b, c) + squared_distance<3>(c, a);
  return (dot(area, normal) < 0 ? -length(area) : length(area)) / sides;
}

void AgreedTriangles::add_with(std::int64_t i, const std::array<std::int32_t, 3>& triangle,
                               std::vector<Others>& triangles) const {
  for (std::size_t k = 0; k < 3; ++k)
    if (triangle[k] == i) triangles.push_back({triangle[(k + 1) % 3], triangle[(k + 2) % 3]});
}

// Cuts the best ear first. Of equal ears, the first after the corner with the smallest id is cut.
void AgreedTriangles::cut_ears(std::int64_t i, std::vector<Others>& triangles) {
  begin_with_least_id();
  const Point<3> normal = hole_normal();
  while (hole_.size() >= 3) {
    const std::size_t n = hole_.size();
    std::size_t best = 0;
    double quality = ear_quality(0, normal);
    for (std::size_t k = 1; k < n; ++k) {
      const double here = ear_quality(k, normal);
      if (here <= quality) continue;
      quality = here;
      best = k;
    }
    add_with(i, {hole_[(best + n - 1) % n], hole_[best], hole_[(best + 1) % n]}, triangles);
    hole_.erase(hole_.begin() + static_cast<std::ptrdiff_t>(best));
  }
}

void AgreedTriangles::of(std::int64_t i, std::vector<Others>& triangles) {
  triangles.clear();
  const std::size_t n = rings_.size(i);
  for (std::size_t k = 0; k < n; ++k)
    if (rings_.at(i, k).triangle && is_agreed(i, k))
      triangles.push_back({rings_.at(i, k).node, rings_.at(i, (k + 1) % n).node});
  find_gaps(i, gaps_);
  for (const Gap& gap : gaps_)
    if (walk_around_hole(i, gap)) cut_ears(i, triangles);
}

}  // namespace pnpbs
