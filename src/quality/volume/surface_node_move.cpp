// SPDX-License-Identifier: BSD-3-Clause
#include "quality/volume/surface_node_move.hpp"

#include <algorithm>
#include <iterator>
#include <limits>

namespace pnpbs {

namespace {

template <class T>
void sort_unique(std::vector<T>& values) {
  std::sort(values.begin(), values.end());
  values.erase(std::unique(values.begin(), values.end()), values.end());
}

}  // namespace

SurfaceNodeMove::SurfaceNodeMove(const Nodes<3>& nodes, const StarChanges& stars, std::int32_t node,
                                 const InDomain& in_domain)
    : nodes_(nodes),
      stars_(stars),
      in_domain_(in_domain),
      near_{node},
      change_{node, nodes.position(node), {}, {}} {
  constexpr int kRings = 3;
  for (int ring = 0; ring < kRings; ++ring) {
    two_rings_ = near_;
    for (const std::int32_t i : two_rings_) {
      stars.count_if_unknown(i);
      stars.for_neighbours(i,
                           [&](std::int64_t j) { near_.push_back(static_cast<std::int32_t>(j)); });
    }
    sort_unique(near_);
  }
}

// The tetrahedra of the domain that node i makes with those near while the node that goes is at x;
// and all neighbours, on the far side of the surface, too.
void SurfaceNodeMove::add_star(std::int32_t i, const Point<3>& x, std::vector<Found>& found_there,
                               std::vector<std::int32_t>* neighbours) const {
  static thread_local VolumeStar star;
  star.start(node_at(i, x));
  std::vector<std::int32_t> candidates;
  for (const std::int32_t j : near_) {
    if (j == i) continue;
    candidates.push_back(j);
    star.add(node_at(j, x));
  }
  star.wrap(std::numeric_limits<double>::infinity());  // no other node is meant to matter
  star.finish([&](const VolumeStar::Corners& corners) {
    TetrahedronNodes t{i};
    std::array<std::int64_t, 4> nodes{i};
    Tetrahedron at{star.centre()};
    for (std::size_t k = 0; k < 3; ++k) {
      nodes[k + 1] = t[k + 1] = candidates[static_cast<std::size_t>(corners[k])];
      at[k + 1] = star.candidates()[static_cast<std::size_t>(corners[k])];
    }
    if (neighbours != nullptr) neighbours->insert(neighbours->end(), t.begin() + 1, t.end());
    if (in_domain_(nodes, at)) found_there.push_back(found(t));
    return true;
  });
}

// Of these nodes together. A tetrahedron must be in the stars of all its corners among them.
bool SurfaceNodeMove::make_stars(const std::vector<std::int32_t>& centres, const Point<3>& x,
                                 std::vector<Found>& found_there) const {
  for (const std::int32_t i : centres) add_star(i, x, found_there, nullptr);
  std::sort(found_there.begin(), found_there.end());
  for (auto first = found_there.begin(); first != found_there.end();) {
    const auto last = std::upper_bound(first, found_there.end(), *first);
    const auto corners = std::count_if(
        first->by_id.begin(), first->by_id.end(),
        [&](std::int32_t i) { return std::binary_search(centres.begin(), centres.end(), i); });
    if (last - first != corners) return false;
    first = last;
  }
  found_there.erase(std::unique(found_there.begin(), found_there.end()), found_there.end());
  return true;
}

std::vector<SurfaceNodeMove::Found> SurfaceNodeMove::stars_there(
    const std::vector<std::int32_t>& centres) const {
  std::vector<Found> there;
  for (const std::int32_t i : centres) stars_.count_if_unknown(i);
  for (const std::int32_t i : centres)
    stars_.for_simplices(i, [&](const StarChanges::Corners& c) {
      there.push_back(found({i, c[0], c[1], c[2]}));
    });
  sort_unique(there);
  return there;
}

void SurfaceNodeMove::go_to(const Point<3>& x, std::int32_t on) {
  change_ = {change_.node, x, {}, {}, on};
  std::vector<Found> before, after;
  centres_.assign(1, change_.node);
  add_star(change_.node, nodes_.position(change_.node), before, &centres_);
  add_star(change_.node, x, after, &centres_);
  std::erase_if(centres_,
                [&](std::int32_t i) {  // on the far side of a gap, far away within the body
                  return !std::binary_search(two_rings_.begin(), two_rings_.end(), i);
                });
  stars_.for_neighbours(change_.node,
                        [&](std::int64_t j) { centres_.push_back(static_cast<std::int32_t>(j)); });
  sort_unique(centres_);
  there_ = stars_there(centres_);
  for (const Found& t : there_) change_.gone.push_back(t.oriented);
  for (const Found& t : after) change_.made.push_back(t.oriented);
}

bool SurfaceNodeMove::complete() {
  std::vector<Found> before, after;
  if (!make_stars(centres_, nodes_.position(change_.node), before) || before != there_)
    return false;
  if (!make_stars(centres_, change_.x, after)) return false;
  change_.gone.clear();
  change_.made.clear();
  const auto moves_along = [&](const Found& t) {
    return std::find(t.by_id.begin(), t.by_id.end(), change_.node) != t.by_id.end();
  };
  const auto differing = [&](const std::vector<Found>& of, const std::vector<Found>& others,
                             std::vector<TetrahedronNodes>& changed) {
    for (const Found& t : of)
      if (moves_along(t) || !std::binary_search(others.begin(), others.end(), t))
        changed.push_back(t.oriented);
  };
  differing(before, after, change_.gone);
  differing(after, before, change_.made);
  return true;
}

}  // namespace pnpbs
