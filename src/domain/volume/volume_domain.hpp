// SPDX-License-Identifier: BSD-3-Clause
// A volume's domain as the user describes it: boundary and inner surfaces, inner curves, holes,
// fixed nodes.
#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "base/geometry_kind.hpp"
#include "base/warning.hpp"
#include "domain/domain_base.hpp"
#include "domain/region_index.hpp"
#include "domain/volume/features.hpp"
#include "domain/volume/inner_curves.hpp"
#include "formats/surface_triangles.hpp"
#include "geometry/volume/surface_index.hpp"
#include "implicit/level_set.hpp"
#include "implicit/repaired_body.hpp"
#include "sphere/embedding.hpp"
#include "surfaces/triangulation.hpp"

namespace pnpbs {

// What a domain comes to, in numbers.
struct VolumeSummary {
  Box<3> bounds{};
  double volume = 0;
  double area = 0;  // of what bounds it, or of the surfaces alone
  std::int64_t triangles = 0;
  std::int64_t components = 0;  // surfaces that are connected by edges
  std::int64_t patches = 0;
  std::int64_t feature_edges = 0;
  std::int64_t corners = 0;
};

// An edge between nodes of the mesh over which the gradient of a level set jumps.
struct LevelSetCrease {
  std::array<std::int32_t, 2> nodes;  // ascending
  std::array<Point<3>, 2> normals;    // unit, left and right of the way from the first
};

// The level sets whose surfaces triangles are of.
struct LevelSetTriangles {
  std::vector<std::shared_ptr<const LevelSet>> sets;
  std::vector<std::int32_t> of;         // of each facet its set, or -1; empty if there are no sets
  std::vector<LevelSetCrease> creases;  // by their nodes

  const LevelSetCrease* crease(std::int32_t node, std::int32_t other) const;
  const LevelSet* at(std::int32_t facet) const {
    const auto f = static_cast<std::size_t>(facet);
    return f < of.size() && of[f] >= 0 ? sets[static_cast<std::size_t>(of[f])].get() : nullptr;
  }
};

// What check() finds out.
struct ResolvedVolume {
  ResolvedVolume() = default;
  ResolvedVolume(const ResolvedVolume&) = delete;  // the index points to the mesh
  ResolvedVolume& operator=(const ResolvedVolume&) = delete;

  BoundaryMesh<3> mesh;
  SurfaceIndex index;  // of the mesh
  Features features;
  LevelSetTriangles level_sets;
  std::vector<char> approximate;  // of each triangle: see SurfaceSource
  std::vector<FixedNode<3>> fixed_nodes;
  std::vector<Warning> warnings;
  RepairDistances repair;
  // True if the boundary triangles, as turned when given, wind around the inside once and around
  // the outside not at all, but for a sign: a body within another one makes it false, a cavity that
  // is turned against its surroundings does not.
  bool wound_once = true;
  VolumeSummary summary;
  std::unique_ptr<const RegionIndex<3>> regions;  // null if none has a tag
};

class VolumeDomain : public DomainBase<3> {
 public:
  // They throw Error(ErrorKind::argument) naming the argument and its value, and leave the domain
  // as it was. Without tags (null), all are 1. Of several feature angles the smallest holds.
  void add_surface(SurfaceRole role, std::int64_t vertices, const double* xyz,
                   std::int64_t triangles, const std::int64_t* corners, const std::int32_t* tags,
                   double feature_angle = kFeatureAngle);
  // From a file: its triangles and hole points, and the names of its tags.
  void add_surface(SurfaceRole role, const SurfaceTriangles& surface,
                   double feature_angle = kFeatureAngle);
  // Of all triangles that have this tag, whatever they are given with.
  void set_role(std::int32_t tag, SurfaceRole role);
  // Tags of the sides at low x, high x, low y, high y, low z, high z.
  void add_box(const Point<3>& low, const Point<3>& high, const std::array<std::int32_t, 6>& tags);
  void add_box(const Point<3>& low, const Point<3>& high, std::int32_t tag);
  // Of triangles within 1e-4 of the radius from the true surface.
  void add_ball(const Point<3>& centre, double radius, std::int32_t tag);
  void add_cylinder(const Point<3>& begin, const Point<3>& end, double radius, std::int32_t tag);
  // The body where f < 0. It is asked now, and again where nodes are to lie on its surface.
  void add_level_set(LevelSetFunction f, const Box<3>& box, double resolution, std::int32_t tag);
  void add_level_set(std::shared_ptr<const LevelSet> set, std::int32_t tag);
  // Surfaces given by triangles that bound the domain, and that are refused as they are or not
  // wound once around it, are replaced by the surface of the body that they enclose badly;
  // resolution: 0 for the default (implicit/repaired_body.hpp). With `sound_too` sound ones are
  // replaced as well.
  void set_repair(double resolution, bool sound_too = false);
  // Reports the repair of a body that this domain is made of as its own.
  void take_repair_of(const VolumeDomain& body);
  // A curve inside, with a tag for each segment.
  void add_polyline(bool closed, std::int64_t n, const double* xyz, const std::int32_t* tags);
  // Not filled, the domain is its surfaces alone, closed or open, of either role.
  void set_filled(bool filled);
  bool filled() const { return filled_; }
  GeometryKind kind() const { return filled_ ? GeometryKind::body : GeometryKind::surface; }
  static Embedding<3> embedding() { return {}; }

  // Checks everything and finds inside, orientation and features; does nothing if nothing changed
  // since the last time. Throws Error(ErrorKind::domain).
  void check();

  // Valid after check(), as all below.
  const ResolvedVolume& resolved() const { return *resolved_; }
  // First the triangles of the surfaces, in the order in which they were given, with the domain
  // behind those that bound it, and on neither side of surfaces alone; then the segments (a, b, b)
  // of inner curves, and (a, a, a) for each fixed node. All nodes are used.
  const BoundaryMesh<3>& mesh() const { return resolved_->mesh; }
  // Answers what is inside and what is near, whatever d is.
  const SurfaceIndex& index() const { return resolved_->index; }
  // Its facets alone, for who may outlive the domain.
  std::shared_ptr<const FacetIndex<3>> sides() const {
    return {resolved_, &resolved_->index.sides()};
  }
  const Features& features() const { return resolved_->features; }
  const LevelSetTriangles& level_sets() const { return resolved_->level_sets; }
  // Is the facet one that approximates a curved surface given without triangles?
  bool approximates(std::size_t facet) const {
    return facet < resolved_->approximate.size() && resolved_->approximate[facet] != 0;
  }
  const std::vector<FixedNode<3>>& fixed_nodes() const { return resolved_->fixed_nodes; }
  const std::vector<Warning>& warnings() const { return resolved_->warnings; }
  const RepairDistances& repair_distances() const { return resolved_->repair; }
  // Of the tags of regions; null if none has one.
  const RegionIndex<3>* regions() const { return resolved_->regions.get(); }
  const VolumeSummary& summary() const { return resolved_->summary; }
  const Box<3>& bounds() const { return resolved_->summary.bounds; }
  double volume() const { return resolved_->summary.volume; }
  double area() const { return resolved_->summary.area; }
  double measure() const { return filled_ ? volume() : area(); }

 private:
  std::unique_ptr<ResolvedVolume> resolve() const;
  std::unique_ptr<ResolvedVolume> resolve_if_sound() const;
  std::unique_ptr<ResolvedVolume> resolve_repaired() const;
  std::vector<SurfaceSource> repaired_surfaces(std::vector<Warning>& warnings,
                                               RepairDistances& distances) const;
  void add_source(SurfaceSource source, const char* kind, std::int64_t& given);

  std::vector<SurfaceSource> surfaces_;
  std::vector<InnerPolyline> polylines_;
  std::map<std::int32_t, SurfaceRole> roles_;  // of triangles by their tags
  std::int64_t surfaces_given_ = 0, boxes_given_ = 0, balls_given_ = 0, cylinders_given_ = 0,
               level_sets_given_ = 0;
  bool filled_ = true;
  std::optional<double> repair_;  // its resolution
  bool repair_sound_ = false;
  // The repair of another domain's body: see take_repair_of.
  RepairDistances taken_distances_;
  std::vector<Warning> taken_warnings_;
  // Shared by copies, and by all that points into it.
  std::shared_ptr<const ResolvedVolume> resolved_ = std::make_shared<ResolvedVolume>();
};

}  // namespace pnpbs
