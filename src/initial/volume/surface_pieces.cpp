// SPDX-License-Identifier: BSD-3-Clause
#include "initial/volume/surface_pieces.hpp"

#include <algorithm>
#include <array>
#include <limits>
#include <utility>

#include "base/lattice.hpp"
#include "base/point_text.hpp"
#include "base/space_vectors.hpp"
#include "tree/background_tree.hpp"
#include "tree/leaf_cells.hpp"

namespace pnpbs {

namespace {

constexpr double kMaxEdge = 1.25;  // of a piece, in units of d: an equilateral one has 0.8 nodes
constexpr std::int64_t kBatch = 1 << 16;  // points asked in one call

struct Triangle {
  std::int32_t facet;
  FacetCorners<3> corners;

  Point<3> centre() const {
    const auto& [a, b, c] = corners;
    return {(a[0] + b[0] + c[0]) / 3, (a[1] + b[1] + c[1]) / 3, (a[2] + b[2] + c[2]) / 3};
  }
  double area() const {
    const auto& [a, b, c] = corners;
    return 0.5 * length(cross(difference(b, a), difference(c, a)));
  }
};

// From corner k of a triangle to the next one.
struct LongestEdge {
  std::size_t k = 0;
  double length = 0;
};

LongestEdge longest_edge(const Triangle& triangle) {
  LongestEdge longest;
  for (std::size_t k = 0; k < 3; ++k) {
    const double length = distance<3>(triangle.corners[k], triangle.corners[(k + 1) % 3]);
    if (length > longest.length) longest = {k, length};
  }
  return longest;
}

double nodes_in(double area, double d) { return Lattice<2>::kDensity * area / (d * d); }

class Cutter {
 public:
  Cutter(const Surface& surface, const SpacingEvaluator<3>& spacing, const NodeLimit& limit)
      : surface_(surface), spacing_(spacing), limit_(limit) {
    pieces_.resize(static_cast<std::size_t>(surface.features().patches));
  }

  std::vector<std::vector<SurfacePiece>> run() {
    std::vector<Triangle> open;
    for (std::int32_t f = 0; f < static_cast<std::int32_t>(surface_.mesh().facets.size()); ++f)
      if (surface_.patch(f) >= 0) open.push_back({f, surface_.corners(f)});
    while (!open.empty()) open = cut(open);
    sort();
    return std::move(pieces_);
  }

 private:
  // In two across their longest edge those that are too wide; the others are done.
  std::vector<Triangle> cut(const std::vector<Triangle>& open) {
    std::vector<Point<3>> centres;
    for (const Triangle& triangle : open) centres.push_back(triangle.centre());
    std::vector<double> d(open.size());
    const auto count = static_cast<std::int64_t>(open.size());
    for (std::int64_t first = 0; first < count; first += kBatch)
      spacing_(std::min(kBatch, count - first), centres.data() + first, d.data() + first);
    std::vector<Triangle> halves;
    double pending = 0;
    for (std::size_t n = 0; n < open.size(); ++n) {
      if (d[n] < least_d_) {
        least_d_ = d[n];
        least_at_ = centres[n];
      }
      const LongestEdge longest = longest_edge(open[n]);
      if (longest.length > kMaxEdge * d[n]) {
        // Where d grows from here on, there may be few nodes after all, but some.
        pending += 0.25 * std::min(1.0, nodes_in(open[n].area(), d[n]));
        halve(open[n], longest.k, halves);
      } else {
        add(open[n], centres[n], d[n]);
      }
    }
    require_few_enough(pending);
    return halves;
  }

  static void halve(const Triangle& triangle, std::size_t k, std::vector<Triangle>& halves) {
    const Point<3>&a = triangle.corners[k], &b = triangle.corners[(k + 1) % 3],
          &c = triangle.corners[(k + 2) % 3];
    const Point<3> middle{0.5 * (a[0] + b[0]), 0.5 * (a[1] + b[1]), 0.5 * (a[2] + b[2])};
    halves.push_back({triangle.facet, {a, middle, c}});
    halves.push_back({triangle.facet, {middle, b, c}});
  }

  void add(const Triangle& triangle, const Point<3>& centre, double d) {
    const double area = triangle.area();
    pieces_[static_cast<std::size_t>(surface_.patch(triangle.facet))].push_back(
        {{triangle.facet, centre}, area, d});
    nodes_ += nodes_in(area, d);
  }

  void require_few_enough(double pending) const {
    const double nodes = nodes_ + pending;
    if (nodes > static_cast<double>(limit_.max_nodes))
      limit_.report_too_many(nodes, least_d_, point_text(least_at_));
  }

  void sort() {
    const auto& nodes = surface_.mesh().nodes;
    if (nodes.empty()) return;
    Box<3> box{nodes[0].position, nodes[0].position};
    for (const BoundaryNode<3>& node : nodes) box = joined(box, {node.position, node.position});
    BackgroundTree<3> tree;
    tree.build(box, [](const auto&, std::int32_t, std::int32_t, std::vector<char>&) {});
    for (std::vector<SurfacePiece>& pieces : pieces_)
      std::stable_sort(pieces.begin(), pieces.end(),
                       [&](const SurfacePiece& a, const SurfacePiece& b) {
                         return morton_before(tree.fine_index(a.centre.position),
                                              tree.fine_index(b.centre.position));
                       });
  }

  const Surface& surface_;
  const SpacingEvaluator<3>& spacing_;
  const NodeLimit& limit_;
  std::vector<std::vector<SurfacePiece>> pieces_;  // of each patch
  double nodes_ = 0;                               // that they have room for
  double least_d_ = std::numeric_limits<double>::infinity();
  Point<3> least_at_{};
};

}  // namespace

std::vector<std::vector<SurfacePiece>> cut_to_pieces(const Surface& surface,
                                                     const SpacingEvaluator<3>& spacing,
                                                     const NodeLimit& limit) {
  return Cutter(surface, spacing, limit).run();
}

}  // namespace pnpbs
