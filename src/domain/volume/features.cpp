// SPDX-License-Identifier: BSD-3-Clause
#include "domain/volume/features.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <span>
#include <utility>

#include "base/space_vectors.hpp"
#include "domain/volume/short_creases.hpp"

namespace pnpbs {

namespace {

// A side of a facet, stored at the lower of its two nodes.
struct FacetSide {
  std::int32_t other;  // the higher node
  std::int32_t facet;
  std::int32_t k;  // edge from corner k to the next; -1: the facet is a segment of a curve

  auto operator<=>(const FacetSide&) const = default;
};

// A feature edge with the facets that have it.
struct FeatureEdge {
  std::array<std::int32_t, 2> nodes;
  std::span<const FacetSide> sides;
  bool crease;  // true if it is a feature only by the angle

  std::int32_t beyond(std::int32_t node) const { return nodes[nodes[0] == node ? 1 : 0]; }
};

int distinct_corners(const BoundaryTriangle& facet) {
  const auto& [a, b, c] = facet.nodes;
  if (a == b && b == c) return 1;
  return a == b || b == c || c == a ? 2 : 3;
}

std::array<std::int32_t, 2> ends_of_segment(const BoundaryTriangle& facet) {
  const auto [low, high] = std::minmax({facet.nodes[0], facet.nodes[1], facet.nodes[2]});
  return {low, high};
}

class FeatureFinder {
 public:
  FeatureFinder(const BoundaryMesh<3>& mesh, double feature_angle, const SmoothSurfaces& smooth)
      : mesh_(mesh), cosine_(std::cos(feature_angle * std::numbers::pi / 180)), smooth_(smooth) {}

  Features run() {
    gather_sides();
    find_edges();
    drop_short_creases();
    flood_patches();
    find_corners();
    followed_.assign(edges_.size(), 0);
    for (const std::int32_t corner : found_.corners)
      for (const std::int32_t edge : edges_at(corner)) follow(corner, edge);
    for (std::int32_t e = 0; e < edge_count(); ++e) follow(edges_[index(e)].nodes[0], e);
    find_patches_at();
    return std::move(found_);
  }

 private:
  static std::size_t index(std::int32_t i) { return static_cast<std::size_t>(i); }

  std::int32_t edge_count() const { return static_cast<std::int32_t>(edges_.size()); }
  const BoundaryTriangle& facet(std::int32_t f) const { return mesh_.facets[index(f)]; }
  const Point<3>& position(std::int32_t node) const { return mesh_.nodes[index(node)].position; }

  // Calls visit(lower node, side) for the sides of all facets.
  template <class Visit>
  void for_sides(const Visit& visit) const {
    for (std::int32_t f = 0; f < static_cast<std::int32_t>(mesh_.facets.size()); ++f) {
      const int corners = distinct_corners(facet(f));
      if (corners == 2) {
        const auto [low, high] = ends_of_segment(facet(f));
        visit(low, FacetSide{high, f, -1});
      }
      for (std::int32_t k = 0; k < 3 && corners == 3; ++k) {
        const auto [low, high] =
            std::minmax(facet(f).nodes[index(k)], facet(f).nodes[index((k + 1) % 3)]);
        visit(low, FacetSide{high, f, k});
      }
    }
  }

  void gather_sides() {
    side_begin_.assign(mesh_.nodes.size() + 1, 0);
    for_sides([&](std::int32_t low, const FacetSide&) { ++side_begin_[index(low) + 1]; });
    for (std::size_t n = 0; n < mesh_.nodes.size(); ++n) side_begin_[n + 1] += side_begin_[n];
    sides_.resize(side_begin_.back());
    std::vector<std::size_t> next(side_begin_.begin(), side_begin_.end() - 1);
    for_sides([&](std::int32_t low, const FacetSide& side) { sides_[next[index(low)]++] = side; });
  }

  void find_edges() {
    found_.across.assign(mesh_.facets.size(), {-1, -1, -1});
    for (const BoundaryTriangle& f : mesh_.facets) normals_.push_back(facet_normal(mesh_, f));
    for (std::size_t node = 0; node < mesh_.nodes.size(); ++node) {
      const std::span<FacetSide> row(sides_.data() + side_begin_[node],
                                     side_begin_[node + 1] - side_begin_[node]);
      std::sort(row.begin(), row.end());
      for (std::size_t begin = 0, end; begin < row.size(); begin = end) {
        end = begin + 1;
        while (end < row.size() && row[end].other == row[begin].other) ++end;
        add_edge(static_cast<std::int32_t>(node), row.subspan(begin, end - begin));
      }
    }
  }

  void add_edge(std::int32_t node, std::span<const FacetSide> sides) {
    const bool divides = !is_plain(sides);
    if (divides || is_sharp(node, sides)) {
      edges_.push_back({{node, sides[0].other}, sides, !divides});
    } else {
      join(sides);
    }
  }

  void join(std::span<const FacetSide> sides) {
    for (const int side : {0, 1}) {
      const FacetSide &own = sides[index(side)], &other = sides[index(1 - side)];
      found_.across[index(own.facet)][index(own.k)] = other.facet;
    }
  }

  // Returns true if the edge can be a feature only by the angle between its two triangles.
  bool is_plain(std::span<const FacetSide> sides) const {
    if (sides.size() != 2 || sides[0].k < 0 || sides[1].k < 0) return false;
    const BoundaryTriangle &f = facet(sides[0].facet), &g = facet(sides[1].facet);
    const bool alike =
        f.tag == g.tag && f.front_inside == g.front_inside && f.back_inside == g.back_inside;
    const bool one_orientation = f.nodes[index(sides[0].k)] != g.nodes[index(sides[1].k)];
    return alike && one_orientation;
  }

  bool is_sharp(std::int32_t node, std::span<const FacetSide> sides) const {
    const std::int32_t smooth = smooth_surface(sides[0].facet);
    if (smooth >= 0 && smooth == smooth_surface(sides[1].facet))
      return std::binary_search(smooth_.creases.begin(), smooth_.creases.end(),
                                std::array{node, sides[0].other});
    const Point<3>&p = normals_[index(sides[0].facet)], &q = normals_[index(sides[1].facet)];
    return p != Point<3>{} && q != Point<3>{} && dot(p, q) < cosine_;
  }

  void drop_short_creases() {
    std::vector<FeatureEdgeCandidate> candidates;
    for (const FeatureEdge& edge : edges_) candidates.push_back({edge.nodes, edge.crease});
    const std::vector<char> dropped = short_creases(mesh_, candidates);
    std::vector<FeatureEdge> kept;
    for (std::size_t e = 0; e < edges_.size(); ++e) {
      if (dropped[e] == 0) {
        kept.push_back(edges_[e]);
      } else {
        join(edges_[e].sides);
        found_.short_creases.push_back(edges_[e].nodes);
      }
    }
    edges_ = std::move(kept);
  }

  std::int32_t smooth_surface(std::int32_t f) const {
    return index(f) < smooth_.of.size() ? smooth_.of[index(f)] : -1;
  }

  void flood_patches() {
    found_.patch.assign(mesh_.facets.size(), -1);
    std::vector<std::int32_t> open;
    for (std::int32_t seed = 0; seed < static_cast<std::int32_t>(mesh_.facets.size()); ++seed) {
      if (found_.patch[index(seed)] >= 0 || distinct_corners(facet(seed)) < 3) continue;
      found_.patch[index(seed)] = found_.patches;
      open.push_back(seed);
      while (!open.empty()) {
        const std::int32_t f = open.back();
        open.pop_back();
        for (const std::int32_t g : found_.across[index(f)]) {
          if (g < 0 || found_.patch[index(g)] >= 0) continue;
          found_.patch[index(g)] = found_.patches;
          open.push_back(g);
        }
      }
      ++found_.patches;
    }
  }

  void find_corners() {
    std::vector<char> fixed(mesh_.nodes.size(), 0);
    for (const BoundaryTriangle& f : mesh_.facets)
      if (distinct_corners(f) == 1) fixed[index(f.nodes[0])] = 1;
    edge_begin_.assign(mesh_.nodes.size() + 1, 0);
    for (const FeatureEdge& edge : edges_)
      for (const std::int32_t node : edge.nodes) ++edge_begin_[index(node) + 1];
    for (std::size_t n = 0; n < mesh_.nodes.size(); ++n) edge_begin_[n + 1] += edge_begin_[n];
    edges_of_nodes_.resize(2 * edges_.size());
    std::vector<std::size_t> next(edge_begin_.begin(), edge_begin_.end() - 1);
    for (std::int32_t e = 0; e < edge_count(); ++e)
      for (const std::int32_t node : edges_[index(e)].nodes)
        edges_of_nodes_[next[index(node)]++] = e;
    for (std::int32_t node = 0; node < static_cast<std::int32_t>(mesh_.nodes.size()); ++node)
      if (fixed[index(node)] != 0 || ends_curves(node)) found_.corners.push_back(node);
  }

  std::span<const std::int32_t> edges_at(std::int32_t node) const {
    return {edges_of_nodes_.data() + edge_begin_[index(node)],
            edges_of_nodes_.data() + edge_begin_[index(node) + 1]};
  }

  bool ends_curves(std::int32_t node) const {
    const std::span<const std::int32_t> edges = edges_at(node);
    if (edges.size() != 2) return !edges.empty();
    const FeatureEdge &e = edges_[index(edges[0])], &f = edges_[index(edges[1])];
    const Point<3> come = difference(position(node), position(e.beyond(node)));
    const Point<3> go = difference(position(f.beyond(node)), position(node));
    if (dot(come, go) < cosine_ * length(come) * length(go)) return true;
    return inner_curve(e) != inner_curve(f) || patches_of(e) != patches_of(f);
  }

  // Returns whether an inner curve runs along the edge, and its tag.
  std::pair<bool, std::int32_t> inner_curve(const FeatureEdge& edge) const {
    for (const FacetSide& side : edge.sides)
      if (side.k < 0) return {true, facet(side.facet).tag};
    return {false, 0};
  }

  std::vector<std::int32_t> patches_of(const FeatureEdge& edge) const {
    std::vector<std::int32_t> patches;
    for (const FacetSide& side : edge.sides)
      if (side.k >= 0) patches.push_back(found_.patch[index(side.facet)]);
    std::sort(patches.begin(), patches.end());
    return patches;
  }

  // Adds the curve that begins with edge e at `node`, unless the edge belongs to a curve already.
  void follow(std::int32_t node, std::int32_t e) {
    if (followed_[index(e)] != 0) return;
    FeatureCurve curve{{node}, {}, next_edge_, 0};
    std::int32_t first_facet = std::numeric_limits<std::int32_t>::max();
    const auto [inner, inner_tag] = inner_curve(edges_[index(e)]);
    while (followed_[index(e)] == 0) {
      followed_[index(e)] = 1;
      const FeatureEdge& edge = edges_[index(e)];
      std::vector<std::int32_t>& facets = curve.facets.emplace_back();
      for (const FacetSide& side : edge.sides) facets.push_back(side.facet);
      first_facet = std::min(first_facet, facets.front());
      node = edge.beyond(node);
      curve.nodes.push_back(node);
      if (found_.is_corner(node)) break;
      const std::span<const std::int32_t> both = edges_at(node);
      e = both[both[0] == e ? 1 : 0];
    }
    curve.tag = inner ? inner_tag : facet(first_facet).tag;
    next_edge_ += static_cast<std::int32_t>(curve.edge_count());
    found_.curves.push_back(std::move(curve));
  }

  void find_patches_at() {
    std::vector<char> wanted(mesh_.nodes.size(), 0);
    for (const FeatureEdge& edge : edges_)
      for (const std::int32_t node : edge.nodes) wanted[index(node)] = 1;
    for (const std::int32_t corner : found_.corners) wanted[index(corner)] = 1;
    found_.patches_at.resize(mesh_.nodes.size());
    for (std::size_t f = 0; f < mesh_.facets.size(); ++f)
      for (const std::int32_t node : mesh_.facets[f].nodes)
        if (wanted[index(node)] != 0 && found_.patch[f] >= 0)
          found_.patches_at[index(node)].push_back(found_.patch[f]);
    for (std::vector<std::int32_t>& patches : found_.patches_at) {
      std::sort(patches.begin(), patches.end());
      patches.erase(std::unique(patches.begin(), patches.end()), patches.end());
    }
  }

  const BoundaryMesh<3>& mesh_;
  double cosine_;
  const SmoothSurfaces& smooth_;
  std::vector<Point<3>> normals_;
  std::vector<std::size_t> side_begin_;  // first index of each node in sides_
  std::vector<FacetSide> sides_;
  std::vector<FeatureEdge> edges_;       // ordered by their nodes
  std::vector<std::size_t> edge_begin_;  // first index of each node in edges_of_nodes_
  std::vector<std::int32_t> edges_of_nodes_;
  std::vector<char> followed_;  // per edge
  std::int32_t next_edge_ = 0;
  Features found_;
};

}  // namespace

bool Features::is_corner(std::int32_t mesh_node) const {
  return std::binary_search(corners.begin(), corners.end(), mesh_node);
}

Features find_features(const BoundaryMesh<3>& mesh, double feature_angle,
                       const SmoothSurfaces& smooth) {
  return FeatureFinder(mesh, feature_angle, smooth).run();
}

Point<3> facet_normal(const BoundaryMesh<3>& mesh, const BoundaryTriangle& facet) {
  const auto [a, b, c] = corners_of(mesh, facet);
  return unit_vector(cross(difference(b, a), difference(c, a)));
}

}  // namespace pnpbs
