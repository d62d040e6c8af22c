// SPDX-License-Identifier: BSD-3-Clause
#include "domain/volume/volume_resolver.hpp"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <limits>
#include <map>
#include <numeric>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "base/error.hpp"
#include "base/index.hpp"
#include "base/limits.hpp"
#include "base/point_text.hpp"
#include "base/space_vectors.hpp"
#include "domain/domain_size.hpp"
#include "domain/region_points.hpp"
#include "domain/volume/features.hpp"
#include "domain/volume/volume_domain.hpp"
#include "geometry/boundary_mesh.hpp"
#include "geometry/volume/triangles.hpp"
#include "geometry/volume/welding.hpp"
#include "predicates/expansion.hpp"
#include "surfaces/arrangement.hpp"
#include "surfaces/nesting.hpp"
#include "surfaces/surface_checks.hpp"
#include "surfaces/surface_edges.hpp"
#include "surfaces/thin_triangles.hpp"
#include "surfaces/triangulation.hpp"

namespace pnpbs {
namespace {

void warn_of_short_creases(ResolvedVolume& resolved) {
  const auto& creases = resolved.features.short_creases;
  if (creases.empty()) return;
  const Point<3>& first =
      resolved.mesh.nodes[static_cast<std::size_t>(creases.front()[0])].position;
  resolved.warnings.emplace_back(
      WarningCode::creases_ignored,
      "treated as roughness, not as features: " + std::to_string(creases.size()) +
          " sharp edges in short creases, the first at " + point_text(first),
      std::ssize(creases));
}

// Finds the features with the smallest feature angle of all surfaces. Between triangles of one
// level set the normals are not used, since they also turn at bends that the triangles do not
// resolve. There the gradient of f determines the edges.
void find_features_of(const std::vector<SurfaceSource>& surfaces, ResolvedVolume& resolved) {
  std::vector<double> angles;
  for (const SurfaceSource& surface : surfaces)
    if (!surface.level_set) angles.push_back(surface.feature_angle);
  if (angles.empty()) angles.push_back(kFeatureAngle);
  const auto [smallest, largest] = std::minmax_element(angles.begin(), angles.end());
  if (*smallest < *largest)
    resolved.warnings.emplace_back(WarningCode::feature_angle,
                                   "the smallest feature_angle, " + number_text(*smallest) +
                                       " degrees, holds for all surfaces",
                                   0, *smallest);
  SmoothSurfaces smooth{resolved.level_sets.of, {}};
  for (const LevelSetCrease& crease : resolved.level_sets.creases)
    smooth.creases.push_back(crease.nodes);
  resolved.features = find_features(resolved.mesh, *smallest, smooth);
  const Features& features = resolved.features;
  resolved.summary.patches = features.patches;
  for (const FeatureCurve& curve : features.curves)
    resolved.summary.feature_edges += static_cast<std::int64_t>(curve.nodes.size()) - 1;
  resolved.summary.corners = static_cast<std::int64_t>(features.corners.size());
  warn_of_short_creases(resolved);
}

// Returns the creases of all surfaces. Vertices are numbered consecutively over the surfaces;
// `joined` maps each to the vertex to which it is welded.
std::vector<SurfaceCrease> join_creases(const std::vector<SurfaceSource>& surfaces,
                                        const std::vector<std::int32_t>& joined) {
  std::vector<SurfaceCrease> creases;
  std::int32_t first = 0;
  for (const SurfaceSource& surface : surfaces) {
    for (SurfaceCrease crease : surface.creases) {
      for (std::int32_t& v : crease.vertices) v = joined[index(first + v)];
      creases.push_back(crease);
    }
    first += static_cast<std::int32_t>(surface.vertices.size());
  }
  return creases;
}

// Returns the creases between mesh nodes, in the order of these nodes. `node` maps vertices to
// nodes, or to -1.
std::vector<LevelSetCrease> creases_between(const std::vector<SurfaceCrease>& creases,
                                            const std::vector<std::int32_t>& node) {
  std::vector<LevelSetCrease> between;
  for (const SurfaceCrease& crease : creases) {
    const std::int32_t a = node[index(crease.vertices[0])], b = node[index(crease.vertices[1])];
    if (a < 0 || b < 0 || a == b) continue;
    const auto& [left, right] = crease.normals;
    between.push_back(a < b ? LevelSetCrease{{a, b}, {left, right}}
                            : LevelSetCrease{{b, a}, {right, left}});
  }
  std::sort(between.begin(), between.end(),
            [](const LevelSetCrease& a, const LevelSetCrease& b) { return a.nodes < b.nodes; });
  return between;
}

// Bounding box, volume and area of a domain.
struct VolumeExtent {
  Box<3> bounds;
  double volume;
  double area;  // of the boundary and of surfaces alone
};

// A compensated sum.
class Sum {
 public:
  void add(double term) {
    const TwoTerms next = two_sum(sum_.high, term);
    sum_ = {next.high, sum_.low + next.low};
  }
  double value() const { return sum_.high + sum_.low; }

 private:
  TwoTerms sum_{0, 0};
};

// Computes the extent of a mesh whose triangles have their sides set. Sums are compensated and in
// the order of the triangles.
VolumeExtent extent_of(const BoundaryMesh<3>& mesh) {
  Box<3> box = empty_box<3>();
  for (const BoundaryNode<3>& node : mesh.nodes) include(box, node.position);
  const Point<3>& origin = box.low;
  Sum volume, area;
  for (const BoundaryTriangle& facet : mesh.facets) {
    if (facet.front_inside && facet.back_inside) continue;
    const auto& [a, b, c] = corners_of(mesh, facet);
    const Point<3> normal = cross(difference(b, a), difference(c, a));
    const double sign = int{facet.back_inside} - int{facet.front_inside};
    volume.add(sign * dot(difference(a, origin), normal));
    area.add(length(normal));
  }
  return {box, volume.value() / 6, area.value() / 2};
}

class Resolver {
 public:
  using Contacts = GivenVolume::Contacts;

  Resolver(const GivenVolume& given, ResolvedVolume& result)
      : surfaces_(given.surfaces),
        polylines_(given.polylines),
        region_points_(given.region_points),
        fixed_nodes_(given.fixed_nodes),
        filled_(given.filled),
        contacts_(given.filled ? given.contacts : Contacts::none),
        overlap_(given.overlap),
        gap_(given.gap),
        result_(result) {}

  void run(const GivenVolume& given) {
    require_surfaces();
    surface_ = join_surfaces(surfaces_);
    give_roles(surface_, given.roles);
    for (const SurfaceSource& surface : surfaces_)
      for (const Warning& warning : surface.warnings) result_.warnings.push_back(warning);
    if (!filled_)  // surfaces alone separate nothing
      for (SurfaceTriangle& triangle : surface_.triangles) triangle.inner = true;
    measure();
    weld();
    remove_thin_triangles(surface_, kSameVertex * size_, result_.warnings);
    if (!splits()) remove_duplicate_triangles(surface_, result_.warnings);
    require_triangles_of_all();
    if (splits()) {
      split();
    } else if (filled_) {
      find_roles_of_dividing(surface_);
      find_roles_by_location(surface_);
    }
    require_boundary();
    SurfaceEdges edges(surface_);
    require_closed_boundary(surface_, edges);
    warn_of_touching_vertices(surface_, edges, result_.warnings);
    orient(edges);
    if (!splits()) {
      tree_ = tree_of(surface_);
      reject_crossings(surface_, tree_, filled_);
      segments_ = make_segments(polylines_, curve_vertices_, surface_.vertices);
    }
    check_segments(segments_, surface_, tree_, kSamePoint * size_);
    regions_.emplace(surface_, edges, tree_);
    if (splits()) {
      find_solids_around(*regions_);
    } else {
      inside_ = inside_by_parity(surface_, *regions_);
      result_.wound_once = is_wound_once();
    }
    turn_outwards();
    apply_region_points();
    make_mesh();
    find_features_of(surfaces_, result_);
  }

 private:
  // ------------------------------------------------------------ input
  void require_surfaces() const {
    if (surfaces_.empty()) reject_domain("the domain has no surfaces");
    std::size_t vertices = fixed_nodes_.size(), triangles = 0;
    for (const SurfaceSource& surface : surfaces_) {
      vertices += surface.vertices.size();
      triangles += surface.triangles.size();
    }
    for (const InnerPolyline& curve : polylines_) vertices += curve.points.size();
    if (vertices >= std::size_t{1} << 31) reject_domain("the domain has 2^31 vertices or more");
    if (triangles >= std::size_t{1} << 30) reject_domain("the domain has 2^30 triangles or more");
  }

  void require_boundary() const {
    if (filled_ && std::all_of(surface_.triangles.begin(), surface_.triangles.end(),
                               [](const SurfaceTriangle& triangle) { return triangle.inner; }))
      reject_domain("the domain has no boundary surface, only inner ones");
  }

  void measure() {
    Box<3> box = empty_box<3>();
    for (const SurfaceTriangle& triangle : surface_.triangles)
      for (const std::int32_t v : triangle.vertices) include(box, surface_.vertices[v]);
    size_ = size_of(box);
    require_domain_size(size_);
    require_near_origin<3>(size_, box.low);
    require_near_origin<3>(size_, box.high);
  }

  // ------------------------------------------------------------ welding
  // Welds points of surfaces, then of curves, then fixed nodes; later points take earlier
  // positions.
  void weld() {
    const std::size_t vertices = surface_.vertices.size();
    std::vector<Point<3>>& points = surface_.vertices;
    for (const InnerPolyline& curve : polylines_)
      points.insert(points.end(), curve.points.begin(), curve.points.end());
    const std::size_t curve_points = points.size() - vertices;
    for (const FixedNode<3>& node : fixed_nodes_) points.push_back(node.position);
    const std::vector<std::int32_t> joined = weld_points(points, kSameVertex * size_);
    for (SurfaceTriangle& triangle : surface_.triangles)
      for (std::int32_t& v : triangle.vertices) v = joined[v];
    creases_ = join_creases(surfaces_, joined);
    warn_of_near_vertices(joined, vertices);
    const auto first = joined.begin() + static_cast<std::ptrdiff_t>(vertices);
    curve_vertices_.assign(first, first + static_cast<std::ptrdiff_t>(curve_points));
    fixed_vertices_.assign(first + static_cast<std::ptrdiff_t>(curve_points), joined.end());
    require_distinct_fixed_nodes();
  }

  void warn_of_near_vertices(const std::vector<std::int32_t>& joined, std::size_t vertices) {
    std::int64_t count = 0;
    MessageText first;
    for (std::size_t v = 0; v < vertices; ++v) {
      if (surface_.vertices[v] == surface_.vertices[joined[v]]) continue;
      if (count++ == 0)
        first = surface_.vertex_name(static_cast<std::int32_t>(v)) + " and " +
                surface_.vertex_name(joined[v]);
    }
    if (count == 0) return;
    result_.warnings.emplace_back(
        WarningCode::vertices_merged,
        std::to_string(count) + (count == 1 ? " vertex lies" : " vertices lie") + " within " +
            rounded_text(kSameVertex * size_) + " of another and " + (count == 1 ? "is" : "are") +
            " merged with it; the first are " + first,
        count, kSameVertex * size_);
  }

  void require_distinct_fixed_nodes() const {
    std::map<std::int32_t, std::size_t> node_at;
    for (std::size_t i = 0; i < fixed_nodes_.size(); ++i) {
      const auto [entry, is_new] = node_at.try_emplace(fixed_vertices_[i], i);
      if (is_new) continue;
      const FixedNode<3>& a = fixed_nodes_[entry->second];
      const FixedNode<3>& b = fixed_nodes_[i];
      reject_domain(a.name + " and " + b.name +
                    (a.position == b.position ? " are both at " + point_text(a.position)
                                              : " are too close, at " + point_text(a.position) +
                                                    " and " + point_text(b.position)));
    }
  }

  void require_triangles_of_all() const {
    std::vector<char> has_any(surfaces_.size(), 0);
    for (const SurfaceTriangle& triangle : surface_.triangles) has_any[triangle.source] = 1;
    for (std::size_t s = 0; s < surfaces_.size(); ++s)
      if (!has_any[s])
        throw BrokenSurface("all triangles of " + surfaces_[s].name + " are smaller than " +
                            rounded_text(kSameVertex * size_) +
                            ", which is negligible in a domain of size " + number_text(size_));
  }

  // ------------------------------------------------------------ solids
  bool splits() const { return contacts_ != Contacts::none; }

  // Splits the surfaces where they meet, and determines the roles of the pieces from the solids on
  // both sides of them.
  void split() {
    solids_.emplace(surface_);
    const ArrangementSummary summary = arrange_surfaces();
    for (std::int32_t t = 0; t < triangle_count(); ++t)
      parts_.push_back({t, surface_.triangles[t]});
    warn_of_tolerance(summary);
    const SurfaceEdges edges(surface_);
    tree_ = tree_of(surface_);
    if (summary.rounds == 0)
      reject_crossings(surface_, tree_, filled_);  // They may have been left alone.
    const SurfaceRegions regions(surface_, edges, tree_);
    if (contacts_ == Contacts::touching) require_attached(edges);
    find_solids_around(regions);
    for (std::int32_t t = 0; t < triangle_count(); ++t) {
      SurfaceTriangle& triangle = surface_.triangles[t];
      triangle.inner = inside_[regions.front(t)] == inside_[regions.back(t)];
      triangle.by_place = triangle.dividing = false;
    }
  }

  // Splits the surfaces, and curves and fixed nodes with them.
  ArrangementSummary arrange_surfaces() {
    const std::vector<CurveSegment> given =
        make_segments(polylines_, curve_vertices_, surface_.vertices);
    std::vector<ArrangedSegment> curves;
    for (const CurveSegment& segment : given)
      curves.push_back({segment.ends, static_cast<std::int32_t>(curves.size())});
    for (const std::int32_t v : fixed_vertices_)
      curves.push_back({{v, v}, static_cast<std::int32_t>(curves.size())});
    const SplitAt at = contacts_ == Contacts::any ? SplitAt::any_point : SplitAt::contacts;
    const ArrangementSummary summary =
        arrange(surface_, curves, {kSameVertex * size_, at, gap_}, parts_);
    for (const auto& [ends, number] : curves) {
      if (index(number) < given.size()) {
        segments_.push_back(given[index(number)]);
        segments_.back().ends = ends;
      } else {
        fixed_vertices_[index(number) - given.size()] = ends[0];
      }
    }
    return summary;
  }

  void warn_of_tolerance(const ArrangementSummary& summary) {
    if (summary.tolerance <= kSameVertex * size_) return;
    const bool by_gap = summary.tolerance == gap_ / kContactReach;
    if (by_gap && summary.covered == 0) return;
    const double within = by_gap ? gap_ : summary.tolerance;
    result_.warnings.emplace_back(
        WarningCode::vertices_merged,
        std::string(by_gap ? "" : "the coordinates have few digits, so that ") +
            "surfaces within " + rounded_text(within) + " of each other became one where they meet",
        summary.covered, within);
  }

  // Rejects a surface that ends inside or outside of others, because it may be a body with a hole.
  // Surfaces with the role inner may end anywhere.
  void require_attached(const SurfaceEdges& edges) const {
    for (std::size_t e = 0; e < edges.count(); ++e)
      if (edges.boundary_sides(e).size() == 1 && edges.sides(e).size() == 1)
        throw BrokenSurface(surface_.triangle_name(edges.sides(e)[0].triangle) + " is open");
  }

  // Rejects holes that leave parts of the body connected by edges only.
  void require_closed_around_holes() const {
    Triangulation boundary = surface_;
    boundary.triangles.clear();
    for (std::int32_t t = 0; t < triangle_count(); ++t)
      if (inside_[front_[t]] != inside_[back_[t]]) {
        boundary.triangles.push_back(surface_.triangles[t]);
        boundary.triangles.back().inner = false;
      }
    require_closed_boundary(boundary, SurfaceEdges(boundary));
  }

  // Determines which regions are inside, and their tags.
  void find_solids_around(const SurfaceRegions& regions) {
    const std::vector<std::vector<std::int32_t>> around =
        solids_->around(surface_, parts_, regions);
    inside_.clear();
    for (const std::vector<std::int32_t>& solids : around) {
      if (contacts_ == Contacts::touching && solids.size() > 1)
        throw BrokenSurface(solids_->name(solids[0]) + " and " + solids_->name(solids[1]) +
                            " overlap");
      inside_.push_back(!solids.empty());
    }
    tags_ = tags_by_solids(around, overlap_);
    in_overlap_ = solids_->ends_of_solids(surface_, parts_);
    for (std::int32_t t = 0; t < triangle_count(); ++t)
      if (around[regions.front(t)] != around[regions.back(t)]) in_overlap_[t] = 0;
  }

  // Pieces of several solids can have any orientation, so turning them is not worth a warning.
  void orient(SurfaceEdges& edges) {
    std::vector<Warning> unimportant;
    orient_surfaces(surface_, edges, OneSided::rejected, splits() ? unimportant : result_.warnings);
  }

  // ------------------------------------------------------------ the inside
  // Returns true if the boundary triangles have winding number 1 or -1 inside and 0 outside. The
  // winding number behind a triangle is one more than that in front of it.
  bool is_wound_once() const {
    constexpr std::int32_t kUnknown = std::numeric_limits<std::int32_t>::min();
    std::vector<std::vector<std::pair<std::int32_t, std::int32_t>>> beside(inside_.size());
    for (std::int32_t t = 0; t < triangle_count(); ++t) {
      const std::int32_t front = regions_->front(t), back = regions_->back(t);
      const std::int32_t step = surface_.triangles[t].inner ? 0 : 1;
      if (front == back) continue;
      beside[front].emplace_back(back, step);
      beside[back].emplace_back(front, -step);
    }
    std::vector<std::int32_t> winding(inside_.size(), kUnknown), reached{0};
    winding[0] = 0;
    for (std::size_t next = 0; next < reached.size(); ++next)
      for (const auto& [region, step] : beside[reached[next]])
        if (winding[region] == kUnknown) {
          winding[region] = winding[reached[next]] + step;
          reached.push_back(region);
        }
    for (std::size_t region = 0; region < inside_.size(); ++region)
      if (winding[region] != kUnknown && std::abs(winding[region]) != (inside_[region] ? 1 : 0))
        return false;
    return true;
  }

  // Turns boundary triangles so that the domain lies behind them. Warns of bodies given inside out;
  // a cavity may have either orientation.
  void turn_outwards() {
    std::vector<std::int64_t> turned(surfaces_.size(), 0);
    std::vector<std::string> names;
    for (std::int32_t t = 0; t < triangle_count(); ++t) {
      SurfaceTriangle& triangle = surface_.triangles[t];
      front_.push_back(regions_->front(t));
      back_.push_back(regions_->back(t));
      if (triangle.inner || !inside_[front_[t]]) continue;
      triangle.turn_around();
      std::swap(front_[t], back_[t]);
      const bool cavity = inside_[regions_->outside(regions_->component(t))];
      if (!cavity && !splits() && turned[triangle.source]++ == 0)
        names.push_back(surface_.sources[triangle.source]);
    }
    if (names.empty()) return;
    result_.warnings.emplace_back(WarningCode::triangles_turned,
                                  "oriented inside out and reversed: " + list_text(names, 5),
                                  std::accumulate(turned.begin(), turned.end(), std::int64_t{0}));
  }

  // Returns the region in which region point k lies.
  std::int32_t region_of_point(std::size_t k) const {
    const RegionPoint<3>& it = region_points_[k];
    const std::int32_t on = triangle_at(it.point);
    if (on >= 0)
      reject_domain(name_and_position<3>(it) + " lies on " + surface_.triangle_name(on) +
                    ": move it into the region it stands for");
    return regions_->around(it.point);
  }

  void apply_region_points() {
    const auto given = std::ranges::find(region_points_, false, &RegionPoint<3>::from_file);
    if (!filled_ && given != region_points_.end())
      reject_domain(name_and_position<3>(*given) +
                    ": a domain of surfaces alone has no inside, and so neither holes nor regions");
    if (!filled_) return;
    const auto region_of = [this](std::size_t k) { return region_of_point(k); };
    remove_holes(region_points_, region_of, inside_, result_.warnings);
    region_tags_ = tags_of_parts(region_points_, region_of, inside_, result_.warnings);
    if (!splits()) return;
    require_closed_around_holes();
    region_tags_.resize(inside_.size(), 0);
    for (std::size_t region = 0; region < inside_.size(); ++region)
      if (region_tags_[region] == 0) region_tags_[region] = tags_.of_regions[region];
    for (const auto& [solid, tag] : tags_.of_solids)
      if (!solids_->group_name(solid).empty())
        result_.region_names.emplace_back(tag, solids_->group_name(solid));
  }

  // Returns the first triangle within the tolerance of the point, or -1.
  std::int32_t triangle_at(const Point<3>& x) const {
    const double reach = kSamePoint * size_;
    std::int32_t found = -1;
    tree_.for_near(
        x, [&] { return reach * reach; },
        [&](std::int32_t t) {
          if (found >= 0 && found < t) return;
          if (distance<3>(nearest_on(surface_.corners(t), x), x) <= reach) found = t;
        });
    return found;
  }

  // ------------------------------------------------------------ the mesh
  void make_mesh() {
    if (std::any_of(surfaces_.begin(), surfaces_.end(),
                    [](const SurfaceSource& surface) { return surface.level_set != nullptr; }))
      for (const SurfaceSource& surface : surfaces_)
        result_.level_sets.sets.push_back(surface.level_set);
    number_.assign(surface_.vertices.size(), -1);
    on_surface_.assign(surface_.vertices.size(), 0);
    add_triangles();
    result_.level_sets.creases = creases_between(creases_, number_);
    add_segments();
    add_fixed_nodes();
    const VolumeExtent extent = extent_of(result_.mesh);
    result_.summary.bounds = extent.bounds;
    result_.summary.volume = extent.volume;
    result_.summary.area = extent.area;
    result_.summary.triangles = triangles_kept_;
  }

  std::int32_t node_at(std::int32_t vertex, std::int32_t tag) {
    if (number_[vertex] < 0) {
      number_[vertex] = static_cast<std::int32_t>(result_.mesh.nodes.size());
      result_.mesh.nodes.push_back({surface_.vertices[vertex], tag});
    }
    return number_[vertex];
  }

  void add_triangles() {
    std::vector<char> component_kept(regions_->components(), 0);
    std::vector<std::int64_t> left_out(surfaces_.size(), 0);
    std::vector<RegionFacet<3>> regions;
    kept_.assign(triangle_count(), 0);
    for (std::int32_t t = 0; t < triangle_count(); ++t) {
      SurfaceTriangle& triangle = surface_.triangles[t];
      for (const std::int32_t v : triangle.vertices) on_surface_[v] = 1;
      bool front = inside_[front_[t]], back = inside_[back_[t]];
      if (filled_ && !front && !back) {
        ++left_out[triangle.source];
        continue;
      }
      if (is_in_overlap(t)) {
        kept_[t] = 1;
        continue;
      }
      if (front && !back) {
        triangle.turn_around();
        std::swap(front, back);
        std::swap(front_[t], back_[t]);
      }
      kept_[t] = 1;
      component_kept[regions_->component(t)] = 1;
      BoundaryTriangle facet{{}, triangle.tag, front, back};
      for (int k = 0; k < 3; ++k) facet.nodes[k] = node_at(triangle.vertices[k], triangle.tag);
      result_.mesh.facets.push_back(facet);
      if (!region_tags_.empty())
        regions.push_back({corners_of(result_.mesh, facet),
                           {front, back},
                           {region_tags_[front_[t]], region_tags_[back_[t]]}});
      result_.approximate.push_back(surfaces_[triangle.source].approximates);
      if (!result_.level_sets.sets.empty())
        result_.level_sets.of.push_back(surfaces_[triangle.source].level_set ? triangle.source
                                                                             : -1);
    }
    if (!region_tags_.empty())
      result_.regions = std::make_unique<const RegionIndex<3>>(std::move(regions));
    triangles_kept_ = static_cast<std::int64_t>(result_.mesh.facets.size());
    result_.summary.components = std::count(component_kept.begin(), component_kept.end(), 1);
    std::vector<std::string> names;
    for (std::size_t s = 0; s < surfaces_.size(); ++s)
      if (left_out[s] > 0)
        names.push_back(std::to_string(left_out[s]) + " triangles of " + surfaces_[s].name);
    warn_of_left_out(names);
  }

  // Returns whether a triangle lies where parts of one solid overlap, which become one.
  bool is_in_overlap(std::int32_t t) const {
    return splits() && in_overlap_[t] != 0 && region_tags_[front_[t]] == region_tags_[back_[t]];
  }

  void warn_of_left_out(const std::vector<std::string>& names) {
    if (names.empty()) return;
    result_.warnings.emplace_back(WarningCode::left_out_outside,
                                  "outside the domain and left out: " + list_text(names, 5),
                                  std::ssize(names));
  }

  void add_segments() {
    std::vector<std::string> left_out;
    for (const CurveSegment& segment : segments_) {
      const auto& [a, b] = segment.ends;
      for (const std::int32_t end : segment.ends)
        if (!on_surface_[end]) reject_on_triangle(surface_.vertices[end], segment.name);
      bool inside = segment.along >= 0 && kept_[segment.along];
      if (!filled_ && !inside)
        reject_domain(segment.name + " leaves the surfaces at " + point_text(surface_.vertices[a]) +
                      ": it must follow the edges of their triangles");
      if (segment.along < 0) {
        const Point<3> middle = middle_of<3>(surface_.vertices[a], surface_.vertices[b]);
        inside = inside_[regions_->around(middle)];
      }
      if (!inside) {
        left_out.push_back(segment.name);
        continue;
      }
      const std::int32_t begin = node_at(a, segment.tag), end = node_at(b, segment.tag);
      result_.mesh.facets.push_back({{begin, end, end}, segment.tag, filled_, filled_});
    }
    warn_of_left_out(left_out);
  }

  void reject_on_triangle(const Point<3>& x, const std::string& name) const {
    const std::int32_t t = triangle_at(x);
    if (t < 0) return;
    reject_domain(name + " lies on " + surface_.triangle_name(t) + " at " + point_text(x) +
                  ": it must be a vertex of the surface there");
  }

  void add_fixed_nodes() {
    const BoxTree<3> segments = tree_of(segments_, surface_.vertices);
    for (std::size_t i = 0; i < fixed_nodes_.size(); ++i) {
      const FixedNode<3>& node = fixed_nodes_[i];
      const std::int32_t vertex = fixed_vertices_[i];
      if (number_[vertex] < 0) {
        if (!on_surface_[vertex]) reject_on_triangle(node.position, node.name);
        if (on_surface_[vertex] || !inside_[regions_->around(node.position)])
          reject_domain(node.name + " at " + point_text(node.position) +
                        (filled_ ? " lies outside the domain" : " is no vertex of the surfaces"));
        reject_on_segment(node, segments);
      }
      const std::int32_t n = node_at(vertex, node.tag);
      result_.mesh.nodes[n].tag = node.tag;
      result_.mesh.facets.push_back({{n, n, n}, node.tag, filled_, filled_});
      result_.fixed_nodes.push_back(node);
    }
  }

  void reject_on_segment(const FixedNode<3>& node, const BoxTree<3>& segments) const {
    const double reach = kSamePoint * size_;
    segments.for_near(
        node.position, [&] { return reach * reach; },
        [&](std::int32_t s) {
          const auto& [a, b] = segments_[s].ends;
          const FacetCorners<3> line{surface_.vertices[a], surface_.vertices[b],
                                     surface_.vertices[b]};
          if (distance<3>(nearest_on(line, node.position), node.position) > reach) return;
          reject_domain(node.name + " at " + point_text(node.position) + " lies on " +
                        segments_[s].name + ": make it a vertex there");
        });
  }

  std::int32_t triangle_count() const {
    return static_cast<std::int32_t>(surface_.triangles.size());
  }

  const std::vector<SurfaceSource>& surfaces_;
  const std::vector<InnerPolyline>& polylines_;
  const std::vector<RegionPoint<3>>& region_points_;
  const std::vector<FixedNode<3>>& fixed_nodes_;
  bool filled_;
  Contacts contacts_;
  OverlapRule overlap_;
  double gap_;
  Triangulation surface_;
  double size_ = 0;
  std::vector<std::int32_t> curve_vertices_, fixed_vertices_;  // vertices of the given points
  std::vector<SurfaceCrease> creases_;  // of all sources, by vertices of surface_
  std::vector<CurveSegment> segments_;
  BoxTree<3> tree_;  // of the triangles
  std::optional<SurfaceRegions> regions_;
  std::vector<char> inside_;                // per region
  std::vector<std::int32_t> front_, back_;  // regions on both sides of each triangle
  std::vector<std::int32_t> region_tags_;   // per region; empty if no tag is given
  std::optional<Solids> solids_;            // if surfaces are split
  std::vector<CoveredTriangle> parts_;      // of all solids, as they were given
  SolidTags tags_;
  std::vector<char> in_overlap_;      // per triangle: do parts of one solid overlap there?
  std::vector<char> kept_;            // per triangle: is it part of the domain?
  std::vector<char> on_surface_;      // per vertex: does a triangle have it?
  std::vector<std::int32_t> number_;  // per vertex: its mesh node, or -1
  std::int64_t triangles_kept_ = 0;
  ResolvedVolume& result_;
};

}  // namespace

std::unique_ptr<ResolvedVolume> resolve_volume(const GivenVolume& given) {
  auto resolved = std::make_unique<ResolvedVolume>();
  Resolver(given, *resolved).run(given);
  return resolved;
}

}  // namespace pnpbs
