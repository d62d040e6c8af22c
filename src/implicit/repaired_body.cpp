// SPDX-License-Identifier: BSD-3-Clause
#include "implicit/repaired_body.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <set>
#include <unordered_map>
#include <utility>
#include <vector>

#include "base/error.hpp"
#include "base/index.hpp"
#include "base/limits.hpp"
#include "base/mixed_hash.hpp"
#include "base/point_text.hpp"
#include "base/space_vectors.hpp"
#include "base/started_execution.hpp"
#include "base/union_find.hpp"
#include "geometry/volume/nearest_triangles.hpp"
#include "geometry/volume/triangles.hpp"
#include "geometry/volume/welding.hpp"
#include "geometry/volume/winding_number.hpp"
#include "implicit/level_set_creases.hpp"
#include "implicit/level_set_surface.hpp"
#include "surfaces/surface_edges.hpp"
#include "surfaces/surface_sides.hpp"
#include "surfaces/triangulation.hpp"

namespace pnpbs {
namespace {

using TriangleList = std::vector<FacetCorners<3>>;
using Nearest = NearestTriangles::Nearest;

struct Sample {
  Point<3> x, normal;  // unit normal of the triangle
  double area;         // area that the sample represents; 0 for corners
};

double area_of(const FacetCorners<3>& triangle) { return length(area_normal(triangle)); }

// Adds the centroids of pieces with edges of at most `apart`, made by halving the longest edge.
void add_middles(const FacetCorners<3>& triangle, const Point<3>& normal, double apart,
                 std::vector<Sample>& samples) {
  std::array<double, 3> square;  // of the edge from corner k to the next
  for (std::size_t k = 0; k < 3; ++k)
    square[k] = squared_distance<3>(triangle[k], triangle[(k + 1) % 3]);
  const auto k =
      static_cast<std::size_t>(std::max_element(square.begin(), square.end()) - square.begin());
  if (!(square[k] > apart * apart)) {
    samples.push_back({centroid(triangle), normal, area_of(triangle)});
    return;
  }
  const Point<3>&a = triangle[k], &b = triangle[(k + 1) % 3], &c = triangle[(k + 2) % 3];
  const Point<3> half = shifted(a, 0.5, difference(b, a));
  add_middles({a, half, c}, normal, apart, samples);
  add_middles({half, b, c}, normal, apart, samples);
}

std::vector<Sample> samples_on(const TriangleList& triangles, double apart) {
  std::vector<Sample> samples;
  for (const FacetCorners<3>& triangle : triangles) {
    const Point<3> normal = unit_vector(area_normal(triangle));
    for (const Point<3>& corner : triangle) samples.push_back({corner, normal, 0});
    add_middles(triangle, normal, apart, samples);
  }
  return samples;
}

struct PointHash {
  std::size_t operator()(const Point<3>& x) const {
    std::uint64_t hash = 0;
    for (const double coordinate : x) hash = mixed_with(hash, coordinate);
    return static_cast<std::size_t>(hash);
  }
};

// Returns the nearest point of the triangles for each sample. A corner is a sample of every
// triangle around it but is searched for once.
std::vector<Nearest> nearest_to(const std::vector<Sample>& samples,
                                const NearestTriangles& triangles) {
  std::vector<Point<3>> points;
  std::vector<std::size_t> point_of;  // per sample
  std::unordered_map<Point<3>, std::size_t, PointHash> corners;
  for (const Sample& sample : samples) {
    const bool is_new = sample.area > 0 || corners.try_emplace(sample.x, points.size()).second;
    point_of.push_back(is_new ? points.size() : corners.at(sample.x));
    if (is_new) points.push_back(sample.x);
  }
  std::vector<Nearest> of_points(points.size()), nearest;
  for_each_if_started("pnpbs::distances_of_repair", std::ssize(points), [&](std::int64_t i) {
    const auto k = static_cast<std::size_t>(i);
    of_points[k] = triangles.nearest(points[k]);
  });
  for (const std::size_t point : point_of) nearest.push_back(of_points[point]);
  return nearest;
}

TriangleList triangles_of(const SurfaceSource& surface) {
  TriangleList triangles;
  for (const auto& [a, b, c] : surface.triangles)
    triangles.push_back(
        {surface.vertices[index(a)], surface.vertices[index(b)], surface.vertices[index(c)]});
  return triangles;
}

// Returns true if the vector to the nearest point is closer to the surface than to its normal. The
// new surface closes a hole there, because the nearest given point lies beside it.
bool closes_a_hole(const Sample& sample, const Nearest& nearest, double resolution) {
  constexpr double kNoWay = 1e-3;  // [resolution]; shorter vectors have no direction
  if (nearest.square < kNoWay * kNoWay * resolution * resolution) return false;
  const Point<3> way = difference(nearest.point.x, sample.x);
  const double off = dot(way, sample.normal);
  return 2 * off * off < nearest.square;
}

void measure_new(const std::vector<Sample>& samples, const std::vector<Nearest>& nearest,
                 RepairDistances& found) {
  double area = 0, sum = 0;
  for (std::size_t k = 0; k < samples.size(); ++k) {
    const double away = std::sqrt(nearest[k].square);
    double& largest =
        closes_a_hole(samples[k], nearest[k], found.resolution) ? found.over_holes : found.to_given;
    largest = std::max(largest, away);
    sum += samples[k].area * away;
    area += samples[k].area;
  }
  found.mean_to_given = area > 0 ? sum / area : 0;
}

void measure_given(const std::vector<Sample>& samples, const std::vector<Nearest>& nearest,
                   RepairDistances& found) {
  double all = 0, lost = 0;
  for (std::size_t k = 0; k < samples.size(); ++k) {
    const double away = std::sqrt(nearest[k].square);
    found.to_new = std::max(found.to_new, away);
    all += samples[k].area;
    if (away > found.resolution) lost += samples[k].area;
  }
  found.lost = all > 0 ? lost / all : 0;
}

// Measures the distances between a repaired body and the triangles from which it was made.
RepairDistances distances_of_repair(const NearestTriangles& given, const SurfaceSource& made,
                                    double resolution) {
  RepairDistances found{.resolution = resolution};
  const NearestTriangles made_ones(triangles_of(made));
  const std::vector<Sample> on_new = samples_on(made_ones.triangles(), resolution),
                            on_given = samples_on(given.triangles(), resolution);
  measure_new(on_new, nearest_to(on_new, given), found);
  measure_given(on_given, nearest_to(on_given, made_ones), found);
  return found;
}

// A closed component of a surface.
struct ClosedPiece {
  std::int32_t first = -1;  // first of its vertices
  double volume = 0, area = 0;

  double thickness() const { return 2 * std::fabs(volume) / area; }
};

// Removes components, bodies or cavities, whose mean thickness is less than `least`, with a
// warning. The mean thickness is twice the volume over the area. Such components are fragments of
// open sheets, which the lattice of a level set finds only in parts.
void remove_thin_pieces(SurfaceSource& surface, double least) {
  UnionFind<std::int32_t> joined(surface.vertices.size());
  for (const auto& [a, b, c] : surface.triangles) {
    joined.join(a, b);
    joined.join(b, c);
  }
  // Volumes are relative to a vertex of the component, because rounding would dominate far from the
  // origin.
  std::vector<ClosedPiece> pieces(surface.vertices.size());
  for (const auto& [a, b, c] : surface.triangles) {
    ClosedPiece& piece = pieces[index(joined.root(a))];
    if (piece.first < 0) piece.first = a;
    const FacetCorners<3> corners{surface.vertices[index(a)], surface.vertices[index(b)],
                                  surface.vertices[index(c)]};
    const Point<3> normal = area_normal(corners);
    const Point<3> way = difference(corners[0], surface.vertices[index(piece.first)]);
    piece.area += length(normal);
    piece.volume += dot(normal, way) / 3;
  }
  std::size_t kept = 0;
  for (std::size_t t = 0; t < surface.triangles.size(); ++t) {
    const ClosedPiece& piece = pieces[index(joined.root(surface.triangles[t][0]))];
    if (piece.thickness() < least) continue;
    surface.triangles[kept] = surface.triangles[t];
    surface.tags[kept++] = surface.tags[t];
  }
  surface.triangles.resize(kept);
  surface.tags.resize(kept);
  std::int64_t thin = 0;
  std::int32_t first = -1;
  for (const ClosedPiece& piece : pieces)
    if (piece.first >= 0 && piece.thickness() < least && thin++ == 0) first = piece.first;
  if (thin > 0)
    surface.warnings.emplace_back(
        WarningCode::pieces_left_out,
        std::to_string(thin) + (thin == 1 ? " piece" : " pieces") + " of the body, thinner than " +
            rounded_text(least) + " in the mean, " + (thin == 1 ? "is" : "are") +
            " left out, one of them at " + rounded_point_text<3>(surface.vertices[index(first)]) +
            ": a smaller resolution keeps them",
        thin, least);
}

void weld(Triangulation& surface, double tolerance) {
  const std::vector<std::int32_t> joined = weld_points(surface.vertices, tolerance);
  for (SurfaceTriangle& triangle : surface.triangles)
    for (std::int32_t& v : triangle.vertices) v = joined[index(v)];
}

bool is_none(const SurfaceTriangle& triangle) {
  const auto& [a, b, c] = triangle.vertices;
  return a == b || b == c || c == a;
}

// Returns the triangles over common vertices: vertices within the tolerance are welded, and
// triangles without area are removed. Of triangles with the same corners, in any orientation, only
// the first is kept. A second one would hide the neighbours at its edges, and one of opposite
// orientation would cancel the first.
Triangulation welded_triangles(const std::vector<SurfaceSource>& given, double tolerance) {
  Triangulation surface = join_surfaces(given);
  weld(surface, tolerance);
  std::set<std::array<std::int32_t, 3>> there;
  std::erase_if(surface.triangles, [&](const SurfaceTriangle& triangle) {
    std::array<std::int32_t, 3> corners = triangle.vertices;
    std::sort(corners.begin(), corners.end());
    return is_none(triangle) || !there.insert(corners).second;
  });
  return surface;
}

// Distance from triangles within which their sides determine the inside. [resolution]
constexpr double kNear = 2;
// Distance within which vertices are welded. [resolution] Scanners and converters leave seams of
// rounding, across which triangles would not be neighbours.
constexpr double kWelded = 1e-3;
// Least mean thickness of components. [resolution] A lattice does not resolve thinner ones.
constexpr double kThin = 0.5;

// Returns a box around the vertices that triangles use.
Box<3> box_around(const std::vector<SurfaceSource>& surfaces) {
  Box<3> box = empty_box<3>();
  for (const SurfaceSource& surface : surfaces)
    for (const auto& triangle : surface.triangles)
      for (const std::int32_t v : triangle)
        include(box, surface.vertices[static_cast<std::size_t>(v)]);
  return box;
}

std::vector<FacetCorners<3>> corners_of(const Triangulation& surface) {
  std::vector<FacetCorners<3>> triangles;
  for (std::int32_t t = 0; t < std::ssize(surface.triangles); ++t)
    triangles.push_back(surface.corners(t));
  return triangles;
}

// A function that is negative where the absolute winding number exceeds 1/2. Near closed parts it
// is the signed distance to the triangles. Near a hole it decreases to 0 where the winding number
// is 1/2, so it has no jump there.
class RepairFunction {
 public:
  // Within `near` of a triangle, its side determines the sign if it is known.
  RepairFunction(const Triangulation& surface, const SurfaceEdges& edges, double near)
      : nearest_(corners_of(surface)),
        winding_(nearest_.triangles()),
        sides_(surface, edges, winding_),
        near_(near * near) {}
  RepairFunction(const RepairFunction&) = delete;
  RepairFunction& operator=(const RepairFunction&) = delete;

  double operator()(const Point<3>& x) const {
    const NearestTriangles::Nearest there = nearest_.nearest(x);
    const double away = std::sqrt(there.square);
    if (away == 0) return 0;
    if (there.square < near_)
      if (const int side = sides_.side(there.triangle, there.point, x); side != 0)
        return side * away;
    return std::clamp(1 - 2 * std::fabs(winding_(x)), -1.0, 1.0) * away;
  }
  const NearestTriangles& nearest() const { return nearest_; }

 private:
  NearestTriangles nearest_;
  WindingNumber winding_;
  SurfaceSides sides_;
  double near_;  // squared
};

double longest_side(const Box<3>& box) {
  double longest = 0;
  for (std::size_t k = 0; k < 3; ++k) longest = std::max(longest, box.high[k] - box.low[k]);
  return longest;
}

[[noreturn]] void reject_nothing(const std::string& why) {
  reject_domain("repair: the triangles enclose nothing that " + why +
                "; pnpbs_domain_set_filled (in the command --surfaces-only) takes an open surface "
                "as it is");
}

SurfaceSource surface_of(const LevelSet& set, std::int32_t tag) {
  const std::string resolution = "the resolution of " + rounded_text(set.resolution());
  SurfaceSource surface;
  try {
    surface = level_set_surface(set, tag);
  } catch (const Error& error) {
    if (error.kind() != ErrorKind::domain) throw;
    reject_nothing(resolution +
                   " resolves: their winding number exceeds 1/2 at no evaluated point");
  }
  remove_thin_pieces(surface, kThin * set.resolution());
  if (surface.triangles.empty())
    reject_nothing("is as thick as half of " + resolution + ": try a smaller one");
  return surface;
}

// Returns the box with a margin. The surface lies well inside, because the winding number is less
// than 1/2 outside the convex hull of the triangles.
Box<3> with_margin(Box<3> box, double resolution) {
  for (std::size_t k = 0; k < 3; ++k) {
    box.low[k] -= 2 * resolution;
    box.high[k] += 2 * resolution;
  }
  return box;
}

}  // namespace

RepairedBody repaired_body(const std::vector<SurfaceSource>& given, double resolution) {
  RepairedBody body;
  std::vector<Warning> warnings;
  const Box<3> box = box_around(given);
  if (resolution == 0) resolution = kRepairResolution * longest_side(box);
  if (!(resolution > 0 && resolution <= longest_side(box)))
    reject_domain("repair: the resolution is " + number_text(resolution) +
                  ", expected no more than the longest side of the box around the triangles, " +
                  rounded_text(longest_side(box)));
  Triangulation surface = welded_triangles(given, kWelded * resolution);
  SurfaceEdges edges(surface);
  orient_surfaces(surface, edges, OneSided::ignored, warnings);
  const auto f = std::make_shared<const RepairFunction>(surface, edges, kNear * resolution);
  const auto set = std::make_shared<LevelSet>(
      "the repaired surface",
      [f](std::int64_t n, const Point<3>* x, double* values) {
        for (std::int64_t i = 0; i < n; ++i) values[i] = (*f)(x[i]);
      },
      with_margin(box, resolution), resolution);
  body.surface = surface_of(*set, given[0].tags[0]);
  add_creases(*set, body.surface);
  body.surface.level_set = set;
  body.surface.approximates = true;
  body.surface.name = set->name();
  body.distances = distances_of_repair(f->nearest(), body.surface, resolution);
  body.surface.warnings.insert(body.surface.warnings.begin(), warnings.begin(), warnings.end());
  return body;
}

std::string text_of(const RepairedBody& body) {
  const RepairDistances& d = body.distances;
  std::string text = "repaired, with a resolution of " + rounded_text(d.resolution) + ": " +
                     std::to_string(body.surface.triangles.size()) + " new triangles, within " +
                     rounded_text(d.to_given) + " of those given";
  if (d.over_holes > 0)
    text += ", or, where they close holes, within " + rounded_text(d.over_holes);
  text += " (" + rounded_text(d.mean_to_given) + " in the mean)";
  if (d.lost > 0)
    text += "; " + rounded_text(100 * d.lost) +
            " percent of those given, by area, are farther than the resolution from the new ones, "
            "by up to " +
            rounded_text(d.to_new) +
            ": they lie inside, enclose nothing or are too close to others";
  return text;
}

}  // namespace pnpbs
