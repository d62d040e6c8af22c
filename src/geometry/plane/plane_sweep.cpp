// SPDX-License-Identifier: BSD-3-Clause
#include "geometry/plane/plane_sweep.hpp"

#include <algorithm>
#include <iterator>
#include <numeric>
#include <set>

#include "predicates/plane.hpp"

namespace pnpbs {

namespace {

class Sweep {
 public:
  Sweep(const std::vector<Point<2>>& vertices, const std::vector<VertexPair>& edges)
      : vertices_(vertices), edges_(edges), line_(Order{this}) {}

  SweepResult run() {
    orient_edges();
    list_edges_at_vertices();
    result_.left_edge.assign(vertices_.size(), -1);
    on_line_.assign(edges_.size(), false);
    place_.resize(edges_.size());
    const std::vector<std::int32_t> order = vertices_from_low_to_high();
    for (std::size_t i = 0; i < order.size(); ++i) {
      if (i > 0 && vertices_[order[i]] == vertices_[order[i - 1]]) {
        result_.coincident.push_back({order[i - 1], order[i]});
      }
      pass(order[i]);
    }
    return std::move(result_);
  }

 private:
  // An edge that intersects the sweep line. A chain of edges through vertices keeps one entry,
  // because its position in the order does not change. Therefore the edge can be modified inside
  // the set.
  struct Entry {
    mutable std::int32_t edge;
  };
  struct At {
    std::int32_t vertex;
  };
  struct Order {
    using is_transparent = void;
    const Sweep* sweep;
    bool operator()(const Entry& a, const Entry& b) const { return sweep->is_left(a.edge, b.edge); }
    bool operator()(const Entry& a, const At& b) const { return sweep->side(a.edge, b.vertex) < 0; }
    bool operator()(const At& a, const Entry& b) const { return sweep->side(b.edge, a.vertex) > 0; }
  };
  using Line = std::set<Entry, Order>;

  const Point<2>& low(std::int32_t edge) const { return vertices_[directed_[edge][0]]; }
  const Point<2>& high(std::int32_t edge) const { return vertices_[directed_[edge][1]]; }

  // Returns > 0 if the vertex lies on the left of the edge.
  int side(std::int32_t edge, std::int32_t vertex) const {
    return orientation(low(edge), high(edge), vertices_[vertex]);
  }

  // Returns whether edge a is on the left of b. Both intersect the sweep line. The lower end of the
  // one that begins higher is compared to the other edge.
  bool is_left(std::int32_t a, std::int32_t b) const {
    if (a == b) return false;
    int sign = 0;
    if (directed_[a][0] == directed_[b][0]) {
      sign = -orientation(low(a), high(a), high(b));
    } else if (is_lower(low(b), low(a))) {
      sign = side(b, directed_[a][0]);
    } else {
      sign = -side(a, directed_[b][0]);
    }
    return sign != 0 ? sign > 0 : a < b;
  }

  // Returns whether two edges on the sweep line intersect in a point that is not a common end.
  bool conflict(std::int32_t a, std::int32_t b) const {
    const bool common_low = directed_[a][0] == directed_[b][0];
    const bool common_high = directed_[a][1] == directed_[b][1];
    if (common_low) return orientation(low(a), high(a), high(b)) == 0;
    if (common_high) return orientation(high(a), low(a), low(b)) == 0;
    return side(a, directed_[b][0]) * side(a, directed_[b][1]) <= 0 &&
           side(b, directed_[a][0]) * side(b, directed_[a][1]) <= 0;
  }

  void orient_edges() {
    directed_ = edges_;
    for (VertexPair& edge : directed_) {
      if (is_lower(vertices_[edge[1]], vertices_[edge[0]])) std::swap(edge[0], edge[1]);
    }
  }

  void list_edges_at_vertices() {
    for (const int end : {0, 1}) {
      auto& offsets = offsets_[end];
      offsets.assign(vertices_.size() + 1, 0);
      for (const VertexPair& edge : directed_) ++offsets[edge[end] + 1];
      std::partial_sum(offsets.begin(), offsets.end(), offsets.begin());
      listed_[end].resize(edges_.size());
      std::vector<std::int32_t> next(offsets.begin(), offsets.end() - 1);
      for (std::size_t e = 0; e < edges_.size(); ++e) {
        listed_[end][next[directed_[e][end]]++] = static_cast<std::int32_t>(e);
      }
    }
  }

  std::vector<std::int32_t> vertices_from_low_to_high() const {
    std::vector<std::int32_t> order(vertices_.size());
    std::iota(order.begin(), order.end(), 0);
    std::sort(order.begin(), order.end(), [this](std::int32_t a, std::int32_t b) {
      if (vertices_[a] != vertices_[b]) return is_lower(vertices_[a], vertices_[b]);
      return a < b;
    });
    return order;
  }

  // Stores the edges that begin in the vertex, from left to right, in beginning_.
  void gather_beginning(std::int32_t vertex) {
    beginning_.assign(listed_[0].begin() + offsets_[0][vertex],
                      listed_[0].begin() + offsets_[0][vertex + 1]);
    if (beginning_.size() < 2) return;
    std::sort(beginning_.begin(), beginning_.end(),
              [this](std::int32_t a, std::int32_t b) { return is_left(a, b); });
  }

  void gather_ending(std::int32_t vertex) {
    ending_.clear();
    for (std::int32_t i = offsets_[1][vertex]; i < offsets_[1][vertex + 1]; ++i) {
      if (on_line_[listed_[1][i]]) ending_.push_back(listed_[1][i]);
    }
  }

  Line::iterator drop(Line::iterator entry) {
    on_line_[entry->edge] = false;
    return line_.erase(entry);
  }

  void pass(std::int32_t vertex) {
    gather_ending(vertex);
    gather_beginning(vertex);
    if (ending_.size() == 1 && beginning_.size() == 1) {
      continue_chain(vertex);
    } else {
      replace(vertex);
    }
  }

  // Handles a vertex where one edge ends and one begins: the entry of the first is reused for the
  // second.
  void continue_chain(std::int32_t vertex) {
    const Line::iterator entry = place_[ending_[0]];
    on_line_[ending_[0]] = false;
    entry->edge = beginning_[0];
    place_[beginning_[0]] = entry;
    on_line_[beginning_[0]] = true;
    const bool first = entry == line_.begin();
    if (!first) result_.left_edge[vertex] = std::prev(entry)->edge;
    settle(first ? entry : std::prev(entry), std::next(entry));
  }

  void replace(std::int32_t vertex) {
    for (const std::int32_t edge : ending_) drop(place_[edge]);
    auto right = line_.lower_bound(At{vertex});
    while (right != line_.end() && side(right->edge, vertex) == 0) {
      result_.conflicts.push_back({right->edge, -1, vertex});
      right = drop(right);
    }
    const bool first = right == line_.begin();
    const auto left = first ? line_.end() : std::prev(right);
    if (!first) result_.left_edge[vertex] = left->edge;
    for (const std::int32_t edge : beginning_) {
      place_[edge] = line_.emplace_hint(right, Entry{edge});
      on_line_[edge] = true;
    }
    settle(first ? line_.begin() : left, right);
  }

  // Tests all adjacent pairs from `entry` to `last` for conflicts.
  void settle(Line::iterator entry, Line::iterator last) {
    while (entry != last) {
      const auto next = std::next(entry);
      if (next == line_.end()) return;
      if (!conflict(entry->edge, next->edge)) {
        entry = next;
        continue;
      }
      result_.conflicts.push_back({entry->edge, next->edge, -1});
      const bool was_last = next == last;
      const auto after = drop(next);
      if (was_last) last = after;
    }
  }

  const std::vector<Point<2>>& vertices_;
  const std::vector<VertexPair>& edges_;
  std::vector<VertexPair> directed_;                  // Low end, high end.
  std::array<std::vector<std::int32_t>, 2> offsets_;  // Begin of each vertex in listed_.
  std::array<std::vector<std::int32_t>, 2> listed_;   // Edges that begin [0] or end [1] there.
  std::vector<std::int32_t> beginning_, ending_;      // Edges at the current vertex.
  Line line_;                          // Edges that intersect the sweep line, from left to right.
  std::vector<Line::iterator> place_;  // Entry of each edge in line_.
  std::vector<bool> on_line_;
  SweepResult result_;
};

}  // namespace

SweepResult sweep_plane(const std::vector<Point<2>>& vertices,
                        const std::vector<VertexPair>& edges) {
  return Sweep(vertices, edges).run();
}

}  // namespace pnpbs
