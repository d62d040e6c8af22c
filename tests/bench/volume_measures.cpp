// SPDX-License-Identifier: BSD-3-Clause
#include "volume_measures.hpp"

#include <algorithm>
#include <cmath>

namespace pnpbs_bench {

namespace {

constexpr double kDegrees = 180 / 3.14159265358979323846;

Place operator-(const Place& a, const Place& b) { return {a[0] - b[0], a[1] - b[1], a[2] - b[2]}; }
double dot(const Place& a, const Place& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }
double length(const Place& a) { return std::sqrt(dot(a, a)); }
Place cross(const Place& a, const Place& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}
double angle_between(const Place& a, const Place& b) {
  return kDegrees * std::atan2(length(cross(a, b)), dot(a, b));
}
double volume_of(const std::array<Place, 4>& x) {
  return std::fabs(dot(x[1] - x[0], cross(x[2] - x[0], x[3] - x[0]))) / 6;
}

// Returns the circumradius: the area of the triangle whose sides are the products of opposite
// edges, over six volumes.
double circumradius(const std::array<Place, 4>& x) {
  const double a = length(x[1] - x[0]) * length(x[3] - x[2]);
  const double b = length(x[2] - x[0]) * length(x[3] - x[1]);
  const double c = length(x[3] - x[0]) * length(x[2] - x[1]);
  const double square = (a + b + c) * (a + b - c) * (a - b + c) * (b + c - a);
  return std::sqrt(std::max(0.0, square)) / (24 * volume_of(x));
}

class TetrahedronCollector {
 public:
  void add(const ShapeOfTetrahedron& shape, const Place& middle) {
    qualities_.push_back(shape.quality);
    measures_.below_20 += shape.angle < 20;
    measures_.below_10 += shape.angle < 10;
    if (shape.angle >= measures_.angle_min) return;
    measures_.angle_min = shape.angle;
    measures_.angle_min_at = middle;
  }
  TetrahedronMeasures measures() {
    TetrahedronMeasures& m = measures_;
    m.tetrahedra = std::ssize(qualities_);
    if (qualities_.empty()) return m;
    std::sort(qualities_.begin(), qualities_.end());
    for (const double q : qualities_) m.quality_mean += q / static_cast<double>(m.tetrahedra);
    m.quality_one_percent = qualities_[qualities_.size() / 100];
    m.quality_min = qualities_.front();
    return m;
  }

 private:
  std::vector<double> qualities_;
  TetrahedronMeasures measures_;
};

void measure_tetrahedra(const std::vector<Place>& x, const std::vector<char>& on_boundary,
                        const std::vector<TetrahedronOfNodes>& tetrahedra, VolumeVerdict& verdict) {
  TetrahedronCollector all, inside, at_boundary;
  for (const TetrahedronOfNodes& t : tetrahedra) {
    std::array<Place, 4> corners;
    Place middle{};
    bool touches = false;
    for (std::size_t k = 0; k < 4; ++k) {
      const auto node = static_cast<std::size_t>(t[k]);
      corners[k] = x[node];
      for (std::size_t axis = 0; axis < 3; ++axis) middle[axis] += 0.25 * x[node][axis];
      touches = touches || on_boundary[node];
    }
    const ShapeOfTetrahedron shape = shape_of(corners);
    all.add(shape, middle);
    (touches ? at_boundary : inside).add(shape, middle);
    verdict.volume += volume_of(corners);
  }
  verdict.all = all.measures();
  verdict.inside = inside.measures();
  verdict.at_boundary = at_boundary.measures();
}

// Returns the edges, each once.
std::vector<std::array<std::size_t, 2>> edges_of(
    const std::vector<TetrahedronOfNodes>& tetrahedra) {
  std::vector<std::array<std::size_t, 2>> edges;
  edges.reserve(6 * tetrahedra.size());
  for (const TetrahedronOfNodes& t : tetrahedra)
    for (std::size_t a = 0; a < 4; ++a)
      for (std::size_t b = 0; b < a; ++b) {
        const auto [low, high] = std::minmax(t[a], t[b]);
        edges.push_back({static_cast<std::size_t>(low), static_cast<std::size_t>(high)});
      }
  std::sort(edges.begin(), edges.end());
  edges.erase(std::unique(edges.begin(), edges.end()), edges.end());
  return edges;
}

void measure_edges(const std::vector<Place>& x, const std::vector<double>& d,
                   const std::vector<char>& on_boundary,
                   const std::vector<TetrahedronOfNodes>& tetrahedra, VolumeVerdict& verdict) {
  EdgeBand* const by_ends[] = {&verdict.inner_edges, &verdict.edges_at_boundary,
                               &verdict.boundary_edges};
  std::vector<MeasuredEdge> free;
  for (const auto& [a, b] : edges_of(tetrahedra)) {
    const double mean_d = 0.5 * (d[a] + d[b]), ratio = length(x[b] - x[a]) / mean_d;
    const int ends = (on_boundary[a] != 0) + (on_boundary[b] != 0);
    verdict.edges.add(ratio);
    by_ends[ends]->add(ratio);
    if (ends < 2) free.push_back({a, b, ratio, mean_d, ends == 1});
  }
  verdict.edges.finish();
  for (EdgeBand* band : by_ends) band->finish();
  verdict.octaves = octaves(free);
  constexpr double kFewest = 100;  // about two hundred are usual
  const WorstPlaces worst = worst_places(x.size(), free, kFewest);
  verdict.min_place = worst.min;
  verdict.max_place = worst.max;
  verdict.min_at = x[worst.min_node];
  verdict.max_at = x[worst.max_node];
}

void measure_surface(const std::vector<Place>& x, const std::vector<TriangleOfNodes>& triangles,
                     SurfaceMeasures& m) {
  m.triangles = std::ssize(triangles);
  for (const TriangleOfNodes& t : triangles) {
    std::array<Place, 3> corners;
    for (std::size_t k = 0; k < 3; ++k) corners[k] = x[static_cast<std::size_t>(t[k])];
    double angle = 180, around = 0, product = 1;
    for (std::size_t k = 0; k < 3; ++k) {
      const Place u = corners[(k + 1) % 3] - corners[k], v = corners[(k + 2) % 3] - corners[k];
      angle = std::min(angle, angle_between(u, v));
      around += length(u);
      product *= length(u);
    }
    const double twice = length(cross(corners[1] - corners[0], corners[2] - corners[0]));
    m.quality_mean += 4 * twice * twice / (product * around) / static_cast<double>(m.triangles);
    m.angle_mean += angle / static_cast<double>(m.triangles);
    m.angle_min = std::min(m.angle_min, angle);
  }
}

}  // namespace

ShapeOfTetrahedron shape_of(const std::array<Place, 4>& x) {
  ShapeOfTetrahedron shape{0, 180};
  double surface = 0;
  for (std::size_t k = 0; k < 4; ++k)
    surface += 0.5 * length(cross(x[(k + 1) % 4] - x[k], x[(k + 2) % 4] - x[k]));
  const double volume = volume_of(x);
  if (volume > 0) shape.quality = 9 * volume / (surface * circumradius(x));
  constexpr std::size_t kEdges[6][4] = {{0, 1, 2, 3}, {0, 2, 1, 3}, {0, 3, 1, 2},
                                        {1, 2, 0, 3}, {1, 3, 0, 2}, {2, 3, 0, 1}};
  for (const auto& [a, b, c, d] : kEdges) {
    const Place edge = x[b] - x[a];  // the angle of these normals is the angle of the faces
    const double angle = angle_between(cross(edge, x[c] - x[a]), cross(edge, x[d] - x[a]));
    shape.angle = std::min(shape.angle, angle);
  }
  return shape;
}

VolumeVerdict evaluate(const std::vector<Place>& x, const std::vector<double>& d,
                       const std::vector<char>& on_boundary, const BodyMesh& mesh) {
  VolumeVerdict verdict;
  measure_tetrahedra(x, on_boundary, mesh.tetrahedra, verdict);
  measure_edges(x, d, on_boundary, mesh.tetrahedra, verdict);
  measure_surface(x, mesh.boundary, verdict.surface);
  return verdict;
}

}  // namespace pnpbs_bench
