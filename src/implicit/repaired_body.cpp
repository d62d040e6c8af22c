// SPDX-License-Identifier: BSD-3-Clause
#include "implicit/repaired_body.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "base/domain_error.hpp"
#include "base/limits.hpp"
#include "base/point_text.hpp"
#include "base/space_vectors.hpp"
#include "geometry/volume/nearest_triangles.hpp"
#include "geometry/volume/triangles.hpp"
#include "geometry/volume/winding_number.hpp"
#include "implicit/level_set_creases.hpp"
#include "implicit/level_set_surface.hpp"
#include "implicit/measured_repair.hpp"
#include "surfaces/soup.hpp"
#include "surfaces/surface_edges.hpp"
#include "surfaces/surface_orientation.hpp"
#include "surfaces/surface_sides.hpp"
#include "surfaces/thin_pieces.hpp"

namespace pnpbs {

namespace {

// In units of the resolution: nearer than that to triangles, their sides tell what is inside.
constexpr double kNear = 2;
// Vertices that are so near are one: scanners and converters leave seams of rounding, across which
// triangles would not know their neighbours.
constexpr double kWelded = 1e-3;
// Pieces thinner than that are none: no lattice of this resolution finds them as they are.
constexpr double kThin = 0.5;

// Around what their triangles use.
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

// Negative where the triangles wind around a point more than half a time, whichever way. It is the
// distance from them, signed, as long as they are closed; where there is a hole it fades out
// towards the place where they wind half a time around, so that it has no jump there.
class RepairFunction {
 public:
  // Nearer than `near` the sides of triangles count where they are known.
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
                   " finds: nowhere do they wind around a point more than half a time");
  }
  remove_thin_pieces(surface, kThin * set.resolution());
  if (surface.triangles.empty())
    reject_nothing("is as thick as half of " + resolution + ", so try a smaller one");
  return surface;
}

// The surface is well inside of it: beyond the triangles' convex hull they wind less than half a
// time around.
Box<3> roomy(Box<3> box, double resolution) {
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
  Triangulation surface = joined_soup(given, kWelded * resolution);
  SurfaceEdges edges(surface);
  orient_surfaces(surface, edges, OneSided::ignored, warnings);
  const auto f = std::make_shared<const RepairFunction>(surface, edges, kNear * resolution);
  const auto set = std::make_shared<LevelSet>(
      "the repaired surface",
      [f](std::int64_t n, const Point<3>* x, double* values) {
        for (std::int64_t i = 0; i < n; ++i) values[i] = (*f)(x[i]);
      },
      roomy(box, resolution), resolution);
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
            rounded_text(d.to_new) + ": they lie inside, enclose nothing or are too near to others";
  return text;
}

}  // namespace pnpbs
