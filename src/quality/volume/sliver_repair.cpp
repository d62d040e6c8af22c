// SPDX-License-Identifier: BSD-3-Clause
#include "quality/volume/sliver_repair.hpp"

#include <algorithm>
#include <cmath>
#include <tuple>
#include <utility>

#include "base/execution.hpp"
#include "base/mixed_hash.hpp"
#include "base/nodes_worked_for.hpp"
#include "method/constants.hpp"
#include "quality/volume/lot_bits.hpp"
#include "quality/volume/small_node_set.hpp"
#include "tree/box_tree.hpp"

namespace pnpbs {

SliverRepair::SliverRepair(Nodes<3>& nodes, const VolumeStars& stars, const SliverRule& rule,
                           Allowed allowed, AlongSurfaces along_surfaces)
    : nodes_(nodes),
      small_(rule.repair_below),
      penalised_(rule.penalty_below()),
      rounds_(rule.rounds),
      allowed_(std::move(allowed)),
      along_surfaces_(std::move(along_surfaces)),
      stars_(nodes, stars, along_surfaces_.walk != nullptr),
      is_affected_(static_cast<std::size_t>(nodes.count)) {
  bool any_ghost = false;
  for (std::int32_t i = 0; i < nodes.count; ++i) any_ghost = any_ghost || !nodes.owned(i);
  if (any_ghost) index_by_id_ = IndexById(nodes);
  find_slivers();
}

// ------------------------------------------------------------------ which there are ------------

std::array<Point<3>, 4> SliverRepair::corners_of(const TetrahedronNodes& tetrahedron) const {
  std::array<Point<3>, 4> x;
  for (std::size_t k = 0; k < 4; ++k) x[k] = nodes_.position(tetrahedron[k]);
  return x;
}

bool SliverRepair::is_sliver(const TetrahedronNodes& tetrahedron) const {
  return small_.any(corners_of(tetrahedron));
}

// Adds the slivers around node i in which i has the smallest id of all corners that count. Skips
// slivers without an owned corner, because only the owner of a corner draws for a sliver.
template <class Counts>
void SliverRepair::add_slivers_at(std::int64_t i, const Counts& counts,
                                  std::vector<TetrahedronNodes>& found) const {
  stars_.for_simplices_first_at(i, counts, [&](const TetrahedronNodes& t) {
    if (!stars_.any_movable(t)) return;
    if (small_.surely_none(corners_of(t))) return;  // most tetrahedra have no small angle
    if (std::none_of(t.begin(), t.end(), [&](std::int32_t j) { return owned(j); })) return;
    const TetrahedronNodes ordered = stars_.by_id(t);
    if (is_sliver(ordered)) found.push_back(ordered);
  });
}

void SliverRepair::find_slivers() {
  constexpr std::int64_t kChunk = 1024;
  std::vector<std::vector<TetrahedronNodes>> found(
      static_cast<std::size_t>((nodes_.count + kChunk - 1) / kChunk));
  const auto is_owned = [&](std::int64_t i) { return owned(i); };
  for_each("pnpbs::SliverRepair::find", std::ssize(found), [&](std::int64_t chunk) {
    for (std::int64_t i = chunk * kChunk; i < std::min((chunk + 1) * kChunk, nodes_.count); ++i)
      if (is_owned(i)) add_slivers_at(i, is_owned, found[static_cast<std::size_t>(chunk)]);
  });
  stars_looked_at_.add(nodes_worked_for(nodes_, is_owned));
  for (const auto& some : found) slivers_.insert(slivers_.end(), some.begin(), some.end());
}

// Applies the changes to nodes and stars, and updates the slivers in the stars that changed. The
// moved nodes are too far apart to change the same stars (see winners()).
void SliverRepair::accept(const std::vector<StarChange>& changes) {
  const std::vector<std::vector<std::int32_t>> affected = stars_.accept(changes);
  for (const StarChange& change : changes) {
    nodes_.set_position(change.node, change.x);
    if (change.on >= 0) nodes_.boundary_node(change.node) = change.on;
  }
  const auto mark = [&](char as) {
    for (const auto& some : affected)
      for (const std::int32_t i : some) is_affected_[static_cast<std::size_t>(i)] = as;
  };
  const auto is_affected = [&](std::int32_t i) {
    return is_affected_[static_cast<std::size_t>(i)] != 0;
  };
  mark(1);
  std::erase_if(slivers_, [&](const TetrahedronNodes& sliver) {
    return std::any_of(sliver.begin(), sliver.end(), is_affected);
  });
  std::vector<std::vector<TetrahedronNodes>> found(affected.size());
  for_each("pnpbs::SliverRepair::accept", std::ssize(affected), [&](std::int64_t c) {
    const auto k = static_cast<std::size_t>(c);
    for (const std::int32_t i : affected[k]) add_slivers_at(i, is_affected, found[k]);
  });
  for (const auto& some : found) slivers_.insert(slivers_.end(), some.begin(), some.end());
  for (const auto& some : affected)
    for (const std::int32_t i : some) stars_looked_at_.add({1, owned(i) ? 1 : 0});
  mark(0);
}

std::int64_t SliverRepair::slivers(double below) const {
  const SmallAngles small(below);
  return std::count_if(slivers_.begin(), slivers_.end(), [&](const TetrahedronNodes& sliver) {
    return small.any(corners_of(sliver)) &&
           std::any_of(sliver.begin(), sliver.end(),
                       [&](std::int32_t i) { return nodes_.owned(i) && stars_.movable(i); });
  });
}

// ------------------------------------------------------------------ whose turn it is -----------

// Selects a corner of the sliver by its lot. Nodes on surfaces are candidates if no other corner
// can move, or in the later half of the rounds.
std::int32_t SliverRepair::corner_to_move(const TetrahedronNodes& sliver, std::uint64_t lot,
                                          std::int64_t number) const {
  std::vector<std::int32_t> choice;
  for (const std::int32_t i : sliver)
    if (nodes_.moves(i)) choice.push_back(i);
  if (choice.empty() || 2 * number >= rounds_)
    for (const std::int32_t i : sliver)
      if (stars_.movable(i) && !nodes_.moves(i)) choice.push_back(i);
  return choice[mixed(lot) % choice.size()];
}

// Selects a neighbour instead of the corner in one of kSliverTurnsOfCorners + 1 cases, because
// moving any of the corners may not help.
std::int32_t SliverRepair::node_to_move(std::int32_t corner, std::uint64_t lot) const {
  constexpr std::uint64_t kCornersOf = method::kSliverTurnsOfCorners;
  if (mixed(lot + 1) % (kCornersOf + 1) < kCornersOf) return corner;
  std::vector<std::int32_t> choice{corner};
  stars_.for_neighbours(corner, [&](std::int64_t i) {
    if (nodes_.moves(i)) choice.push_back(static_cast<std::int32_t>(i));
  });
  const auto hash = [&](std::int32_t i) {
    return mixed(lot ^ static_cast<std::uint64_t>(nodes_.number(i)));
  };
  return *std::max_element(choice.begin(), choice.end(),
                           [&](std::int32_t i, std::int32_t j) { return hash(i) < hash(j); });
}

// Lots decide rather than angles: otherwise a sliver that cannot be repaired would block its
// neighbourhood in every round.
void SliverRepair::draw(std::int64_t number, double below) {
  const SmallAngles small(below);
  attempts_.clear();
  for (const TetrahedronNodes& sliver : slivers_) {
    if (!small.any(corners_of(sliver))) continue;
    std::uint64_t lot = mixed(static_cast<std::uint64_t>(number) ^ bits_of(below));
    for (const std::int32_t i : sliver)
      lot = mixed(lot ^ static_cast<std::uint64_t>(nodes_.number(i)));
    const std::int32_t corner = corner_to_move(sliver, lot, number);
    if (!nodes_.owned(corner)) continue;
    Attempt attempt{lot, {}, sliver, node_to_move(corner, lot), corner, {}};
    for (std::size_t k = 0; k < 4; ++k) attempt.ids[k] = nodes_.id(sliver[k]);
    attempts_.push_back(std::move(attempt));
  }
}

// Returns which attempts win the contest: of two so close that they might change the same stars,
// the one with the higher lot.
std::vector<char> SliverRepair::winners() const {
  std::vector<Box<3>> boxes;
  const auto reach = [&](std::int32_t i) { return method::kSliverReach * nodes_.d(i); };
  for (const Attempt& attempt : attempts_)
    boxes.push_back(box_around<3>(nodes_.position(attempt.node), reach(attempt.node)));
  const BoxTree<3> tree(std::move(boxes));
  std::vector<char> wins(attempts_.size());
  for_each("pnpbs::SliverRepair::winners", std::ssize(attempts_), [&](std::int64_t a) {
    const Attempt& own = attempts_[static_cast<std::size_t>(a)];
    if (!nodes_.owned(own.node)) return;
    const Point<3> x = nodes_.position(own.node);
    double square = reach(own.node) * reach(own.node);
    bool wins_here = true;
    tree.for_near(
        x, [&] { return square; },
        [&](std::int32_t b) {
          const Attempt& other = attempts_[static_cast<std::size_t>(b)];
          if (b == a ||
              distance<3>(nodes_.position(other.node), x) > reach(own.node) + reach(other.node))
            return;
          if (std::tie(other.lot, other.ids) < std::tie(own.lot, own.ids)) return;
          wins_here = false;
          square = -1;  // ends the search
        });
    wins[static_cast<std::size_t>(a)] = wins_here;
  });
  return wins;
}

// ------------------------------------------------------------------ what helps -----------------

// Returns the distance of a trial position.
double SliverRepair::way_to_try(const Attempt& attempt, std::uint64_t bits) const {
  return nodes_.d(attempt.node) *
         (method::kSliverShortestWay +
          (method::kSliverLongestWay - method::kSliverShortestWay) * unit_interval(bits));
}

// Returns the direction of a trial: both directions along the normal of the face opposite to the
// node first, then pseudo-random ones.
Point<3> SliverRepair::direction_to_try(const Attempt& attempt, int trial,
                                        std::uint64_t bits) const {
  Point<3> direction = direction_from(bits);
  if (trial < 2) {
    std::vector<Point<3>> face;
    for (const std::int32_t i : attempt.sliver)
      if (i != attempt.node) face.push_back(nodes_.position(i));
    const Point<3> normal = cross(difference(face[1], face[0]), difference(face[2], face[0]));
    const double length = std::sqrt(dot(normal, normal));
    if (length > 0)
      for (std::size_t k = 0; k < 3; ++k) direction[k] = (trial == 0 ? 1 : -1) * normal[k] / length;
  }
  return direction;
}

// Returns the sum of the penalties of the tetrahedra with `node` at `at`. The sum has the same bits
// for any order of the tetrahedra. Most tetrahedra contribute nothing and are skipped early.
double SliverRepair::penalty(std::span<const TetrahedronNodes> tetrahedra, std::int32_t node,
                             const Point<3>& at) const {
  std::vector<std::pair<TetrahedronNodes, double>> penalised;
  for (const TetrahedronNodes& unordered : tetrahedra) {
    if (!stars_.any_movable(unordered)) continue;
    const auto corners = [&](const TetrahedronNodes& t) {
      std::array<Point<3>, 4> x = corners_of(t);
      for (std::size_t k = 0; k < 4; ++k)
        if (t[k] == node) x[k] = at;
      return x;
    };
    if (penalised_.surely_none(corners(unordered))) continue;
    const TetrahedronNodes t = stars_.by_id(unordered);
    const double own = penalised_.penalty(corners(t));
    if (own > 0) penalised.emplace_back(t, own);
  }
  std::sort(penalised.begin(), penalised.end(),
            [this](const auto& a, const auto& b) { return stars_.ids_less(a.first, b.first); });
  double sum = 0;
  for (std::size_t k = 0; k < penalised.size(); ++k)
    if (k == 0 || penalised[k].first != penalised[k - 1].first) sum += penalised[k].second;
  return sum;
}

// Returns the penalty of all tetrahedra that a move of node i usually changes.
double SliverRepair::penalty_around(std::int32_t i) const {
  SmallNodeSet centres;
  centres.add(i);
  stars_.for_neighbours(i, [&](std::int64_t j) { centres.add(static_cast<std::int32_t>(j)); });
  const auto is_centre = [&](std::int32_t j) { return centres.contains(j); };
  std::vector<TetrahedronNodes> around;
  for (const std::int32_t j : centres.all()) stars_.count_if_unknown(j);
  for (const std::int32_t j : centres.all())
    stars_.for_simplices_first_at(j, is_centre,
                                  [&](const TetrahedronNodes& t) { around.push_back(t); });
  return penalty(around, i, nodes_.position(i));
}

bool SliverRepair::within_reach(std::int32_t i, const TetrahedronNodes& tetrahedron) const {
  const Point<3> x = nodes_.position(i);
  const double reach = method::kSliverReach * nodes_.d(i);
  return std::all_of(tetrahedron.begin(), tetrahedron.end(),
                     [&](std::int32_t j) { return distance<3>(nodes_.position(j), x) <= reach; });
}

bool SliverRepair::within_reach(std::int32_t i,
                                std::span<const TetrahedronNodes> tetrahedra) const {
  return std::all_of(tetrahedra.begin(), tetrahedra.end(),
                     [&](const TetrahedronNodes& t) { return within_reach(i, t); });
}

// Returns whether the tetrahedra around node i lie within its reach. A move always removes these.
bool SliverRepair::star_within_reach(std::int32_t i) const {
  bool within = true;
  stars_.for_simplices(i, [&](const StarChanges::Corners& c) {
    within = within && within_reach(i, TetrahedronNodes{i, c[0], c[1], c[2]});
  });
  return within;
}

// Returns whether an incomplete change may help. It has a subset of the new tetrahedra and a
// superset of the removed ones, so the complete change cannot be better. This rejects most trials
// before all stars are computed.
bool SliverRepair::may_help(const StarChange& change) const {
  constexpr double kRounding = 1 + 1e-9;  // the sums have different terms
  return penalty(change.made, change.node, change.x) <
         kRounding * penalty(change.gone, change.node, nodes_.position(change.node));
}

bool SliverRepair::helps(const StarChange& change) const {
  constexpr double kRounding = 1e-9;
  const std::int32_t i = change.node;
  return within_reach(i, change.gone) && within_reach(i, change.made) &&
         penalty(change.made, i, change.x) <
             (1 - kRounding) * penalty(change.gone, i, nodes_.position(i));
}

void SliverRepair::try_moves(Attempt& attempt) const {
  const std::int32_t i = attempt.node;
  const double around = penalty_around(i);
  NodeMove move(nodes_, stars_, i);
  for (int trial = 0; trial < method::kSliverTrials; ++trial) {
    const std::uint64_t bits = bits_of_trial(attempt.lot, trial);
    const double way = way_to_try(attempt, bits);
    const Point<3> direction = direction_to_try(attempt, trial, bits);
    Point<3> x =
        nodes_.position_after(i, {way * direction[0], way * direction[1], way * direction[2]});
    if (too_far(i, x) || !allowed_(i, x) || !move.go_to(x)) continue;
    const StarChange& change = move.change();
    if (penalty(change.made, i, x) >= around) continue;  // rejects most trials cheaply
    if (!move.complete() || !helps(change)) continue;
    attempt.success.push_back(change);
    return;
  }
}

bool SliverRepair::too_far(std::int32_t i, const Point<3>& x) const {
  return distance<3>(point_at<3>(nodes_.reference, i), x) > method::kSliverDrift * nodes_.d(i);
}

// Returns whether x is too close to a boundary node in the star of node i, and closer than the
// current position. The second condition permits moves where nodes on opposite sides of a thin wall
// are close already.
bool SliverRepair::crowded(std::int32_t i, const Point<3>& x) const {
  bool crowded = false;
  stars_.for_neighbours(i, [&](std::int64_t j) {
    const double gap = distance<3>(nodes_.position(j), x);
    crowded =
        crowded || (nodes_.carrier(j) != Carrier::free && gap < method::kSliverRoom * nodes_.d(i) &&
                    gap < distance<3>(nodes_.position(j), nodes_.position(i)));
  });
  return crowded;
}

// Finds the boundary nodes before the first of them moves.
void SliverRepair::find_boundary_nodes() {
  if (!boundary_nodes_.empty()) return;
  std::vector<Box<3>> boxes;
  for (std::int32_t i = 0; i < nodes_.count; ++i) {
    if (nodes_.carrier(i) == Carrier::free) continue;
    boundary_nodes_.push_back(i);
    boxes.push_back(
        box_around<3>(point_at<3>(nodes_.reference, i), method::kSliverDrift * nodes_.d(i)));
  }
  boundary_boxes_ = BoxTree<3>(std::move(boxes));
}

// Returns the boundary nodes around node i, whether or not edges connect them: no edge crosses a
// gap.
std::vector<std::int32_t> SliverRepair::boundary_nodes_around(std::int32_t i) const {
  const Point<3> x = nodes_.position(i);
  const double reach = method::kSliverSight * nodes_.d(i);
  std::vector<std::int32_t> around;
  boundary_boxes_.for_meeting(box_around<3>(x, reach), [&](std::int32_t b) {
    const std::int32_t j = boundary_nodes_[static_cast<std::size_t>(b)];
    if (distance<3>(nodes_.position(j), x) < reach) around.push_back(j);
  });
  return around;
}

void SliverRepair::try_moves_along_surface(Attempt& attempt) const {
  const std::int32_t i = attempt.node;
  if (!star_within_reach(i)) return;
  SurfaceNodeMove move(nodes_, stars_, i, boundary_nodes_around(i), along_surfaces_.in_domain);
  for (int trial = 0; trial < method::kSliverTrials; ++trial) {
    const std::uint64_t bits = bits_of_trial(attempt.lot, trial);
    const AlongSurfaces::Place to =
        along_surfaces_.walk(i, direction_to_try(attempt, trial, bits), way_to_try(attempt, bits));
    if (try_place(move, to, attempt)) return;
  }
}

bool SliverRepair::try_place(SurfaceNodeMove& move, const AlongSurfaces::Place& to,
                             Attempt& attempt) const {
  const std::int32_t i = attempt.node;
  if (to.x == nodes_.position(i) || too_far(i, to.x) || crowded(i, to.x)) return false;
  move.go_to(to.x, to.facet);
  if (!within_reach(i, move.change().made) || !may_help(move.change())) return false;
  if (!move.complete() || !helps(move.change())) return false;
  if (along_surfaces_.keeps_inner_facets && !along_surfaces_.keeps_inner_facets(move.change()))
    return false;
  attempt.success.push_back(move.change());
  return true;
}

// Projects the nodes that moved along a surface onto it if their new positions lie beside it, and
// keeps the moves that still help. Evaluates a level set for all of them at once on this thread,
// because the user's function need not be thread-safe.
void SliverRepair::settle_moves() {
  std::vector<std::size_t> moved;
  std::vector<AlongSurfaces::Place> places;
  for (std::size_t a = 0; a < attempts_.size(); ++a)
    for (const StarChange& change : attempts_[a].success)
      if (change.on >= 0) {
        moved.push_back(a);
        places.push_back({change.x, change.on});
      }
  const std::vector<AlongSurfaces::Place> before = places;
  along_surfaces_.settle(places);
  for_each("pnpbs::SliverRepair::settle", std::ssize(moved), [&](std::int64_t m) {
    const auto k = static_cast<std::size_t>(m);
    if (places[k].x == before[k].x && places[k].facet == before[k].facet) return;
    Attempt& attempt = attempts_[moved[k]];
    attempt.success.clear();
    if (places[k].facet < 0) return;
    const std::int32_t i = attempt.node;
    SurfaceNodeMove move(nodes_, stars_, i, boundary_nodes_around(i), along_surfaces_.in_domain);
    try_place(move, places[k], attempt);
  });
}

std::int64_t SliverRepair::move() {
  const std::vector<char> wins = winners();
  for (std::size_t a = 0; a < attempts_.size(); ++a)
    if (wins[a] && !nodes_.moves(attempts_[a].node)) find_boundary_nodes();
  for_each("pnpbs::SliverRepair::move", std::ssize(attempts_), [&](std::int64_t a) {
    if (!wins[static_cast<std::size_t>(a)]) return;
    Attempt& attempt = attempts_[static_cast<std::size_t>(a)];
    nodes_.moves(attempt.node) ? try_moves(attempt) : try_moves_along_surface(attempt);
  });
  if (along_surfaces_.settle) settle_moves();
  changes_.clear();
  in_vain_ = 0;
  for (std::size_t a = 0; a < attempts_.size(); ++a) {
    if (wins[a] && attempts_[a].success.empty())
      in_vain_ += nodes_.moves(attempts_[a].node) ? 1 : method::kWorkOfSurfaceMove;
    for (StarChange& change : attempts_[a].success) changes_.push_back(std::move(change));
  }
  accept(changes_);
  nodes_.moved();
  return std::ssize(changes_);
}

}  // namespace pnpbs
