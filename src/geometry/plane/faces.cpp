// SPDX-License-Identifier: BSD-3-Clause
#include "geometry/plane/faces.hpp"

#include <algorithm>
#include <numeric>

#include "base/union_find.hpp"
#include "predicates/plane.hpp"

namespace pnpbs {

namespace {

// An edge seen from one of its vertices.
struct Leaving {
  std::int32_t edge;
  std::int32_t target;
  bool upward;
  bool forward;  // The vertex is the begin of the edge.

  Side left() const { return forward ? left_side(edge) : right_side(edge); }
  Side right() const { return forward ? right_side(edge) : left_side(edge); }
};

class Rings {
 public:
  Rings(const std::vector<Point<2>>& vertices, const std::vector<VertexPair>& edges)
      : vertices_(vertices), offsets_(vertices.size() + 1, 0), leaving_(2 * edges.size()) {
    for (const VertexPair& edge : edges) {
      ++offsets_[edge[0] + 1];
      ++offsets_[edge[1] + 1];
    }
    std::partial_sum(offsets_.begin(), offsets_.end(), offsets_.begin());
    std::vector<std::int64_t> next(offsets_.begin(), offsets_.end() - 1);
    for (std::size_t e = 0; e < edges.size(); ++e) {
      for (const int end : {0, 1}) {
        const std::int32_t from = edges[e][end], to = edges[e][1 - end];
        leaving_[next[from]++] = {static_cast<std::int32_t>(e), to,
                                  is_lower(vertices[from], vertices[to]), end == 0};
      }
    }
    for (std::size_t v = 0; v < vertices.size(); ++v) sort_around(static_cast<std::int32_t>(v));
  }

  const Leaving* begin(std::int32_t vertex) const { return leaving_.data() + offsets_[vertex]; }
  const Leaving* end(std::int32_t vertex) const { return leaving_.data() + offsets_[vertex + 1]; }

 private:
  // Sorts counter-clockwise from the x direction: first the edges that lead up, then those that
  // lead down.
  void sort_around(std::int32_t vertex) {
    std::sort(leaving_.begin() + offsets_[vertex], leaving_.begin() + offsets_[vertex + 1],
              [this, vertex](const Leaving& a, const Leaving& b) {
                if (a.upward != b.upward) return a.upward;
                return orientation(vertices_[vertex], vertices_[a.target], vertices_[b.target]) > 0;
              });
  }

  const std::vector<Point<2>>& vertices_;
  std::vector<std::int64_t> offsets_;
  std::vector<Leaving> leaving_;
};

}  // namespace

Side side_left_of(std::int32_t vertex, const std::vector<Point<2>>& vertices,
                  const std::vector<VertexPair>& edges, const SweepResult& sweep) {
  const std::int32_t edge = sweep.left_edge[vertex];
  if (edge < 0) return 2 * static_cast<Side>(edges.size());
  const bool leads_up = is_lower(vertices[edges[edge][0]], vertices[edges[edge][1]]);
  return leads_up ? right_side(edge) : left_side(edge);
}

void for_each_contact(
    const std::vector<Point<2>>& vertices, const std::vector<VertexPair>& edges,
    const SweepResult& sweep,
    const std::function<void(std::int32_t vertex, Side side, Side other)>& contact) {
  const Rings rings(vertices, edges);
  for (std::int32_t v = 0; v < static_cast<std::int32_t>(vertices.size()); ++v) {
    const Leaving* first = rings.begin(v);
    const Leaving* end = rings.end(v);
    if (first == end) continue;
    for (const Leaving* edge = first; edge + 1 != end; ++edge) {
      contact(v, edge[0].left(), edge[1].right());
    }
    contact(v, end[-1].left(), first->right());
    if (end[-1].upward) contact(v, end[-1].left(), side_left_of(v, vertices, edges, sweep));
  }
}

Faces find_faces(const std::vector<Point<2>>& vertices, const std::vector<VertexPair>& edges,
                 const SweepResult& sweep) {
  const std::size_t sides = 2 * edges.size() + 1;
  UnionFind<Side> same(sides);
  for_each_contact(vertices, edges, sweep,
                   [&same](std::int32_t, Side side, Side other) { same.join(side, other); });
  Faces faces;
  faces.of_side.assign(sides, -1);
  std::vector<std::int32_t> number(sides, -1);
  number[same.root(static_cast<Side>(sides) - 1)] = 0;
  for (std::size_t side = 0; side < sides; ++side) {
    std::int32_t& face = number[same.root(static_cast<Side>(side))];
    if (face < 0) face = faces.count++;
    faces.of_side[side] = face;
  }
  return faces;
}

}  // namespace pnpbs
