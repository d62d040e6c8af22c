// SPDX-License-Identifier: BSD-3-Clause
// Repair of the second kind of defect: bad triangles. Their nodes go a little way where the worst
// triangle around them gets better and none that is bad gets worse (optimisation-based smoothing:
// L. Freitag, M. Jones, P. Plassmann, Proc. 4th International Meshing Roundtable, 1995, 47-58).
// They are few, so that it costs nearly nothing.
#pragma once

#include <cstdint>
#include <functional>
#include <vector>

#include "delaunay/delaunay_stars.hpp"
#include "geometry/clearance.hpp"
#include "method/constants.hpp"
#include "neighbors/near_edges.hpp"

namespace pnpbs {

struct RepairRule {
  std::int64_t rounds;
  double bad_below;                          // shape of a triangle
  double worst_below = method::kWorstBelow;  // these first
};

// The quality of a triangle, 2 r_in / R, or the sine of its smallest angle times a weight if that
// is less: 38.5 degrees count as much as a quality of 0.85.
double triangle_shape(const Point<2>& a, const Point<2>& b, const Point<2>& c);

// Which triangles are bad: those with a value below the bound; in the plane, or the chart of a
// sphere, none of at least that quality is.
struct TriangleMeasure {
  std::function<double(const Point<2>&, const Point<2>&, const Point<2>&)> value_of;
  double bad_below;
  double sufficient_quality;
};
TriangleMeasure measure_by_shape(double bad_below);

// The stars must stay as they are in between.
class BadTriangleRepair {
 public:
  // Finds the nodes of bad triangles.
  BadTriangleRepair(Nodes<2>& nodes, const DelaunayStars& stars, const NearEdges& near_edges,
                    const SizedTree<2>& map, TriangleMeasure measure);

  // Moves the nodes of bad triangles, of neighbours only the one with the worst. Returns how many
  // of this rank's. Ghosts must be exact.
  std::int64_t round();

 private:
  // A node of a bad triangle, and where it wants to go.
  struct Candidate {
    std::int32_t node;
    bool wants = false;
    double worst = 0;  // value around it
    Point<2> goal{};
  };

  void find_values(std::int64_t i, const Point<2>& x, std::vector<double>& values) const;
  bool spoils(const std::vector<double>& before, const std::vector<double>& after) const;
  Point<2> allowed_place(std::int64_t i, const Point<2>& x) const;
  void look_around(Candidate& candidate) const;
  const Candidate* candidate_of(std::int64_t i) const;
  bool comes_first(const Candidate& candidate) const;

  Nodes<2>& nodes_;
  const DelaunayStars& stars_;
  const NearEdges& near_edges_;
  const SizedTree<2>& map_;
  const TriangleMeasure measure_;
  std::vector<Candidate> candidates_;  // in the order of memory
};

}  // namespace pnpbs
