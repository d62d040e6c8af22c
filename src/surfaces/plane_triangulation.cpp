// SPDX-License-Identifier: BSD-3-Clause
#include "surfaces/plane_triangulation.hpp"

#include <algorithm>
#include <deque>
#include <utility>

#include "base/index.hpp"
#include "predicates/plane.hpp"

namespace pnpbs {

namespace {

// A triangulation of half-edges. Half-edge h belongs to triangle h / 3 and leads from its vertex to
// that of the next half-edge of the triangle. Triangles are counter-clockwise.
class PlaneTriangulation {
 public:
  PlaneTriangulation(const ExactPoints& points, int k, const PlaneGraph& graph)
      : points_(points), k_(k), graph_(graph), leaving_(graph.points.size(), -1) {}

  std::vector<std::array<std::int32_t, 3>> run() {
    sweep();
    fixed_.assign(vertex_.size(), 0);
    for (std::size_t h = 0; h < vertex_.size(); ++h) unchecked_.push_back(of(h));
    make_delaunay();
    for (const auto& edge : graph_.edges) insert(edge[0], edge[1]);
    make_delaunay();
    std::vector<std::array<std::int32_t, 3>> triangles;
    for (std::size_t h = 0; h < vertex_.size(); h += 3)
      triangles.push_back({vertex_[h], vertex_[h + 1], vertex_[h + 2]});
    return triangles;
  }

 private:
  static std::int32_t of(std::size_t i) { return static_cast<std::int32_t>(i); }
  static std::int32_t next(std::int32_t h) { return h % 3 == 2 ? h - 2 : h + 1; }
  static std::int32_t previous(std::int32_t h) { return h % 3 == 0 ? h + 2 : h - 1; }
  std::int32_t start(std::int32_t h) const { return vertex_[index(h)]; }
  std::int32_t end(std::int32_t h) const { return vertex_[index(next(h))]; }
  std::int32_t apex(std::int32_t h) const { return vertex_[index(previous(h))]; }
  std::int32_t twin(std::int32_t h) const { return twin_[index(h)]; }

  int orientation(std::int32_t a, std::int32_t b, std::int32_t c) const {
    return points_.orientation(k_, graph_.points[index(a)], graph_.points[index(b)],
                               graph_.points[index(c)]);
  }
  Point<2> rounded(std::int32_t v) const {
    return projection(k_, points_.position(graph_.points[index(v)]));
  }

  void join(std::int32_t h, std::int32_t g) {
    if (h >= 0) twin_[index(h)] = g;
    if (g >= 0) twin_[index(g)] = h;
  }

  // Adds a triangle and returns its half-edge from a to b. It and the next two get these twins.
  std::int32_t add(std::int32_t a, std::int32_t b, std::int32_t c, std::int32_t twin_ab,
                   std::int32_t twin_bc, std::int32_t twin_ca) {
    const auto h = of(vertex_.size());
    for (const std::int32_t v : {a, b, c}) {
      leaving_[index(v)] = of(vertex_.size());
      vertex_.push_back(v);
      twin_.push_back(-1);
    }
    join(h, twin_ab);
    join(h + 1, twin_bc);
    join(h + 2, twin_ca);
    return h;
  }

  // ------------------------------------------------------------ sweep
  // Triangulates the convex hull. Each point lies outside the hull of the points before it.
  void sweep() {
    const auto count = of(graph_.points.size());
    after_.assign(index(count), -1);
    before_.assign(index(count), -1);
    hull_edge_.assign(index(count), -1);
    std::int32_t first = 2;  // the first point that is not on a line with those before it
    while (orientation(0, 1, first) == 0) ++first;
    begin_fan(first);
    for (std::int32_t p = first + 1; p < count; ++p) extend_hull(p);
  }

  // Makes b the next vertex after a on the hull. `half_edge` is that of the triangle there.
  void chain(std::int32_t a, std::int32_t b, std::int32_t half_edge) {
    after_[index(a)] = b;
    before_[index(b)] = a;
    hull_edge_[index(a)] = half_edge;
  }

  // Adds the triangles between `apex` and the points before it, which lie on a line.
  void begin_fan(std::int32_t apex) {
    const bool left = orientation(0, 1, apex) > 0;
    std::int32_t between = -1;  // the half-edge from the line to the apex, or back
    for (std::int32_t v = 0; v + 1 < apex; ++v) {
      if (left) {
        const std::int32_t h = add(v, v + 1, apex, -1, -1, between);
        chain(v, v + 1, h);
        if (v == 0) chain(apex, 0, h + 2);
        between = h + 1;
      } else {
        const std::int32_t h = add(v + 1, v, apex, -1, between, -1);
        chain(v + 1, v, h);
        if (v == 0) chain(0, apex, h + 1);
        between = h + 2;
      }
    }
    if (left) {
      chain(apex - 1, apex, between);
    } else {
      chain(apex, apex - 1, between);
    }
  }

  // Adds the triangles between a point and the edges of the hull that are visible from it. The
  // point before it is an end of one of these edges.
  void extend_hull(std::int32_t p) {
    std::int32_t high = p - 1, low = p - 1, to_high = -1, to_low = -1;
    for (std::int32_t v = after_[index(high)]; orientation(high, v, p) < 0;
         high = v, v = after_[index(v)]) {
      const std::int32_t h = add(v, high, p, hull_edge_[index(high)], to_high, -1);
      if (to_low < 0) to_low = h + 1;
      to_high = h + 2;
    }
    for (std::int32_t v = before_[index(low)]; orientation(v, low, p) < 0;
         low = v, v = before_[index(v)]) {
      const std::int32_t h = add(low, v, p, hull_edge_[index(v)], -1, to_low);
      if (to_high < 0) to_high = h + 2;
      to_low = h + 1;
    }
    chain(low, p, to_low);
    chain(p, high, to_high);
  }

  // ------------------------------------------------------------ flips
  // Returns whether the two triangles at an edge form a strictly convex quadrilateral.
  bool is_convex(std::int32_t h) const {
    const std::int32_t c = apex(h), d = apex(twin(h));
    return orientation(c, d, end(h)) > 0 && orientation(d, c, start(h)) > 0;
  }

  // Replaces the edge between two triangles by the other diagonal, which may not be fixed.
  // Returns a half-edge of the new edge.
  std::int32_t flip(std::int32_t h) {
    const std::int32_t g = twin(h);
    const std::int32_t h_next = next(h), h_last = previous(h);
    const std::int32_t g_next = next(g), g_last = previous(g);
    const std::int32_t a = start(h), b = start(g), c = start(h_last), d = start(g_last);
    const std::array<std::int32_t, 4> outer{twin(h_next), twin(h_last), twin(g_next), twin(g_last)};
    const std::array<char, 4> fixed{fixed_[index(h_next)], fixed_[index(h_last)],
                                    fixed_[index(g_next)], fixed_[index(g_last)]};
    // The triangles become d, b, c and c, a, d.
    const auto set = [&](std::int32_t edge, std::int32_t vertex, std::int32_t other,
                         char is_fixed) {
      vertex_[index(edge)] = vertex;
      join(edge, other);
      fixed_[index(edge)] = is_fixed;
      leaving_[index(vertex)] = edge;
    };
    set(h, d, outer[3], fixed[3]);
    set(h_next, b, outer[0], fixed[0]);
    set(g, c, outer[1], fixed[1]);
    set(g_next, a, outer[2], fixed[2]);
    set(h_last, c, g_last, 0);
    set(g_last, d, h_last, 0);
    return h_last;
  }

  // Returns whether the Delaunay criterion requires a flip. Ties are broken by the order of the
  // points, so that the triangles within a polygon of fixed edges depend on its points only. Both
  // the triangles and those after the flip must have an area when their corners are rounded. So
  // each flip lowers the surface of the rounded points that are lifted to a paraboloid, and the
  // flips end.
  bool must_flip(std::int32_t h) const {
    if (twin(h) < 0 || fixed_[index(h)] != 0) return false;
    const Point<2> a = rounded(start(h)), b = rounded(end(h)), c = rounded(apex(h)),
                   d = rounded(apex(twin(h)));
    const auto area = [](const Point<2>& x, const Point<2>& y, const Point<2>& z) {
      return pnpbs::orientation(x, y, z);
    };
    return area(a, b, c) > 0 && area(b, a, d) > 0 && area(c, d, b) > 0 && area(d, c, a) > 0 &&
           in_circle_perturbed(a, b, c, d, start(h), end(h), apex(h), apex(twin(h))) > 0 &&
           is_convex(h);
  }

  void make_delaunay() {
    while (!unchecked_.empty()) {
      const std::int32_t h = unchecked_.back();
      unchecked_.pop_back();
      if (!must_flip(h)) continue;
      const std::int32_t flipped = flip(h), other = twin(flipped);
      for (const std::int32_t edge :
           {next(flipped), previous(flipped), next(other), previous(other)})
        unchecked_.push_back(edge);
    }
  }

  // ------------------------------------------------------------ edges of the graph
  // Returns the half-edge from a to b, or from b to a if this has no triangle, or -1 if none.
  std::int32_t find(std::int32_t a, std::int32_t b) const {
    std::int32_t found = -1;
    for_each_around(a, [&](std::int32_t h) {
      if (end(h) == b) found = h;
      if (apex(h) == b && found < 0) found = previous(h);
      return found < 0;
    });
    return found;
  }

  // Calls visit(h) for the half-edges that leave a until it returns false.
  template <class Visit>
  void for_each_around(std::int32_t a, const Visit& visit) const {
    const std::int32_t first = leaving_[index(a)];
    std::int32_t h = first;
    do {
      if (!visit(h)) return;
      h = twin(previous(h));
    } while (h >= 0 && h != first);
    if (h == first) return;
    for (h = twin(first); h >= 0;) {  // on the hull, also in the other direction
      h = next(h);
      if (!visit(h)) return;
      h = twin(h);
    }
  }

  // Makes the segment from a to b an edge. It meets no fixed edge and no point between its ends.
  void insert(std::int32_t a, std::int32_t b) {
    std::int32_t h = find(a, b);
    if (h < 0) {
      flip_across(a, b);
      h = find(a, b);
    }
    fixed_[index(h)] = 1;
    if (twin(h) >= 0) fixed_[index(twin(h))] = 1;
  }

  // Flips the edges across the segment until there is none (S. Sloan, "A fast algorithm for
  // generating constrained Delaunay triangulations", Computers & Structures 47, 1993).
  void flip_across(std::int32_t a, std::int32_t b) {
    std::deque<std::array<std::int32_t, 2>> across = edges_across(a, b);
    while (!across.empty()) {
      const auto edge = across.front();
      across.pop_front();
      const std::int32_t h = find(edge[0], edge[1]);
      if (!is_convex(h)) {
        across.push_back(edge);
        continue;
      }
      const std::int32_t flipped = flip(h);
      const std::int32_t c = start(flipped), d = end(flipped);
      unchecked_.push_back(flipped);
      for (const std::int32_t side : {flipped, twin(flipped)})
        for (const std::int32_t outer : {next(side), previous(side)}) unchecked_.push_back(outer);
      if (c == a || c == b || d == a || d == b) continue;
      if (orientation(a, b, c) * orientation(a, b, d) < 0) across.push_back({c, d});
    }
  }

  // Returns the edges that cross the segment.
  std::deque<std::array<std::int32_t, 2>> edges_across(std::int32_t a, std::int32_t b) const {
    std::int32_t h = -1;  // the edge of a triangle that has b on the other side
    for_each_around(a, [&](std::int32_t leaving) {
      if (orientation(a, end(leaving), b) > 0 && orientation(a, apex(leaving), b) < 0)
        h = next(leaving);
      return h < 0;
    });
    std::deque<std::array<std::int32_t, 2>> across;
    while (true) {
      across.push_back({start(h), end(h)});
      h = twin(h);
      const std::int32_t c = apex(h);
      if (c == b) return across;
      // The segment leaves the triangle on the side of c on which b lies.
      h = orientation(a, b, c) > 0 ? next(h) : previous(h);
    }
  }

  const ExactPoints& points_;
  int k_;
  const PlaneGraph& graph_;
  std::vector<std::int32_t> vertex_, twin_;               // per half-edge
  std::vector<char> fixed_;                               // per half-edge
  std::vector<std::int32_t> leaving_;                     // per point: a half-edge that leaves it
  std::vector<std::int32_t> after_, before_, hull_edge_;  // per point on the hull
  std::vector<std::int32_t> unchecked_;  // half-edges whose Delaunay criterion is to be checked
};

}  // namespace

std::vector<std::array<std::int32_t, 3>> triangulate(const ExactPoints& points, int k,
                                                     const PlaneGraph& graph) {
  return PlaneTriangulation(points, k, graph).run();
}

}  // namespace pnpbs
