// SPDX-License-Identifier: BSD-3-Clause
// A plane domain as the user describes it: boundary and inner curves, holes, fixed nodes.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "base/geometry_kind.hpp"
#include "base/space_vectors.hpp"
#include "base/types.hpp"
#include "base/warning.hpp"
#include "domain/domain_base.hpp"
#include "domain/plane/closing_patch.hpp"
#include "domain/plane/curve_source.hpp"
#include "domain/region_index.hpp"
#include "domain/spacing_evaluator.hpp"
#include "sphere/embedding.hpp"

namespace pnpbs {

// A curve between two corners (or a closed one that starts and ends in the same corner): the
// unit in which boundary nodes are laid. Straight between `points` unless `evaluate` is set.
struct BoundaryCurve {
  std::vector<Point<2>> points;    // polyline, first and last are the corners
  std::vector<double> parameters;  // of the points, if evaluate is set
  CurveFunction evaluate;          // the true curve, or empty
  std::int64_t corner_begin;       // index into PlaneDomain::corners()
  std::int64_t corner_end;         //
  std::int32_t tag;
  bool left_inside;   // is the domain on the left of the way from begin to end?
  bool right_inside;  // both: an inner curve
  std::string name;   // for messages: "segment 12", "curve 3", ...
  // The faces on both sides, numbered from 1 among those inside; 0 outside. (Curves divide the
  // inside into faces.)
  std::int32_t left_face = 0;
  std::int32_t right_face = 0;
  std::int32_t left_region = 0;  // tags, 0 where there is none
  std::int32_t right_region = 0;

  // Does the domain lie on one side only?
  bool bounds() const { return left_inside != right_inside; }
};

struct Corner {
  Point<2> position;
  std::int32_t tag;
  std::string name;  // for messages: "vertex 17"
};

// Both times d where it is.
struct SimplifyRule {
  double tolerance;  // how far a vertex that is left out may lie from the curve
  double smallest;   // closed curves of less extent are left out
};

struct LeftOut {
  std::int64_t vertices = 0;  // those of curves left out included
  std::int64_t curves = 0;
};

// What check() finds out.
struct ResolvedDomain {
  std::vector<Corner> corners;
  std::vector<BoundaryCurve> curves;
  std::vector<FixedNode<2>> fixed_nodes;
  std::vector<std::int32_t> fixed_node_faces;  // that they lie in; see BoundaryCurve
  std::vector<Warning> warnings;
  Box<2> bounds{};
  double area = 0;
  std::shared_ptr<const RegionIndex<2>> regions;  // null if none has a tag
};

// Or a domain on a sphere, in a chart of it: then all coordinates are those of the chart. The point
// that it is projected from lies outside or, if no curve bounds the domain, is in the middle of
// what closes the whole sphere.
class PlaneDomain : public DomainBase<2> {
 public:
  PlaneDomain() = default;
  explicit PlaneDomain(const StereographicChart& chart) : embedding_(chart) {}

  const Embedding<2>& embedding() const { return embedding_; }
  GeometryKind kind() const {
    return embedding_.is_sphere() ? GeometryKind::sphere : GeometryKind::plane;
  }

  // On a sphere, and nothing bounds it?
  bool is_whole_sphere() const;
  // Closes a whole sphere, in place of how it was closed before. Throws Error(ErrorKind::domain)
  // where something of the domain lies in the patch.
  void close(const ClosingPatch& patch);
  // What of the patch counts later; null if the sphere is not closed yet.
  struct Closing {
    double edge, beyond, margin, d;  // of ClosingPatch
  };
  const Closing* closing() const { return closing_ ? &*closing_ : nullptr; }
  // Of its nodes, those of the patch; 0 if it is not closed.
  std::int64_t patch_nodes() const {
    return closing_ ? std::ssize(given_nodes_) - static_cast<std::int64_t>(open_nodes_) + 3 : 0;
  }
  // Has what the user gives of a whole sphere no point so far out in the chart?
  bool leaves_room_beyond(double edge) const;
  // Is a boundary node or a fixed one at that place of the patch?
  bool is_in_patch(const Point<2>& u) const {
    return closing_ && dot(u, u) >= closing_->edge * closing_->edge;
  }
  // Is it, in that part of the patch whose nodes move in the finish?
  bool is_in_margin(const Point<2>& u) const {
    return is_in_patch(u) && dot(u, u) < closing_->margin * closing_->margin;
  }
  // Is the place one that only nodes of the patch may have? While its margin is free, in the rest
  // of it.
  bool is_closed_at(const Point<2>& u, bool margin_is_free) const {
    if (!closing_) return false;
    const double edge = margin_is_free ? closing_->margin : closing_->beyond;
    return dot(u, u) > edge * edge;
  }
  // The bounds of a closed one that is larger in the chart. After check().
  void take_bounds(const Box<2>& bounds) { resolved_.bounds = bounds; }

  // Building; see pnpbs.h for what each means. They throw Error(ErrorKind::argument) naming
  // the argument and its value, and leave the domain as it was.
  void add_polyline(CurveRole role, bool closed, std::int64_t n, const double* xy,
                    const std::int32_t* tags, double corner_angle);
  // On a sphere, the same by the shortest ways from point to point.
  void add_great_circles(CurveRole role, bool closed, const std::vector<Point<3>>& vertices,
                         const std::int32_t* tags, double corner_angle);
  void add_arc(CurveRole role, const Point<2>& centre, double radius, double begin, double end,
               std::int32_t tag);
  void add_curve(CurveRole role, CurveFunction curve, double begin, double end, std::int32_t tag);
  // first_number: what the user calls vertex 0 in messages (1 for a .poly numbered from 1).
  void add_pslg(std::int64_t vertices, const double* xy, const std::int32_t* vertex_tags,
                std::int64_t segments, const std::int64_t* segment_ends,
                const std::int32_t* segment_tags, std::int64_t holes, const double* hole_points,
                std::int64_t first_number = 0);
  // Of all graphs, degrees.
  void set_corner_angle(double corner_angle);
  // Leaves out what is finer than d of what has been given so far; all or, if it throws, nothing.
  LeftOut simplify(const LocalSpacingEvaluator<2>& spacing, const SimplifyRule& rule);

  // Checks everything and resolves corners, curves and sides; does nothing if nothing changed
  // since the last time. Throws Error(ErrorKind::domain).
  void check();

  // Valid after check(). Corners come in the order in which they were given, curves likewise.
  const std::vector<Corner>& corners() const { return resolved_.corners; }
  const std::vector<BoundaryCurve>& curves() const { return resolved_.curves; }
  // Fixed nodes that are not corners.
  const std::vector<FixedNode<2>>& fixed_nodes() const { return resolved_.fixed_nodes; }
  // Of each the face that it lies in; see BoundaryCurve.
  const std::vector<std::int32_t>& fixed_node_faces() const { return resolved_.fixed_node_faces; }
  const std::vector<Warning>& warnings() const { return resolved_.warnings; }
  // Holds all curves, true ones too.
  const Box<2>& bounds() const { return resolved_.bounds; }
  double area() const { return resolved_.area; }  // in the chart, of a domain on a sphere
  // Of the tags of regions; null if none has one.
  const RegionIndex<2>* regions() const { return resolved_.regions.get(); }

 private:
  void add_source(CurveSource source);
  void add_way(CurveSource& source, const std::vector<Point<3>>& vertices,
               const std::vector<std::int32_t>& tags, std::int64_t v, std::int64_t next_v) const;

  void check_open_sphere();
  void follow_patch();
  void reject_what_is_in(const ClosingPatch& patch) const;
  template <class Visit>
  void for_given_points(const Visit& visit) const;
  bool has_boundary_curve() const;

  Embedding<2> embedding_;
  std::optional<Closing> closing_;
  std::size_t open_sources_ = 0, open_nodes_ = 0;  // of a closed sphere, those given
  std::vector<CurveSource> sources_;
  double corner_angle_ = 0;  // of graphs
  std::int64_t curves_given_ = 0, graphs_given_ = 0;
  ResolvedDomain resolved_;
};

// Of a checked domain on a sphere, along the sphere.
double area_on_sphere(const PlaneDomain& domain);

}  // namespace pnpbs
