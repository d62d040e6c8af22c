// SPDX-License-Identifier: BSD-3-Clause
// A domain in space as the user describes it: boundary and inner surfaces, inner curves, holes and
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
#include "surfaces/solids.hpp"
#include "surfaces/triangulation.hpp"

namespace pnpbs {

// Sizes and counts of a checked domain.
struct VolumeSummary {
  Box<3> bounds{};
  double volume = 0;
  double area = 0;  // of the boundary, or of surfaces alone
  std::int64_t triangles = 0;
  std::int64_t components = 0;  // parts of surfaces connected by edges
  std::int64_t patches = 0;
  std::int64_t feature_edges = 0;
  std::int64_t corners = 0;
};

// An edge between nodes of the mesh at which the gradient of a level set jumps.
struct LevelSetCrease {
  std::array<std::int32_t, 2> nodes;  // ascending
  std::array<Point<3>, 2> normals;    // unit; left and right of the direction from the first node
};

// The level sets of the domain, and which triangles belong to them.
struct LevelSetTriangles {
  std::vector<std::shared_ptr<const LevelSet>> sets;
  std::vector<std::int32_t> of;         // level set of each facet, or -1; empty if none exist
  std::vector<LevelSetCrease> creases;  // ordered by their nodes

  const LevelSetCrease* crease(std::int32_t node, std::int32_t other) const;
  const LevelSet* at(std::int32_t facet) const {
    const auto f = static_cast<std::size_t>(facet);
    return f < of.size() && of[f] >= 0 ? sets[static_cast<std::size_t>(of[f])].get() : nullptr;
  }
};

// The result of VolumeDomain::check().
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
  // True if the boundary triangles, as oriented in the input, have winding number 1 or -1
  // inside and 0 outside. A body within another one makes it false; a cavity oriented against its
  // surroundings does not.
  bool wound_once = true;
  VolumeSummary summary;
  std::unique_ptr<const RegionIndex<3>> regions;                   // null if no region has a tag
  std::vector<std::pair<std::int32_t, std::string>> region_names;  // by their tags, from groups
};

struct GivenVolume;

// A domain in space, filled or as surfaces alone.
class VolumeDomain : public DomainBase<3> {
 public:
  // Functions that describe the domain. They throw Error(ErrorKind::argument), with the argument
  // and its value, and then leave the domain unchanged. If `tags` is null, all tags are 1. The
  // smallest of several feature angles (degrees) applies to all surfaces.
  void add_surface(SurfaceRole role, std::int64_t vertices, const double* xyz,
                   std::int64_t triangles, const std::int64_t* corners, const std::int32_t* tags,
                   double feature_angle = kFeatureAngle);
  // Adds the surface of a file: its triangles, hole and region points, and the names of its tags.
  void add_surface(SurfaceRole role, const SurfaceTriangles& surface,
                   double feature_angle = kFeatureAngle);
  // Sets the role of all triangles with this tag, in place of the role of their surface.
  void set_role(std::int32_t tag, SurfaceRole role);
  // The tags are those of the sides at low x, high x, low y, high y, low z, high z.
  void add_box(const Point<3>& low, const Point<3>& high, const std::array<std::int32_t, 6>& tags,
               SurfaceRole role = SurfaceRole::boundary);
  void add_box(const Point<3>& low, const Point<3>& high, std::int32_t tag,
               SurfaceRole role = SurfaceRole::boundary);
  // Adds triangles that lie within 1e-4 of the radius of the true surface; so does add_cylinder.
  void add_ball(const Point<3>& centre, double radius, std::int32_t tag,
                SurfaceRole role = SurfaceRole::boundary);
  void add_cylinder(const Point<3>& begin, const Point<3>& end, double radius, std::int32_t tag,
                    SurfaceRole role = SurfaceRole::boundary);
  // Adds the body where f < 0. Evaluates f now and again where nodes are put on its surface.
  void add_level_set(LevelSetFunction f, const Box<3>& box, double resolution, std::int32_t tag);
  void add_level_set(std::shared_ptr<const LevelSet> set, std::int32_t tag);
  // Replaces boundary surfaces that are rejected, or that do not wind once around the domain, by
  // the surface of the body that they approximately enclose. `resolution` 0 means the default
  // (implicit/repaired_body.hpp). With `sound_too`, valid surfaces are replaced as well.
  void set_repair(double resolution, bool sound_too = false);
  // Splits surfaces where they meet: the solids that they describe and the sheets between become
  // regions of one body. `overlap` decides the tags of regions in several solids.
  void set_fragment(OverlapRule overlap);
  // Sets the distance within which surfaces become one where they are split.
  void set_snap(double length);
  // Reports the repair of `body`, from which this domain was made, as a repair of this domain.
  void take_repair_of(const VolumeDomain& body);
  // Adds a curve inside, with one tag per segment.
  void add_polyline(bool closed, std::int64_t n, const double* xyz, const std::int32_t* tags);
  // If not filled, the domain consists of its surfaces alone, which may be open and have any role.
  void set_filled(bool filled);
  bool filled() const { return filled_; }
  GeometryKind kind() const { return filled_ ? GeometryKind::body : GeometryKind::surface; }
  static Embedding<3> embedding() { return {}; }

  // Checks the domain and finds inside, orientation and features. Does nothing if nothing changed
  // since the last call. Throws Error(ErrorKind::domain).
  void check();

  // Results, valid after check().
  const ResolvedVolume& resolved() const { return *resolved_; }
  // Returns the mesh. Its facets are first the triangles, in the order in which they were given;
  // then a facet (a, b, b) for each segment of an inner curve; then (a, a, a) for each fixed node.
  // The domain lies behind boundary triangles, and on neither side of surfaces alone. Every node
  // belongs to a facet.
  const BoundaryMesh<3>& mesh() const { return resolved_->mesh; }
  // Returns the index for queries of the inside and of near facets, independent of d.
  const SurfaceIndex& index() const { return resolved_->index; }
  // Returns the facet index alone. It keeps its data alive beyond the domain.
  std::shared_ptr<const FacetIndex<3>> sides() const {
    return {resolved_, &resolved_->index.sides()};
  }
  const Features& features() const { return resolved_->features; }
  const LevelSetTriangles& level_sets() const { return resolved_->level_sets; }
  // Returns true if the facet approximates a curved surface that was not given by triangles.
  bool approximates(std::size_t facet) const {
    return facet < resolved_->approximate.size() && resolved_->approximate[facet] != 0;
  }
  const std::vector<FixedNode<3>>& fixed_nodes() const { return resolved_->fixed_nodes; }
  const std::vector<Warning>& warnings() const { return resolved_->warnings; }
  const RepairDistances& repair_distances() const { return resolved_->repair; }
  // Returns the index of region tags; null if no region has a tag.
  const RegionIndex<3>* regions() const { return resolved_->regions.get(); }
  const VolumeSummary& summary() const { return resolved_->summary; }
  const Box<3>& bounds() const { return resolved_->summary.bounds; }
  double volume() const { return cell_.any() ? cell_volume_ : resolved_->summary.volume; }
  double area() const { return resolved_->summary.area; }
  double measure() const { return filled_ ? volume() : area(); }

 private:
  void check_periodic();
  double volume_of_cell(const std::vector<char>& in_cell) const;
  GivenVolume given() const;
  std::unique_ptr<ResolvedVolume> resolve_touching() const;
  std::unique_ptr<ResolvedVolume> resolve_fragments() const;
  bool has_several_groups() const;
  std::unique_ptr<ResolvedVolume> resolve_if_sound() const;
  std::unique_ptr<ResolvedVolume> resolve_repaired() const;
  std::vector<SurfaceSource> repaired_surfaces(std::vector<Warning>& warnings,
                                               RepairDistances& distances) const;
  void add_source(SurfaceSource source, const char* kind, std::int64_t& given);
  void add_primitive(SurfaceSource source, SurfaceRole role, const char* kind, std::int64_t& given);

  std::vector<SurfaceSource> surfaces_;
  std::vector<InnerPolyline> polylines_;
  std::map<std::int32_t, SurfaceRole> roles_;  // roles of triangles by their tags
  std::int64_t surfaces_given_ = 0, boxes_given_ = 0, balls_given_ = 0, cylinders_given_ = 0,
               level_sets_given_ = 0;
  bool filled_ = true;
  double cell_volume_ = 0;        // volume of one period of a periodic domain
  std::optional<double> repair_;  // resolution of the repair, if one is requested
  bool repair_sound_ = false;
  std::optional<OverlapRule> fragment_;    // set if surfaces are split where they meet
  double snap_ = 0;                        // distance within which they become one there
  std::vector<GroupTag> named_by_groups_;  // regions whose names check() has set
  // The repair of another domain; see take_repair_of().
  RepairDistances taken_distances_;
  std::vector<Warning> taken_warnings_;
  // Shared by copies of the domain and by objects that point into it.
  std::shared_ptr<const ResolvedVolume> resolved_ = std::make_shared<ResolvedVolume>();
};

}  // namespace pnpbs
