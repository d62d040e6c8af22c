// SPDX-License-Identifier: BSD-3-Clause
// Repair of slivers: tetrahedra with a small dihedral angle. Delaunay triangulations in space
// contain slivers however uniform the distances are. The repair moves one node a short way,
// recomputes the stars around it, and keeps the move if the number or the size of the small angles
// improves.
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include "base/index_by_id.hpp"
#include "base/nodes.hpp"
#include "base/timers.hpp"
#include "method/constants.hpp"
#include "quality/volume/node_move.hpp"
#include "quality/volume/small_angles.hpp"
#include "quality/volume/star_changes.hpp"
#include "quality/volume/surface_node_move.hpp"
#include "tree/box_tree.hpp"

namespace pnpbs {

// Parameters of the repair.
struct SliverRule {
  double repair_below;  // bound of the dihedral angle of slivers [degrees]
  std::int64_t rounds = method::kSliverRounds;

  // Returns the bound below which angles must not get worse. [degrees]
  double penalty_below() const { return repair_below + method::kPenaltyAbove; }
};

// A tetrahedron that the move of a node created or removed, as sent to other ranks.
struct ChangedTetrahedron {
  std::int64_t node;  // id of the node to move
  Point<3> x;
  std::array<std::int64_t, 4> corners;  // ids, positively oriented
  std::int32_t on;                      // new facet of the moved node, or -1
  std::int32_t made;                    // 1: created, 0: removed

  void translate(const Translation<3>& by, const BoundarySeenFrom<3>& boundary_seen_from) {
    node = by.id(node);
    x = by(x);
    on = boundary_seen_from(by.image, Carrier::surface, on);
    for (std::int64_t& corner : corners) corner = by.id(corner);
  }
};

// The node that is to move for a sliver in a round, as sent to other ranks.
struct SliverDraw {
  std::uint64_t lot;
  std::array<std::int64_t, 4> sliver;  // ids of its corners, ascending
  std::int64_t node;                   // id

  void translate(const Translation<3>& by, const BoundarySeenFrom<3>&) {
    for (std::int64_t& corner : sliver) corner = by.id(corner);
    node = by.id(node);
  }
};

// Functions by which nodes move along surfaces.
struct AlongSurfaces {
  // A point on a facet of the surface.
  struct Place {
    Point<3> x;
    std::int32_t facet;
  };
  // Returns the point that node i reaches in this direction after at most this length, or its
  // current point if it may not move.
  std::function<Place(std::int64_t i, const Point<3>& direction, double length)> walk;
  SurfaceNodeMove::InDomain in_domain;
  // Projects points that are only near their surface onto it. The facet of a point becomes -1 if it
  // cannot be projected. Called once per round for all points of this rank, outside of parallel
  // regions. Null if walk() returns points on the surface.
  std::function<void(std::vector<Place>& places)> settle;
  // Returns whether the change keeps the faces that represent surfaces inside the body. Null if no
  // node on such a surface moves.
  std::function<bool(const StarChange& change)> keeps_inner_facets;
};

// The repair of slivers, in rounds: draw(), on several ranks take(), move(), and on several ranks
// follow().
class SliverRepair {
 public:
  // Returns whether node i may be at x.
  using Allowed = std::function<bool(std::int64_t i, const Point<3>& x)>;

  // Finds the slivers. `stars` must be valid for the current positions of the owned nodes and of
  // ghosts within method::kSliverRings of these. The nodes must be at their reference positions,
  // from which their displacement is measured. `nodes` and `stars` must outlive this object.
  // Nodes on surfaces move only if `along_surfaces.walk` is set: for slivers whose other nodes
  // cannot move, and for all slivers in the later half of the rounds.
  SliverRepair(Nodes<3>& nodes, const VolumeStars& stars, const SliverRule& rule, Allowed allowed,
               AlongSurfaces along_surfaces = {});

  // Starts a round for the slivers with an angle below `below` degrees. A pseudo-random corner of
  // each sliver is selected, and the owner of this corner selects the node that is to move, because
  // it knows all nodes around the corner.
  void draw(std::int64_t number, double below = 90);
  // Returns the owned corners with draws; draws_of() returns the draws of one. The caller must send
  // them to the ranks that have the corner as a ghost, and pass the received ones to take().
  std::vector<std::int32_t> drawn_corners() const;
  std::vector<SliverDraw> draws_of(std::int32_t corner) const;
  void take(const std::vector<SliverDraw>& draws);
  // Tries to move the owned nodes that win the contest against all draws around them. Returns the
  // number of nodes moved.
  std::int64_t move();
  // Returns the owned nodes moved in the last round; changes_of() returns what the move of one
  // changed. The caller must send the changes to the ranks that have the node as a ghost, and pass
  // the received ones to follow(). Then the stars of ghosts agree with those of their owners in any
  // number of rounds.
  std::vector<std::int32_t> moved_nodes() const;
  std::vector<ChangedTetrahedron> changes_of(std::int32_t moved_node) const;
  void follow(const std::vector<ChangedTetrahedron>& news);

  // Replaces the original stars of the owned nodes by those of their new positions.
  void write_stars(VolumeStars& stars) const { stars_.write_to(stars); }

  // Returns the number of remaining slivers that have an owned node that can move.
  std::int64_t slivers(double below = 90) const;
  // Returns the number of failed attempts of this rank in the last round. An attempt on a surface
  // counts kWorkOfSurfaceMove times.
  std::int64_t failed_attempts() const { return in_vain_; }
  // Returns the total number of stars that this rank has searched for slivers.
  NodesWorkedFor stars_looked_at() const { return stars_looked_at_; }
  // Returns how often attempts of this rank used stars that this rank does not know. If this is not
  // 0, the result may depend on the number of ranks.
  std::int64_t unknown_uses() const { return stars_.unknown_uses() + unknown_draws_; }

 private:
  // The node that is to move for a sliver, and the lot of the sliver in this round.
  struct Attempt {
    std::uint64_t lot;
    std::array<std::int64_t, 4> ids;  // ids of the sliver's corners
    TetrahedronNodes sliver;          // indices sorted by id; -1: not known on this rank
    std::int32_t node;
    std::int32_t corner;              // the selected corner, or -1 in draws of other ranks
    std::vector<StarChange> success;  // the change to carry out, if any
  };

  std::array<Point<3>, 4> corners_of(const TetrahedronNodes& tetrahedron) const;
  bool is_sliver(const TetrahedronNodes& tetrahedron) const;
  bool owned(std::int64_t i) const { return nodes_.owned(i) != 0; }
  template <class Counts>
  void add_slivers_at(std::int64_t i, const Counts& counts,
                      std::vector<TetrahedronNodes>& found) const;
  void find_slivers();
  void accept(const std::vector<StarChange>& changes);

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
  // Boundary nodes, and boxes that they do not leave during the repair.
  std::vector<std::int32_t> boundary_nodes_;
  BoxTree<3> boundary_boxes_;
  std::vector<char> is_affected_;          // used by accept()
  std::vector<TetrahedronNodes> slivers_;  // in no particular order
  std::vector<Attempt> attempts_;          // attempts of this round
  std::vector<StarChange> changes_;        // changes of the last round
  std::int64_t unknown_draws_ = 0;
  IndexById index_by_id_;  // empty without ghosts
};

}  // namespace pnpbs
