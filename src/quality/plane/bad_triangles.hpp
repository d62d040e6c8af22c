// SPDX-License-Identifier: BSD-3-Clause
// Repair of bad triangles. Their nodes move a short way if this improves the worst triangle around
// the node and makes no bad triangle worse (optimisation-based smoothing: L. Freitag, M. Jones, P.
// Plassmann, Proc. 4th International Meshing Roundtable, 1995, 47-58). Bad triangles are few, so
// the cost is negligible.
#pragma once

#include <cstdint>
#include <functional>
#include <vector>

#include "delaunay/delaunay_stars.hpp"
#include "geometry/clearance.hpp"
#include "method/constants.hpp"
#include "neighbors/near_edges.hpp"

namespace pnpbs {

// Parameters of the repair of bad triangles.
struct RepairRule {
  std::int64_t rounds;
  double bad_below;                          // bound of bad triangles, by triangle_shape()
  double worst_below = method::kWorstBelow;  // bound of the triangles that are repaired first
};

// Returns the quality of a triangle, 2 r_in / R, or kAngleWeight times the sine of its smallest
// angle if that is less. An angle of 38.5 degrees counts as much as a quality of 0.85.
double triangle_shape(const Point<2>& a, const Point<2>& b, const Point<2>& c);

// The criterion for bad triangles: those whose value is below `bad_below`. No triangle is bad that
// has at least `sufficient_quality` in the plane or in the chart of a sphere.
struct TriangleMeasure {
  std::function<double(const Point<2>&, const Point<2>&, const Point<2>&)> value_of;
  double bad_below;
  double sufficient_quality;
};
// Returns the criterion by triangle_shape().
TriangleMeasure measure_by_shape(double bad_below);

// The repair of the bad triangles of this rank, in rounds. All references must outlive this object,
// and the stars must not change during its life.
class BadTriangleRepair {
 public:
  // Finds the moving nodes that may have bad triangles.
  BadTriangleRepair(Nodes<2>& nodes, const DelaunayStars& stars, const NearEdges& near_edges,
                    const SizedTree<2>& map, TriangleMeasure measure);

  // Moves nodes of bad triangles; of adjacent candidates only the one with the worst triangle
  // moves. Returns the number of owned nodes moved. Ghosts must be exact.
  std::int64_t round();

 private:
  // A node that may have a bad triangle, with the best position found for it.
  struct Candidate {
    std::int32_t node;
    // whether a better position was found
    bool wants = false;
    double worst = 0;  // smallest value of the triangles around it
    Point<2> goal{};
  };

  void find_values(std::int64_t i, const Point<2>& x, std::vector<double>& values) const;
  bool makes_bad_worse(const std::vector<double>& before, const std::vector<double>& after) const;
  Point<2> allowed_place(std::int64_t i, const Point<2>& x) const;
  void find_better_position(Candidate& candidate) const;
  const Candidate* candidate_of(std::int64_t i) const;
  bool comes_first(const Candidate& candidate) const;

  Nodes<2>& nodes_;
  const DelaunayStars& stars_;
  const NearEdges& near_edges_;
  const SizedTree<2>& map_;
  const TriangleMeasure measure_;
  std::vector<Candidate> candidates_;  // in memory order
};

}  // namespace pnpbs
