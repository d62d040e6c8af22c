// SPDX-License-Identifier: BSD-3-Clause
// Repair of slivers: tetrahedra with a small dihedral angle, which Delaunay triangulations have in
// space however even the distances are. One of the nodes goes a little way, the stars around are
// made anew, and it stays there if small angles become fewer or less small.
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <span>
#include <unordered_map>
#include <vector>

#include "base/nodes.hpp"
#include "base/timers.hpp"
#include "method/constants.hpp"
#include "quality/volume/node_move.hpp"
#include "quality/volume/small_angles.hpp"
#include "quality/volume/star_changes.hpp"
#include "quality/volume/surface_node_move.hpp"
#include "tree/box_tree.hpp"

namespace pnpbs {

struct SliverRule {
  double repair_below;  // degrees
  std::int64_t rounds = method::kSliverRounds;

  // The angles that must not become worse on the way.
  double penalty_below() const { return repair_below + method::kPenaltyAbove; }
};

// A tetrahedron that a node's move has made, or done away with, as other ranks are told of it.
struct ChangedTetrahedron {
  std::int64_t node;  // id; it is at x now
  Point<3> x;
  std::array<std::int64_t, 4> corners;  // ids, of positive orientation
  std::int32_t on;                      // the facet that the node is on now, or -1
  std::int32_t made;                    // 0: it is gone
};

// The node that is to move for a sliver in a round, as other ranks are told of it.
struct SliverDraw {
  std::uint64_t lot;
  std::array<std::int64_t, 4> sliver;  // ids, ascending
  std::int64_t node;                   // id
};

// How nodes on surfaces go along these.
struct AlongSurfaces {
  struct Place {
    Point<3> x;
    std::int32_t facet;
  };
  // Where node i comes to in that direction, as far as that length; where it is if it may not.
  std::function<Place(std::int64_t i, const Point<3>& direction, double length)> walk;
  SurfaceNodeMove::InDomain in_domain;
  // Moves places that lie near their surface only onto it, those of this rank at once and outside
  // of parallel regions. A place that cannot be moved there gets the facet -1. Null if all walks
  // end on the surface.
  std::function<void(std::vector<Place>& places)> settle;
  // Do these nodes of the boundary lie on one sheet of a surface?
  std::function<bool(std::int64_t i, std::int64_t j)> on_one_sheet;
};

class SliverRepair {
 public:
  // May node i be at x?
  using Allowed = std::function<bool(std::int64_t i, const Point<3>& x)>;

  // The stars are those of the nodes' positions, and remain while this lives: of the owned nodes,
  // and of ghosts within method::kSliverRings of them. Nodes on surfaces move where it is said how:
  // where no other node of a sliver can, and late.
  SliverRepair(Nodes<3>& nodes, const VolumeStars& stars, const SliverRule& rule, Allowed allowed,
               AlongSurfaces along_surfaces = {});

  // A round. Of each sliver with an angle below so many degrees one corner is drawn, and its owner,
  // who knows all around it, draws the node that is to move.
  void draw(std::int64_t number, double below = 90);
  // What ranks tell those that have the corner as a ghost, and what these do with it.
  std::vector<std::int32_t> drawn_corners() const;
  std::vector<SliverDraw> draws_of(std::int32_t corner) const;
  void take(const std::vector<SliverDraw>& draws);
  // Moves owned nodes by all draws around, and returns how many.
  std::int64_t move();
  // Ranks tell those that have these nodes as ghosts what has changed with them: so the stars of
  // all stay what they are to their owners, however many rounds there are.
  std::vector<std::int32_t> moved_nodes() const;  // in the last round
  std::vector<ChangedTetrahedron> changes_of(std::int32_t moved_node) const;
  void follow(const std::vector<ChangedTetrahedron>& news);

  // The stars of the owned nodes where all are now, in place of those made before.
  void write_stars(VolumeStars& stars) const { stars_.write_to(stars); }

  // Those left, with an owned node that can move.
  std::int64_t slivers(double below = 90) const;
  // Of this rank's attempts in the last round: those that found no better place. One along a
  // surface counts as often as it takes the time of another.
  std::int64_t in_vain() const { return in_vain_; }
  // So far: stars in which slivers were looked for, at first and after each change.
  NodesWorkedFor stars_looked_at() const { return stars_looked_at_; }
  // Of this rank's attempts so far: uses of stars that are not known here. Where there are any, the
  // result may depend on ranks.
  std::int64_t unknown_uses() const { return stars_.unknown_uses() + unknown_draws_; }

 private:
  // The node that is to move for a sliver, and its lot in this round.
  struct Attempt {
    std::uint64_t lot;
    std::array<std::int64_t, 4> ids;  // of the sliver's nodes
    TetrahedronNodes sliver;          // by id; -1: another rank's, not known here
    std::int32_t node;
    std::int32_t corner;              // that was drawn, or -1: another rank's
    std::vector<StarChange> success;  // one, or none
  };

  std::array<Point<3>, 4> corners_of(const TetrahedronNodes& tetrahedron) const;
  bool is_sliver(const TetrahedronNodes& tetrahedron) const;
  bool owned(std::int64_t i) const { return nodes_.owned(i) != 0; }
  template <class Counts>
  void add_slivers_at(std::int64_t i, const Counts& counts,
                      std::vector<TetrahedronNodes>& found) const;
  void find_slivers();
  void accept(const std::vector<StarChange>& changes);

  std::int32_t place_of(std::int64_t id) const;
  std::int32_t corner_to_move(const TetrahedronNodes& sliver, std::uint64_t lot,
                              std::int64_t number) const;
  std::int32_t node_to_move(std::int32_t corner, std::uint64_t lot) const;
  std::vector<char> winners() const;
  void try_moves(Attempt& attempt) const;
  void try_moves_along_surface(Attempt& attempt) const;
  bool try_place(SurfaceNodeMove& move, const AlongSurfaces::Place& to, Attempt& attempt) const;
  void settle_moves();
  void find_boundary_nodes();
  std::vector<std::int32_t> boundary_nodes_around(std::int32_t i) const;
  Point<3> direction_to_try(const Attempt& attempt, int trial, std::uint64_t bits) const;
  double way_to_try(const Attempt& attempt, std::uint64_t bits) const;
  bool may_help(const StarChange& change) const;
  bool helps(const StarChange& change) const;
  bool crowded(std::int32_t i, const Point<3>& x) const;
  bool too_far(std::int32_t i, const Point<3>& x) const;
  bool within_reach(std::int32_t i, const TetrahedronNodes& tetrahedron) const;
  bool within_reach(std::int32_t i, std::span<const TetrahedronNodes> tetrahedra) const;
  bool star_within_reach(std::int32_t i) const;
  double penalty(std::span<const TetrahedronNodes> tetrahedra, std::int32_t node,
                 const Point<3>& at) const;
  double penalty_around(std::int32_t i) const;

  Nodes<3>& nodes_;
  SmallAngles small_, penalised_;
  std::int64_t rounds_;
  std::int64_t in_vain_ = 0;
  NodesWorkedFor stars_looked_at_;
  Allowed allowed_;
  AlongSurfaces along_surfaces_;
  StarChanges stars_;
  std::vector<Point<3>> before_;  // where the nodes were when the repair began
  // Nodes of the boundary, and boxes that they stay in.
  std::vector<std::int32_t> boundary_nodes_;
  BoxTree<3> boundary_boxes_;
  std::vector<char> is_affected_;          // while a change is accepted
  std::vector<TetrahedronNodes> slivers_;  // in no order that matters
  std::vector<Attempt> attempts_;          // of this round
  std::vector<StarChange> changes_;        // of the last round
  std::int64_t unknown_draws_ = 0;
  std::unordered_map<std::int64_t, std::int32_t> place_of_id_;  // where there are ghosts
};

}  // namespace pnpbs
