// SPDX-License-Identifier: BSD-3-Clause
#include "evaluate.hpp"

#include <CGAL/Constrained_Delaunay_triangulation_2.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Triangulation_face_base_with_info_2.h>
#include <CGAL/Triangulation_vertex_base_with_info_2.h>

#include <algorithm>
#include <cmath>
#include <deque>
#include <limits>
#include <set>

namespace pnpbs_bench {

namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
struct FaceInfo {
  int nesting = -1;
  bool inside() const { return nesting % 2 == 1; }
};
using VertexBase = CGAL::Triangulation_vertex_base_with_info_2<std::int64_t, Kernel>;
using FaceBase =
    CGAL::Triangulation_face_base_with_info_2<FaceInfo, Kernel,
                                              CGAL::Constrained_triangulation_face_base_2<Kernel>>;
using Structure = CGAL::Triangulation_data_structure_2<VertexBase, FaceBase>;
using Triangulation =
    CGAL::Constrained_Delaunay_triangulation_2<Kernel, Structure,
                                               CGAL::No_constraint_intersection_tag>;
using Face = Triangulation::Face_handle;
using Vertex = Triangulation::Vertex_handle;
constexpr double kDegrees = 180 / 3.14159265358979323846;

struct Reference {
  Triangulation triangulation;
  std::int64_t missing_edges = 0;
  std::set<std::array<Vertex, 2>> inner_edges;  // in both directions

  bool is_border(const Triangulation::Edge& e) const {
    const Triangulation& t = triangulation;
    return t.is_constrained(e) && inner_edges.count({e.first->vertex(t.cw(e.second)),
                                                     e.first->vertex(t.ccw(e.second))}) == 0;
  }
};

// Marks regions from the outside in by the even-odd rule: the level of a region is one more than
// that of the region across its border.
void mark_nesting(const Reference& reference) {
  const Triangulation& t = reference.triangulation;
  std::deque<std::pair<Face, int>> starts{{t.infinite_face(), 0}};
  while (!starts.empty()) {
    const auto [start, level] = starts.front();
    starts.pop_front();
    std::vector<Face> region{start};
    while (!region.empty()) {
      const Face f = region.back();
      region.pop_back();
      if (f->info().nesting >= 0) continue;
      f->info().nesting = level;
      for (int k = 0; k < 3; ++k) {
        if (f->neighbor(k)->info().nesting >= 0) continue;
        if (reference.is_border({f, k}))
          starts.emplace_back(f->neighbor(k), level + 1);
        else
          region.push_back(f->neighbor(k));
      }
    }
  }
}

void build(const NodeSet& set, Reference& reference) {
  Triangulation& t = reference.triangulation;
  std::vector<std::pair<Kernel::Point_2, std::int64_t>> points;
  for (std::size_t i = 0; i < set.x.size(); ++i)
    points.emplace_back(Kernel::Point_2(set.x[i][0], set.x[i][1]), static_cast<std::int64_t>(i));
  t.insert(points.begin(), points.end());
  std::vector<Vertex> vertex(set.x.size());
  for (auto v = t.finite_vertices_begin(); v != t.finite_vertices_end(); ++v)
    vertex[static_cast<std::size_t>(v->info())] = v;
  const auto constrain = [&](const std::array<std::int64_t, 2>& e, bool inner) {
    const Vertex a = vertex[static_cast<std::size_t>(e[0])];
    const Vertex b = vertex[static_cast<std::size_t>(e[1])];
    if (inner) reference.inner_edges.insert({{a, b}, {b, a}});
    try {
      t.insert_constraint(a, b);
    } catch (const std::exception&) {
      ++reference.missing_edges;
      return;
    }
    if (!t.is_edge(a, b)) ++reference.missing_edges;  // a node lies on it
  };
  for (const auto& e : set.edges) constrain(e, false);
  for (const auto& e : set.inner_edges) constrain(e, true);
  mark_nesting(reference);
}

double quality(const Kernel::Point_2& a, const Kernel::Point_2& b, const Kernel::Point_2& c) {
  const double ab = std::sqrt(CGAL::squared_distance(a, b));
  const double bc = std::sqrt(CGAL::squared_distance(b, c));
  const double ca = std::sqrt(CGAL::squared_distance(c, a));
  const double area = std::fabs(CGAL::area(a, b, c));
  return 16 * area * area / (ab * bc * ca * (ab + bc + ca));
}

double min_angle(const Kernel::Point_2& a, const Kernel::Point_2& b, const Kernel::Point_2& c) {
  double min = 180;
  const Kernel::Point_2 p[3] = {a, b, c};
  for (int k = 0; k < 3; ++k) {
    const auto u = p[(k + 1) % 3] - p[k], w = p[(k + 2) % 3] - p[k];
    min = std::min(min, kDegrees * std::acos(std::clamp((u * w) / std::sqrt(u.squared_length()) /
                                                            std::sqrt(w.squared_length()),
                                                        -1.0, 1.0)));
  }
  return min;
}

// Returns the distance from point p in face f to the boundary in a direction, at most `max`.
double way_to_boundary(const Triangulation& t, Face f, const Kernel::Point_2& p,
                       const Kernel::Vector_2& direction, double max) {
  Face from = nullptr;
  // A ray exactly through a node could circle around it forever, so the number of triangles is
  // limited.
  for (int steps = 0; steps < 100; ++steps) {
    int out = -1;
    double way = std::numeric_limits<double>::infinity();
    for (int k = 0; k < 3; ++k) {
      if (from != nullptr && f->neighbor(k) == from) continue;
      const Kernel::Point_2& a = f->vertex(t.cw(k))->point();
      const Kernel::Point_2& b = f->vertex(t.ccw(k))->point();
      const Kernel::Vector_2 e = b - a, r = a - p;
      const double det = direction.x() * e.y() - direction.y() * e.x();
      if (det == 0) continue;
      const double s = (r.x() * e.y() - r.y() * e.x()) / det;
      const double u = (r.x() * direction.y() - r.y() * direction.x()) / det;
      if (s >= 0 && u >= -1e-12 && u <= 1 + 1e-12 && s < way) {
        way = s;
        out = k;
      }
    }
    if (out < 0 || way >= max) return max;
    if (t.is_constrained({f, out})) return way;
    from = f;
    f = f->neighbor(out);
    if (t.is_infinite(f)) return way;
  }
  return max;
}

bool narrow_at(const Triangulation& t, Face f, double d) {
  const Kernel::Point_2 middle =
      CGAL::centroid(f->vertex(0)->point(), f->vertex(1)->point(), f->vertex(2)->point());
  constexpr int kChords = 12;
  for (int c = 0; c < kChords; ++c) {
    // Avoids the directions of lattice rows.
    const double angle = (c + 0.2718) * 3.14159265358979323846 / kChords;
    const Kernel::Vector_2 u(std::cos(angle), std::sin(angle));
    const double chord =
        way_to_boundary(t, f, middle, u, 3 * d) + way_to_boundary(t, f, middle, -u, 3 * d);
    if (chord < 3 * d) return true;
  }
  return false;
}

class Collector {
 public:
  void add_triangle(double quality, double angle) {
    qualities_.push_back(quality);
    angle_ = std::min(angle_, angle);
  }
  void add_edge(double ratio) {
    ++edges_;
    sum_ += ratio;
    squares_ += ratio * ratio;
  }
  Measures measures() {
    Measures m;
    m.triangles = static_cast<std::int64_t>(qualities_.size());
    if (qualities_.empty()) return m;
    std::sort(qualities_.begin(), qualities_.end());
    double sum = 0;
    std::int64_t above_80 = 0, above_90 = 0;
    for (double q : qualities_) {
      sum += q;
      above_80 += q > 0.8;
      above_90 += q > 0.9;
    }
    const double n = static_cast<double>(qualities_.size());
    m.quality_mean = sum / n;
    m.quality_one_percent = qualities_[qualities_.size() / 100];
    m.quality_min = qualities_.front();
    m.share_above_80 = static_cast<double>(above_80) / n;
    m.share_above_90 = static_cast<double>(above_90) / n;
    m.angle_min = angle_;
    m.edge_mean = sum_ / static_cast<double>(edges_);
    m.edge_deviation = std::sqrt(
        std::max(0.0, squares_ / static_cast<double>(edges_) - m.edge_mean * m.edge_mean));
    return m;
  }

 private:
  std::vector<double> qualities_;
  double angle_ = 180, sum_ = 0, squares_ = 0;
  std::int64_t edges_ = 0;
};

// Returns the edges whose length is due to the motion of nodes: all except those on the boundary.
std::vector<MeasuredEdge> free_edges(const Triangulation& t, const NodeSet& set) {
  std::vector<char> on_boundary(set.x.size(), 0);
  for (const auto* edges : {&set.edges, &set.inner_edges})
    for (const auto& e : *edges)
      for (std::int64_t end : e) on_boundary[static_cast<std::size_t>(end)] = 1;
  std::vector<MeasuredEdge> found;
  for (auto e = t.finite_edges_begin(); e != t.finite_edges_end(); ++e) {
    const Face f = e->first, other = f->neighbor(e->second);
    if (t.is_constrained(*e) || !f->info().inside() || !other->info().inside()) continue;
    const auto a = static_cast<std::size_t>(f->vertex(t.cw(e->second))->info());
    const auto b = static_cast<std::size_t>(f->vertex(t.ccw(e->second))->info());
    if (on_boundary[a] && on_boundary[b]) continue;  // corners and narrow regions leave no choice
    const double d = 0.5 * (set.d[a] + set.d[b]);
    const double length = std::hypot(set.x[a][0] - set.x[b][0], set.x[a][1] - set.x[b][1]);
    found.push_back({a, b, length / d, d, on_boundary[a] != on_boundary[b]});
  }
  return found;
}

EdgesByPlace edges_by_place(const Triangulation& t, const NodeSet& set) {
  const std::vector<MeasuredEdge> edges = free_edges(t, set);
  EdgesByPlace by_place;
  by_place.bands = eight_bands(edges);
  for (const MeasuredEdge& e : edges)
    if (e.at_boundary) by_place.at_boundary.add(e.ratio);
  by_place.at_boundary.finish();
  constexpr double kFewest = 40;  // about sixty are usual
  const WorstPlaces worst = worst_places(set.x.size(), edges, kFewest);
  by_place.min_place = worst.min;
  by_place.max_place = worst.max;
  by_place.min_at = set.x[worst.min_node];
  by_place.max_at = set.x[worst.max_node];
  return by_place;
}

// Returns the number of nodes required by d: the sum of the triangles' areas over that of the
// equilateral triangle of side d, with two triangles per node.
double nodes_wanted(const Triangulation& t, const NodeSet& set) {
  double nodes = 0;
  for (auto f = t.finite_faces_begin(); f != t.finite_faces_end(); ++f) {
    if (!f->info().inside()) continue;
    double d = 0;
    for (int k = 0; k < 3; ++k) d += set.d[static_cast<std::size_t>(f->vertex(k)->info())] / 3;
    const double area =
        std::fabs(CGAL::area(f->vertex(0)->point(), f->vertex(1)->point(), f->vertex(2)->point()));
    nodes += area / (d * d) * (2 / std::sqrt(3.0));
  }
  return nodes;
}

}  // namespace

Verdict evaluate(const NodeSet& set) {
  Reference reference;
  build(set, reference);
  const Triangulation& t = reference.triangulation;

  std::vector<char> by_short_edge(set.x.size(), 0), near_boundary(set.x.size(), 0);
  for (const auto& e : set.edges) {
    const auto a = static_cast<std::size_t>(e[0]), b = static_cast<std::size_t>(e[1]);
    const double length = std::hypot(set.x[a][0] - set.x[b][0], set.x[a][1] - set.x[b][1]);
    near_boundary[a] = near_boundary[b] = 1;
    if (length < 0.7 * 0.5 * (set.d[a] + set.d[b])) by_short_edge[a] = by_short_edge[b] = 1;
  }
  for (int ring = 0; ring < 3; ++ring) {
    std::vector<char> wider = near_boundary;
    for (auto e = t.finite_edges_begin(); e != t.finite_edges_end(); ++e) {
      const auto a = static_cast<std::size_t>(e->first->vertex(t.cw(e->second))->info());
      const auto b = static_cast<std::size_t>(e->first->vertex(t.ccw(e->second))->info());
      if (near_boundary[a] || near_boundary[b]) wider[a] = wider[b] = 1;
    }
    near_boundary.swap(wider);
  }

  Collector all, wide;
  for (auto f = t.finite_faces_begin(); f != t.finite_faces_end(); ++f) {
    if (!f->info().inside()) continue;
    double d = 0;
    bool mendable = true, near = false;
    for (int k = 0; k < 3; ++k) {
      const auto i = static_cast<std::size_t>(f->vertex(k)->info());
      d += set.d[i] / 3;
      if (by_short_edge[i]) mendable = false;
      near = near || near_boundary[i];
    }
    const auto &a = f->vertex(0)->point(), &b = f->vertex(1)->point(), &c = f->vertex(2)->point();
    const double q = quality(a, b, c), angle = min_angle(a, b, c);
    all.add_triangle(q, angle);
    if (mendable && near && narrow_at(t, f, d)) mendable = false;
    if (mendable) wide.add_triangle(q, angle);
    for (int k = 0; k < 3; ++k) {
      const Face other = f->neighbor(k);
      // Visit each edge once.
      if (!t.is_infinite(other) && other->info().inside() && other < Face(f)) continue;
      const auto i = static_cast<std::size_t>(f->vertex(t.cw(k))->info());
      const auto j = static_cast<std::size_t>(f->vertex(t.ccw(k))->info());
      const double ratio = std::hypot(set.x[i][0] - set.x[j][0], set.x[i][1] - set.x[j][1]) /
                           (0.5 * (set.d[i] + set.d[j]));
      all.add_edge(ratio);
      if (mendable) wide.add_edge(ratio);
    }
  }
  return {all.measures(), edges_by_place(t, set), nodes_wanted(t, set), wide.measures(),
          reference.missing_edges};
}

std::vector<std::array<std::int64_t, 3>> reference_triangles(const NodeSet& set) {
  Reference reference;
  build(set, reference);
  const Triangulation& t = reference.triangulation;
  std::vector<std::array<std::int64_t, 3>> triangles;
  for (auto f = t.finite_faces_begin(); f != t.finite_faces_end(); ++f) {
    if (!f->info().inside()) continue;
    std::array<std::int64_t, 3> corners{f->vertex(0)->info(), f->vertex(1)->info(),
                                        f->vertex(2)->info()};
    std::sort(corners.begin(), corners.end());
    triangles.push_back(corners);
  }
  std::sort(triangles.begin(), triangles.end());
  return triangles;
}

}  // namespace pnpbs_bench
