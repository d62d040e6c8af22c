// SPDX-License-Identifier: BSD-3-Clause
// Arguments of the user are checked one by one and stored here; check() resolves how they fit
// together.
#include "domain/volume/volume_domain.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <compare>
#include <functional>
#include <limits>
#include <span>
#include <utility>
#include <vector>

#include "base/error.hpp"
#include "base/limits.hpp"
#include "base/space_vectors.hpp"
#include "domain/given_values.hpp"
#include "domain/volume/copies_of_cell.hpp"
#include "domain/volume/feature_nodes.hpp"
#include "domain/volume/features.hpp"
#include "domain/volume/volume_resolver.hpp"
#include "geometry/volume/triangles.hpp"
#include "implicit/level_set.hpp"
#include "implicit/level_set_creases.hpp"
#include "implicit/level_set_surface.hpp"
#include "implicit/repaired_body.hpp"
#include "surfaces/primitives.hpp"

namespace pnpbs {
namespace {

// Computes how far nodes projected onto a level set may be from its triangles.

constexpr std::size_t kPointsAtOnce = 1 << 14;  // most points in one evaluation of f

// Points whose estimated distance is less than this fraction of the largest are not projected.
constexpr double kMayBeFarthest = 0.25;

// Returns the largest distance from from[k] to to(k).
template <class To>
double largest_distance(const std::vector<Point<3>>& from, const To& to) {
  double largest = 0;
  for (std::size_t k = 0; k < from.size(); ++k)
    largest = std::max(largest, distance<3>(from[k], to(k)));
  return largest;
}

// Points and unit normals.
struct Middles {
  std::vector<Point<3>> points, normals;
};

// Returns the centroids of the triangles of the set and the midpoints of their edges. The normal at
// a midpoint is that of one of its two triangles.
Middles middles_of_triangles(const ResolvedVolume& volume, const LevelSet& set) {
  struct Side {
    std::array<std::int32_t, 2> ends;
    std::int32_t facet;
    auto operator<=>(const Side&) const = default;
  };
  const BoundaryMesh<3>& mesh = volume.mesh;
  const auto normal_of = [&](std::int32_t f) {
    return unit_vector(area_normal(corners_of(mesh, mesh.facets[static_cast<std::size_t>(f)])));
  };
  std::vector<Side> sides;
  Middles middles;
  for (std::size_t f = 0; f < mesh.facets.size(); ++f) {
    if (volume.level_sets.at(static_cast<std::int32_t>(f)) != &set) continue;
    middles.points.push_back(centroid(corners_of(mesh, mesh.facets[f])));
    middles.normals.push_back(normal_of(static_cast<std::int32_t>(f)));
    const std::array<std::int32_t, 3>& nodes = mesh.facets[f].nodes;
    for (std::size_t k = 0; k < 3; ++k)
      sides.push_back(
          {{std::min(nodes[k], nodes[(k + 1) % 3]), std::max(nodes[k], nodes[(k + 1) % 3])},
           static_cast<std::int32_t>(f)});
  }
  std::ranges::sort(sides);
  sides.erase(std::unique(sides.begin(), sides.end(),
                          [](const Side& a, const Side& b) { return a.ends == b.ends; }),
              sides.end());
  const auto at = [&](std::int32_t node) {
    return mesh.nodes[static_cast<std::size_t>(node)].position;
  };
  for (const Side& side : sides) {
    middles.points.push_back(halfway(at(side.ends[0]), at(side.ends[1])));
    middles.normals.push_back(normal_of(side.facet));
  }
  return middles;
}

// Estimates distances from the slope of f along the triangles' normals. The estimate is wrong where
// the gradient jumps.
std::vector<double> likely_distances(const LevelSet& set, const Middles& middles) {
  std::vector<double> distances;
  const std::span<const Point<3>> points = middles.points, normals = middles.normals;
  for (std::size_t begin = 0; begin < points.size(); begin += kPointsAtOnce) {
    const std::size_t n = std::min(kPointsAtOnce, points.size() - begin);
    for (const double way :
         set.distances_along(points.subspan(begin, n), normals.subspan(begin, n)))
      distances.push_back(way <= set.resolution() ? way
                                                  : set.resolution());  // also if `way` is NaN
  }
  return distances;
}

double distance_to_triangles(const ResolvedVolume& volume, const LevelSet& set) {
  const Middles middles = middles_of_triangles(volume, set);
  const std::vector<Point<3>>& points = middles.points;
  if (points.empty()) return 0;
  const std::vector<double> likely = likely_distances(set, middles);
  const double farthest = *std::ranges::max_element(likely);
  std::vector<Point<3>> far;
  for (std::size_t k = 0; k < points.size(); ++k)
    if (likely[k] >= kMayBeFarthest * farthest) far.push_back(points[k]);
  std::vector<Point<3>> projected = far;
  set.project(projected, set.resolution());
  return largest_distance(far, [&](std::size_t k) { return projected[k]; });
}

// Returns the largest distance by which project_to_creases() moves midpoints of feature edges.
double distance_to_creases(const ResolvedVolume& volume) {
  const Features& features = volume.features;
  FeatureNodes middles;
  std::vector<Point<3>> before;
  for (std::size_t c = 0; c < features.curves.size(); ++c) {
    const FeatureCurve& curve = features.curves[c];
    for (std::size_t e = 0; e < curve.edge_count(); ++e) {
      const auto at = [&](std::size_t k) {
        return volume.mesh.nodes[static_cast<std::size_t>(curve.nodes[k])].position;
      };
      before.push_back(halfway(at(e), at(e + 1)));
      middles.nodes.push_back({before.back(), 0, -1, static_cast<std::int32_t>(c),
                               curve.first_edge + static_cast<std::int32_t>(e)});
    }
  }
  project_to_creases(volume, middles, std::numeric_limits<double>::infinity());
  return largest_distance(before, [&](std::size_t k) { return middles.nodes[k].position; });
}

// Returns a value for BoundaryMesh::node_distance: twice the largest distance found at sample
// points of the triangles and feature edges. It is at least the effect of rounding and at most the
// resolution of the sets; 0 if none exist.
double largest_node_distance(const ResolvedVolume& volume) {
  constexpr double kSpare = 2, kLeast = 1e-6;  // kLeast in units of the resolution
  double resolution = 0, largest = 0;
  for (const auto& set : volume.level_sets.sets) {
    if (!set) continue;
    resolution = std::max(resolution, set->resolution());
    largest = std::max(largest, distance_to_triangles(volume, *set));
  }
  if (resolution > 0) largest = std::max(largest, distance_to_creases(volume));
  return std::clamp(kSpare * largest, kLeast * resolution, resolution);
}

}  // namespace

using namespace given_values;

namespace {

void require_box(const Box<3>& box) {
  require_point<3>("low", box.low);
  require_point<3>("high", box.high);
  for (int k = 0; k < 3; ++k)
    if (!(box.low[k] < box.high[k]))
      reject(indexed("high", k) + " is " + number_text(box.high[k]) + ", expected more than " +
             indexed("low", k) + ", which is " + number_text(box.low[k]));
}

void require_resolution(const Box<3>& box, double resolution) {
  constexpr double kMaxCells = 1 << 19;
  double shortest = HUGE_VAL;
  for (int k = 0; k < 3; ++k) shortest = std::min(shortest, box.high[k] - box.low[k]);
  const double least = size_of(box) / kMaxCells;
  if (!(resolution >= least && resolution <= shortest))
    reject("resolution is " + number_text(resolution) + ", expected " + rounded_text(least) +
           " to " + rounded_text(shortest) + " in this box");
}

std::vector<std::array<std::int32_t, 3>> read_triangles(std::int64_t triangles,
                                                        const std::int64_t* corners,
                                                        std::int64_t vertices) {
  require_array("corners", corners, triangles);
  std::vector<std::array<std::int32_t, 3>> read(static_cast<std::size_t>(triangles));
  for (std::int64_t t = 0; t < triangles; ++t)
    for (std::int64_t k = 0; k < 3; ++k) {
      const std::int64_t corner = corners[3 * t + k];
      if (corner < 0 || corner >= vertices)
        reject(indexed(indexed("corners", t), k) + " is " + std::to_string(corner) +
               ", expected a vertex from 0 to " + std::to_string(vertices - 1));
      read[static_cast<std::size_t>(t)][static_cast<std::size_t>(k)] =
          static_cast<std::int32_t>(corner);
    }
  return read;
}

}  // namespace

const LevelSetCrease* LevelSetTriangles::crease(std::int32_t node, std::int32_t other) const {
  const std::array<std::int32_t, 2> nodes{std::min(node, other), std::max(node, other)};
  const auto found = std::lower_bound(
      creases.begin(), creases.end(), nodes,
      [](const LevelSetCrease& crease, const auto& wanted) { return crease.nodes < wanted; });
  return found != creases.end() && found->nodes == nodes ? &*found : nullptr;
}

// Names the source by its kind and number, stores it and increments `given`.
void VolumeDomain::add_source(SurfaceSource source, const char* kind, std::int64_t& given) {
  source.name = std::string(kind) + " " + std::to_string(given);
  for (const Point<3>& x : source.vertices)
    if (!is_usable(x))
      reject("the " + std::string(kind) + " reaches " + point_text(x) + ", beyond 1e60");
  surfaces_.push_back(std::move(source));
  ++given;
  checked_ = false;
}

void VolumeDomain::add_primitive(SurfaceSource source, SurfaceRole role, const char* kind,
                                 std::int64_t& given) {
  source.role = role;
  add_source(std::move(source), kind, given);
}

void VolumeDomain::add_surface(SurfaceRole role, std::int64_t vertices, const double* xyz,
                               std::int64_t triangles, const std::int64_t* corners,
                               const std::int32_t* tags, double feature_angle) {
  require_count("vertices", vertices, 3);
  require_count("triangles", triangles, 1);
  require_angle("feature_angle", feature_angle);
  SurfaceSource source;
  source.role = role;
  source.vertices = read_points<3>("coordinates", vertices, xyz);
  source.triangles = read_triangles(triangles, corners, vertices);
  source.tags = read_tags("tags", triangles, tags);
  source.feature_angle = feature_angle;
  add_source(std::move(source), "surface", surfaces_given_);
}

void VolumeDomain::add_surface(SurfaceRole role, const SurfaceTriangles& surface,
                               double feature_angle) {
  std::vector<std::int64_t> corners;
  for (const std::array<std::int32_t, 3>& triangle : surface.triangles)
    corners.insert(corners.end(), triangle.begin(), triangle.end());
  if (surface.divides && role == SurfaceRole::boundary) role = SurfaceRole::dividing;
  add_surface(role, std::ssize(surface.vertices), surface.vertices.data()->data(),
              std::ssize(surface.triangles), corners.data(), surface.tags.data(), feature_angle);
  surfaces_.back().tag_names = surface.tag_names;
  for (std::size_t k = 0; k < surface.holes.size(); ++k)
    add_hole_of_file(surface.holes[k],
                     "hole " + std::to_string(k) + " of " + surfaces_.back().name);
  for (const SurfaceRegion& region : surface.regions)
    add_region_of_file(region.point, region.tag, region.name);
  for (const Warning& warning : surface.warnings) add_warning(warning);
  for (const auto& [tag, name] : surface.tag_names) names().add({2, tag}, name);
}

void VolumeDomain::set_role(std::int32_t tag, SurfaceRole role) {
  require_tag("tag", tag);
  roles_[tag] = role;
  checked_ = false;
}

void VolumeDomain::add_box(const Point<3>& low, const Point<3>& high,
                           const std::array<std::int32_t, 6>& tags, SurfaceRole role) {
  require_box({low, high});
  read_tags("tags", 6, tags.data());
  add_primitive(box_surface(low, high, tags), role, "box", boxes_given_);
}

void VolumeDomain::add_box(const Point<3>& low, const Point<3>& high, std::int32_t tag,
                           SurfaceRole role) {
  require_tag("tag", tag);
  add_box(low, high, {tag, tag, tag, tag, tag, tag}, role);
}

void VolumeDomain::add_ball(const Point<3>& centre, double radius, std::int32_t tag,
                            SurfaceRole role) {
  require_point<3>("centre", centre);
  require_radius(radius);
  require_tag("tag", tag);
  add_primitive(ball_surface(centre, radius, tag), role, "ball", balls_given_);
}

void VolumeDomain::add_cylinder(const Point<3>& begin, const Point<3>& end, double radius,
                                std::int32_t tag, SurfaceRole role) {
  require_point<3>("begin", begin);
  require_point<3>("end", end);
  if (begin == end) reject("begin and end are both " + point_text(begin));
  require_radius(radius);
  require_tag("tag", tag);
  add_primitive(cylinder_surface(begin, end, radius, tag), role, "cylinder", cylinders_given_);
}

void VolumeDomain::add_level_set(LevelSetFunction f, const Box<3>& box, double resolution,
                                 std::int32_t tag) {
  add_level_set(std::make_shared<LevelSet>("level set " + std::to_string(level_sets_given_),
                                           std::move(f), box, resolution),
                tag);
}

void VolumeDomain::add_level_set(std::shared_ptr<const LevelSet> set, std::int32_t tag) {
  require_box(set->box());
  require_resolution(set->box(), set->resolution());
  require_tag("tag", tag);
  SurfaceSource source = level_set_surface(*set, tag);
  add_creases(*set, source);
  source.level_set = set;
  source.approximates = true;
  add_source(std::move(source), "level set", level_sets_given_);
}

void VolumeDomain::set_repair(double resolution, bool sound_too) {
  if (!(resolution >= 0 && std::isfinite(resolution)))
    reject("resolution is " + number_text(resolution) + ", expected a positive number, or 0");
  repair_ = resolution;
  repair_sound_ = sound_too;
  checked_ = false;
}

void VolumeDomain::set_fragment(OverlapRule overlap) {
  fragment_ = overlap;
  checked_ = false;
}

void VolumeDomain::set_snap(double length) {
  if (!(length >= 0 && std::isfinite(length)))
    reject("length is " + number_text(length) + ", expected a positive number, or 0");
  snap_ = length;
  checked_ = false;
}

void VolumeDomain::take_repair_of(const VolumeDomain& body) {
  taken_distances_ = body.repair_distances();
  taken_warnings_.clear();
  for (const Warning& warning : body.warnings())
    if (warning.code == WarningCode::repaired) taken_warnings_.push_back(warning);
  checked_ = false;
}

namespace {

// Returns the part of the surface whose tags satisfy `has`.
SurfaceSource part_of(SurfaceSource surface, const std::function<bool(std::int32_t)>& has) {
  std::vector<std::array<std::int32_t, 3>> triangles;
  std::vector<std::int32_t> tags;
  for (std::size_t t = 0; t < surface.triangles.size(); ++t) {
    if (!has(surface.tags[t])) continue;
    triangles.push_back(surface.triangles[t]);
    tags.push_back(surface.tags[t]);
  }
  surface.triangles = std::move(triangles);
  surface.tags = std::move(tags);
  return surface;
}

}  // namespace

// Returns the surfaces with those to be repaired replaced by one repaired surface. Level sets and
// inner surfaces are kept.
std::vector<SurfaceSource> VolumeDomain::repaired_surfaces(std::vector<Warning>& warnings,
                                                           RepairDistances& distances) const {
  std::vector<SurfaceSource> broken, surfaces;
  for (const SurfaceSource& surface : surfaces_) {
    if (surface.level_set) {
      surfaces.push_back(surface);
      continue;
    }
    const auto is_inner = [&](std::int32_t tag) {
      const auto role = roles_.find(tag);
      return (role == roles_.end() ? surface.role : role->second) == SurfaceRole::inner;
    };
    SurfaceSource inner = part_of(surface, is_inner);
    inner.role = SurfaceRole::inner;
    if (!inner.triangles.empty()) surfaces.push_back(std::move(inner));
    broken.push_back(part_of(surface, [&](std::int32_t tag) { return !is_inner(tag); }));
    if (broken.back().triangles.empty()) broken.pop_back();
  }
  if (broken.empty()) return surfaces;
  RepairedBody body = repaired_body(broken, *repair_);
  warnings.emplace_back(WarningCode::repaired, text_of(body), std::ssize(body.surface.triangles),
                        body.distances.resolution);
  distances = body.distances;
  surfaces.push_back(std::move(body.surface));
  return surfaces;
}

void VolumeDomain::add_polyline(bool closed, std::int64_t n, const double* xyz,
                                const std::int32_t* tags) {
  require_count("n", n, closed ? 3 : 2);
  InnerPolyline curve{"polyline " + std::to_string(polylines_.size()), closed,
                      read_points<3>("coordinates", n, xyz),
                      read_tags("tags", closed ? n : n - 1, tags)};
  require_distinct_neighbours<3>(curve.points, closed);
  polylines_.push_back(std::move(curve));
  checked_ = false;
}

void VolumeDomain::set_filled(bool filled) {
  checked_ = checked_ && filled == filled_;
  filled_ = filled;
}

GivenVolume VolumeDomain::given() const {
  return {surfaces_, roles_, polylines_, region_points_, given_nodes_, filled_};
}

// Returns the domain of the surfaces as they are given or, if several only touch, split there.
std::unique_ptr<ResolvedVolume> VolumeDomain::resolve_touching() const {
  GivenVolume given = this->given();
  try {
    return resolve_volume(given);
  } catch (const BrokenSurface& error) {
    if (!filled_) throw;
    try {
      given.contacts = GivenVolume::Contacts::touching;
      if (has_several_groups()) return resolve_volume(given);
    } catch (const BrokenSurface&) {
      // The error of the surfaces as they are given says more.
    }
    reject_domain(error.message() +
                  "; pnpbs_domain_set_fragment (in the command --fragment) makes several bodies "
                  "and sheets regions of one, and pnpbs_domain_set_repair (--repair) takes the "
                  "body that defective triangles enclose");
  }
}

// Balls become coarser, because splitting takes much longer than a check of each ball.
std::unique_ptr<ResolvedVolume> VolumeDomain::resolve_fragments() const {
  std::vector<SurfaceSource> surfaces = surfaces_;
  for (SurfaceSource& surface : surfaces)
    if (surface.is_ball) surface = coarser_ball(std::move(surface));
  return resolve_volume({surfaces, roles_, polylines_, region_points_, given_nodes_, filled_,
                         GivenVolume::Contacts::any, *fragment_, snap_});
}

bool VolumeDomain::has_several_groups() const {
  return surfaces_.size() > 1 ||
         std::ranges::adjacent_find(surfaces_[0].tags, std::ranges::not_equal_to()) !=
             surfaces_[0].tags.end();
}

// Returns null if the surfaces need a repair. Surfaces alone are valid if they would bound a valid
// body.
std::unique_ptr<ResolvedVolume> VolumeDomain::resolve_if_sound() const {
  if (repair_sound_) return nullptr;
  std::unique_ptr<ResolvedVolume> resolved;
  try {
    resolved =
        filled_ ? resolve_volume(given()) : resolve_volume({surfaces_, roles_, {}, {}, {}, true});
  } catch (const BrokenSurface&) {
    return nullptr;
  }
  if (!resolved->wound_once) return nullptr;
  if (!filled_) resolved = resolve_volume(given());
  resolved->warnings.emplace_back(
      WarningCode::repaired,
      "not repaired: the body is sound as it is given; pnpbs_domain_set_resurfaced (in the command "
      "--resurface) replaces its surface nevertheless",
      0);
  return resolved;
}

std::unique_ptr<ResolvedVolume> VolumeDomain::resolve_repaired() const {
  // The surfaces have their roles already.
  static const std::map<std::int32_t, SurfaceRole> no_roles;
  std::vector<Warning> warnings;
  RepairDistances distances;
  const std::vector<SurfaceSource> surfaces = repaired_surfaces(warnings, distances);
  std::unique_ptr<ResolvedVolume> resolved =
      resolve_volume({surfaces, no_roles, polylines_, region_points_, given_nodes_, filled_});
  resolved->warnings.insert(resolved->warnings.begin(), warnings.begin(), warnings.end());
  resolved->repair = distances;
  return resolved;
}

// Resolves the copies of a periodic domain as one domain that is not periodic. The volume of the
// cell is less than that of its box by that of the bodies that its boundary surfaces enclose.
void VolumeDomain::check_periodic() {
  if (!filled_) reject_domain("surfaces alone cannot be periodic: pnpbs_domain_set_filled");
  if (!polylines_.empty()) reject_domain("a periodic domain in space has no inner curves");
  for (const SurfaceSource& surface : surfaces_)
    if (surface.level_set) reject_domain("a periodic domain has no level sets");
  // Splitting changes the meaning of boundary surfaces: they are solids then, and no cavities.
  const bool all_inner = roles_.empty() && std::ranges::all_of(surfaces_, [](const auto& surface) {
                           return surface.role == SurfaceRole::inner;
                         });
  const bool divides = fragment_ || (all_inner && !repair_);
  CopiesOfSurfaces copies = copies_of_cell(cell_, reach_, divides, side_tags_, flat_, surfaces_,
                                           region_points_, given_nodes_);
  VolumeDomain copied = *this;
  copied.cell_ = {};
  if (copies.touch && !fragment_) copied.fragment_ = OverlapRule::last;
  copied.surfaces_ = std::move(copies.surfaces);
  copied.region_points_ = std::move(copies.region_points);
  copied.given_nodes_ = std::move(copies.fixed_nodes);
  copied.checked_ = false;
  copied.check();
  resolved_ = copied.resolved_;
  named_by_groups_ = copied.named_by_groups_;
  names() = copied.names();
  cell_volume_ = volume_of_cell(copies.in_cell);
  checked_ = true;
}

// Returns the volume of one period: that of the box and, with a negative sign, that of the cavities
// that surfaces in the cell enclose. The facets are those of the surfaces, in their order, unless
// surfaces were split; then there are no cavities.
double VolumeDomain::volume_of_cell(const std::vector<char>& in_cell) const {
  double volume = 1;
  for (std::size_t k = 0; k < 3; ++k) volume *= cell_.box().high[k] - cell_.box().low[k];
  if (std::ssize(in_cell) != summary().triangles) return volume;
  for (std::size_t f = 0; f < in_cell.size(); ++f) {
    const BoundaryTriangle& facet = mesh().facets[f];
    if (in_cell[f] == 0 || !facet.bounds()) continue;
    const FacetCorners<3> x = corners_of(mesh(), facet);
    const Point<3>& low = cell_.box().low;
    const double part =
        dot(difference(x[0], low), cross(difference(x[1], low), difference(x[2], low))) / 6;
    volume += facet.back_inside ? part : -part;
  }
  return volume;
}

void VolumeDomain::check() {
  if (checked_) return;
  if (cell_.any()) return check_periodic();
  if (fragment_ && repair_)
    reject_domain("pnpbs_domain_set_fragment and pnpbs_domain_set_repair exclude each other");
  if (snap_ > 0 && !fragment_)
    reject_domain("pnpbs_domain_set_snap in space requires pnpbs_domain_set_fragment");
  std::unique_ptr<ResolvedVolume> resolved;
  if (repair_) {
    resolved = resolve_if_sound();
    if (!resolved) resolved = resolve_repaired();
  } else {
    resolved = fragment_ ? resolve_fragments() : resolve_touching();
  }
  if (resolved->repair.resolution == 0) resolved->repair = taken_distances_;
  for (const std::vector<Warning>* more : {&taken_warnings_, &given_warnings_})
    resolved->warnings.insert(resolved->warnings.begin(), more->begin(), more->end());
  resolved->index = SurfaceIndex(resolved->mesh, resolved->summary.bounds);
  resolved->mesh.node_distance = largest_node_distance(*resolved);
  for (const GroupTag& region : named_by_groups_) names().remove(region);
  named_by_groups_.clear();
  for (const auto& [tag, name] : resolved->region_names)
    if (names().add({3, tag}, name)) named_by_groups_.push_back({3, tag});
  resolved_ = std::move(resolved);
  checked_ = true;
}

}  // namespace pnpbs
