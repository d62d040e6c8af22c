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

template <class Found>
bool has_node(const Found& tetrahedron, std::int32_t node) {
  return std::find(tetrahedron.by_id.begin(), tetrahedron.by_id.end(), node) !=
         tetrahedron.by_id.end();
}

}  // namespace

SurfaceNodeMove::SurfaceNodeMove(const Nodes<3>& nodes, const StarChanges& stars, std::int32_t node,
                                 std::span<const std::int32_t> others, const InDomain& in_domain)
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
  near_.insert(near_.end(), others.begin(), others.end());
  sort_unique(near_);
}

bool SurfaceNodeMove::is_element(const Found& tetrahedron, const std::array<std::int64_t, 4>& nodes,
                                 const Tetrahedron& corners) {
  if (has_node(tetrahedron, change_.node)) return in_domain_(nodes, corners);
  const auto [known, is_new] = elements_.try_emplace(tetrahedron.by_id, false);
  if (is_new) known->second = in_domain_(nodes, corners);
  return known->second;
}

// Computes the star of node i from the nodes in near_, with the moving node at x.
SurfaceNodeMove::Star SurfaceNodeMove::star_of(std::int32_t i, const Point<3>& x) {
  static thread_local VolumeStar star;
  Star result;
  star.start(node_at(i, x));
  std::vector<std::int32_t> candidates;
  for (const std::int32_t j : near_) {
    if (j == i) continue;
    candidates.push_back(j);
    star.add(node_at(j, x));
  }
  star.wrap(std::numeric_limits<double>::infinity());  // the candidates are all that matter
  star.finish([&](const VolumeStar::Corners& corners) {
    TetrahedronNodes t{i};
    std::array<std::int64_t, 4> nodes{i};
    Tetrahedron at{star.centre()};
    for (std::size_t k = 0; k < 3; ++k) {
      nodes[k + 1] = t[k + 1] = candidates[static_cast<std::size_t>(corners[k])];
      at[k + 1] = star.candidates()[static_cast<std::size_t>(corners[k])];
    }
    result.neighbours.insert(result.neighbours.end(), t.begin() + 1, t.end());
    if (const Found tetrahedron = found(t); is_element(tetrahedron, nodes, at))
      result.tetrahedra.push_back(tetrahedron);
    return true;
  });
  std::sort(result.tetrahedra.begin(), result.tetrahedra.end());
  return result;
}

const SurfaceNodeMove::Star& SurfaceNodeMove::star_before(std::int32_t i) {
  const auto found = before_.find(i);
  if (found != before_.end()) return found->second;
  return before_.emplace(i, star_of(i, nodes_.position(change_.node))).first->second;
}

// Returns whether the star computed for the old position equals the existing one.
bool SurfaceNodeMove::is_as_before(std::int32_t i) {
  return star_before(i).tetrahedra == existing_star(i);
}

// Computes the elements in the stars of the centres after the move. Returns false if an element is
// missing in the star of one of its corners.
bool SurfaceNodeMove::find_stars_after(std::vector<Found>& found) {
  for (const std::int32_t i : centres_) {
    const Star star = star_of(i, change_.x);
    found.insert(found.end(), star.tetrahedra.begin(), star.tetrahedra.end());
  }
  std::sort(found.begin(), found.end());
  for (auto first = found.begin(); first != found.end();) {
    const auto last = std::upper_bound(first, found.end(), *first);
    const auto corners = std::count_if(
        first->by_id.begin(), first->by_id.end(),
        [&](std::int32_t i) { return std::binary_search(centres_.begin(), centres_.end(), i); });
    if (last - first != corners) return false;
    first = last;
  }
  found.erase(std::unique(found.begin(), found.end()), found.end());
  return true;
}

// Returns the existing elements around node i.
std::vector<SurfaceNodeMove::Found> SurfaceNodeMove::existing_star(std::int32_t i) const {
  std::vector<Found> there;
  stars_.for_simplices(i, [&](const StarChanges::Corners& c) {
    there.push_back(found({i, c[0], c[1], c[2]}));
  });
  std::sort(there.begin(), there.end());
  return there;
}

std::vector<SurfaceNodeMove::Found> SurfaceNodeMove::existing_stars(
    const std::vector<std::int32_t>& centres) const {
  std::vector<Found> there;
  for (const std::int32_t i : centres) stars_.count_if_unknown(i);
  for (const std::int32_t i : centres) {
    const std::vector<Found> star = existing_star(i);
    there.insert(there.end(), star.begin(), star.end());
  }
  sort_unique(there);
  return there;
}

void SurfaceNodeMove::go_to(const Point<3>& x, std::int32_t on) {
  change_ = {change_.node, x, {}, {}, on};
  const Star& before = star_before(change_.node);
  const Star after = star_of(change_.node, x);
  centres_ = before.neighbours;
  centres_.insert(centres_.end(), after.neighbours.begin(), after.neighbours.end());
  centres_.push_back(change_.node);
  std::erase_if(centres_,
                [&](std::int32_t i) {  // across a gap a neighbour may be far away within the body
                  return !std::binary_search(two_rings_.begin(), two_rings_.end(), i);
                });
  stars_.for_neighbours(change_.node,
                        [&](std::int64_t j) { centres_.push_back(static_cast<std::int32_t>(j)); });
  sort_unique(centres_);
  there_ = existing_stars(centres_);
  for (const Found& t : there_) change_.gone.push_back(t.oriented);
  for (const Found& t : after.tetrahedra) change_.made.push_back(t.oriented);
}

bool SurfaceNodeMove::complete() {
  if (!std::all_of(centres_.begin(), centres_.end(),
                   [this](std::int32_t i) { return is_as_before(i); }))
    return false;
  std::vector<Found> after;
  if (!find_stars_after(after)) return false;
  change_.gone.clear();
  change_.made.clear();
  const auto differing = [&](const std::vector<Found>& of, const std::vector<Found>& others,
                             std::vector<TetrahedronNodes>& changed) {
    for (const Found& t : of)
      if (has_node(t, change_.node) || !std::binary_search(others.begin(), others.end(), t))
        changed.push_back(t.oriented);
  };
  differing(there_, after, change_.gone);
  differing(after, there_, change_.made);
  return true;
}

}  // namespace pnpbs
