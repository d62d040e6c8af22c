// SPDX-License-Identifier: BSD-3-Clause
// A plane domain as the user describes it: boundary and inner curves, holes and fixed nodes.
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
#include "surfaces/solids.hpp"

namespace pnpbs {

// A curve between two corners, or a closed one that begins and ends in one corner. Boundary nodes
// are placed curve by curve. It is straight between `points` unless `evaluate` is set.
struct BoundaryCurve {
  std::vector<Point<2>> points;    // polyline whose first and last points are the corners
  std::vector<double> parameters;  // of the points, if `evaluate` is set
  CurveFunction evaluate;          // the true curve, or empty
  std::int64_t corner_begin;       // index into PlaneDomain::corners()
  std::int64_t corner_end;
  std::int32_t tag;
  bool left_inside;   // is the domain on the left when going from begin to end?
  bool right_inside;  // an inner curve has both
  std::string name;   // for messages, such as "segment 12" or "curve 3"
  // For messages, unless `evaluate` is set: the numbers of the segments between the points, and
  // whether they may have gaps.
  std::vector<std::int64_t> segment_numbers;
  bool reordered = false;
  std::string name_prefix;  // such as "curve 3, "
  std::int32_t source = 0;  // index of the curve or graph that it is part of
  // Faces on both sides, into which curves divide the inside: 1, 2, ... inside, 0 outside.
  std::int32_t left_face = 0;
  std::int32_t right_face = 0;
  std::int32_t left_region = 0;  // tags, 0 if none exists
  std::int32_t right_region = 0;

  // Returns true if the domain lies on exactly one side.
  bool bounds() const { return left_inside != right_inside; }
  // Returns the name of the part from segment `first` to `last`.
  std::string name_of_part(std::size_t first, std::size_t last) const {
    if (segment_numbers.empty()) return name;
    return chain_name(name_prefix, segment_numbers[first], segment_numbers[last], reordered);
  }
};

// An end of boundary curves. It always has a node.
struct Corner {
  Point<2> position;
  std::int32_t tag;
  std::string name;  // for messages, such as "vertex 17"
};

// Tolerances of simplify(). [local d]
struct SimplifyRule {
  double tolerance;  // largest distance of a removed vertex from the curve
  double smallest;   // closed curves of smaller extent are removed
};

// The counts of what simplify() removed.
struct LeftOut {
  std::int64_t vertices = 0;  // includes the vertices of removed curves
  std::int64_t curves = 0;
};

// The result of PlaneDomain::check().
struct ResolvedDomain {
  std::vector<Corner> corners;
  std::vector<BoundaryCurve> curves;
  std::vector<FixedNode<2>> fixed_nodes;
  std::vector<std::int32_t> fixed_node_faces;  // face of each fixed node; see BoundaryCurve
  std::vector<Warning> warnings;
  Box<2> bounds{};
  double area = 0;
  std::shared_ptr<const RegionIndex<2>> regions;  // null if no region has a tag
};

// A domain in the plane, or on a sphere in a chart of it. On a sphere all coordinates are those of
// the chart. The point of projection lies outside the domain; if no curve bounds the domain, it is
// in the middle of the patch that closes the whole sphere.
class PlaneDomain : public DomainBase<2> {
 public:
  PlaneDomain() = default;
  explicit PlaneDomain(const StereographicChart& chart) : embedding_(chart) {}

  const Embedding<2>& embedding() const { return embedding_; }
  GeometryKind kind() const {
    return embedding_.is_sphere() ? GeometryKind::sphere : GeometryKind::plane;
  }

  // Returns true on a sphere without boundary curves.
  bool is_whole_sphere() const;
  // Closes a whole sphere by the patch, and replaces an earlier one. Throws
  // Error(ErrorKind::domain) if a curve or a fixed node lies in the patch.
  void close(const ClosingPatch& patch);
  // The radii and the spacing of the closing patch; see ClosingPatch.
  struct Closing {
    double edge, beyond, margin, d;
  };
  // Returns null if the sphere is not closed yet.
  const Closing* closing() const { return closing_ ? &*closing_ : nullptr; }
  // Returns the number of nodes of the patch; 0 if the domain is not closed.
  std::int64_t patch_nodes() const {
    return closing_ ? std::ssize(given_nodes_) - static_cast<std::int64_t>(open_nodes_) + 3 : 0;
  }
  // Returns true if all points that the user gave lie nearer to the chart's origin than `edge`.
  bool leaves_room_beyond(double edge) const;
  // Returns true if u, the position of a boundary node or of a fixed node, belongs to the patch.
  bool is_in_patch(const Point<2>& u) const {
    return closing_ && dot(u, u) >= closing_->edge * closing_->edge;
  }
  // Returns true if u belongs to the part of the patch whose nodes move in the finish.
  bool is_in_margin(const Point<2>& u) const {
    return is_in_patch(u) && dot(u, u) < closing_->margin * closing_->margin;
  }
  // Returns true if only nodes of the patch may be at u. While the margin is free, only the part of
  // the patch beyond it is reserved.
  bool is_closed_at(const Point<2>& u, bool margin_is_free) const {
    if (!closing_) return false;
    const double edge = margin_is_free ? closing_->margin : closing_->beyond;
    return dot(u, u) > edge * edge;
  }
  // Sets the bounds to those of a closed domain that is larger in the chart. Call after check().
  void take_bounds(const Box<2>& bounds) { resolved_.bounds = bounds; }

  // Functions that describe the domain; pnpbs.h documents them. They throw
  // Error(ErrorKind::argument), with the argument and its value, and then leave the domain
  // unchanged.
  void add_polyline(CurveRole role, bool closed, std::int64_t n, const double* xy,
                    const std::int32_t* tags, double corner_angle);
  // Adds a polyline on a sphere whose vertices are joined by arcs of great circles.
  void add_great_circles(CurveRole role, bool closed, const std::vector<Point<3>>& vertices,
                         const std::int32_t* tags, double corner_angle);
  void add_arc(CurveRole role, const Point<2>& centre, double radius, double begin, double end,
               std::int32_t tag);
  void add_curve(CurveRole role, CurveFunction curve, double begin, double end, std::int32_t tag);
  // `first_number` is the user's number of vertex 0 in messages (1 for a .poly file numbered from
  // 1).
  void add_pslg(std::int64_t vertices, const double* xy, const std::int32_t* vertex_tags,
                std::int64_t segments, const std::int64_t* segment_ends,
                const std::int32_t* segment_tags, std::int64_t holes, const double* hole_points,
                std::int64_t first_number = 0);
  // Sets the angle at which vertices of graphs are corners. [degrees]
  void set_corner_angle(double corner_angle);
  // Sets the distance up to which loose points are moved onto curves (plane/snapping.hpp).
  void set_snap(double length);
  // Splits curves where they meet: the solids that they describe become regions of one domain.
  // `overlap` decides the tags of regions in several solids.
  void set_fragment(OverlapRule overlap);
  // Removes details finer than d from what was given until now (plane/simplify.hpp). Leaves the
  // domain unchanged if it throws.
  LeftOut simplify(const LocalSpacingEvaluator<2>& spacing, const SimplifyRule& rule);

  // Checks the domain and gives a tag to the parts of its outline where a function is negative
  // (plane/outline_tags.hpp). Returns their number. Leaves the domain unchanged if it throws.
  std::int64_t tag_outline(
      const std::function<void(std::int64_t n, const Point<2>* x, double* values)>& where,
      std::int32_t tag);

  // Checks the domain and resolves corners, curves and sides. Does nothing if nothing changed since
  // the last call. Throws Error(ErrorKind::domain).
  void check();

  // Results, valid after check(). Corners and curves are in the order in which they were given.
  const std::vector<Corner>& corners() const { return resolved_.corners; }
  const std::vector<BoundaryCurve>& curves() const { return resolved_.curves; }
  const std::vector<FixedNode<2>>& fixed_nodes() const { return resolved_.fixed_nodes; }
  // Returns for each fixed node the face in which it lies; see BoundaryCurve.
  const std::vector<std::int32_t>& fixed_node_faces() const { return resolved_.fixed_node_faces; }
  const std::vector<Warning>& warnings() const { return resolved_.warnings; }
  // Returns a box that contains all curves, including those of smooth sources.
  const Box<2>& bounds() const { return resolved_.bounds; }
  double area() const { return resolved_.area; }  // in the chart, for a domain on a sphere
  // Returns the index of region tags; null if no region has a tag.
  const RegionIndex<2>* regions() const { return resolved_.regions.get(); }

 private:
  void add_source(CurveSource source);
  void add_great_circle_arc(CurveSource& source, const std::vector<Point<3>>& vertices,
                            const std::vector<std::int32_t>& tags, std::int64_t v,
                            std::int64_t next_v) const;

  void check_open_sphere();
  void check_periodic();
  void follow_patch();
  void require_patch_empty(const ClosingPatch& patch) const;
  template <class Visit>
  void for_given_points(const Visit& visit) const;
  bool has_boundary_curve() const;

  Embedding<2> embedding_;
  std::optional<Closing> closing_;
  // On a closed sphere, the number of sources and nodes that the user gave.
  std::size_t open_sources_ = 0, open_nodes_ = 0;
  std::vector<CurveSource> sources_;
  double corner_angle_ = 0;              // of graphs
  std::optional<double> snap_;           // the default is kSnap
  std::optional<OverlapRule> fragment_;  // set if curves are split where they meet
  std::int64_t curves_given_ = 0, graphs_given_ = 0;
  ResolvedDomain resolved_;
};

// Returns the area of a checked domain on a sphere, measured on the sphere.
double area_on_sphere(const PlaneDomain& domain);

}  // namespace pnpbs
