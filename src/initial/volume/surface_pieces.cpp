// SPDX-License-Identifier: BSD-3-Clause
#include "initial/volume/surface_pieces.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <tuple>
#include <utility>

#include "base/execution.hpp"
#include "base/lattice.hpp"
#include "base/point_text.hpp"
#include "base/space_vectors.hpp"
#include "comm/records.hpp"
#include "method/constants.hpp"
#include "tree/box_tree.hpp"
#include "tree/leaf_cells.hpp"

namespace pnpbs {

namespace {

constexpr std::int64_t kBatch = 1 << 16;  // most points in one evaluation of d
constexpr double kMaxThatAddUp = 9e18;    // bound on a sum over all ranks, as it has 64 bits
// Exponent of a bound on the number of pieces: log2(3), because one half of a needle-shaped
// triangle is as long as the whole.
constexpr double kNeedlePower = 1.585;
// Memory of a piece while it is divided and sorted. [bytes]
constexpr double kBytesPerPiece = 2 * sizeof(SurfacePiece) + 4 * sizeof(FacetCorners<3>);

struct Triangle {
  std::int32_t facet;
  FacetCorners<3> corners;

  Point<3> centre() const {
    const auto& [a, b, c] = corners;
    return {(a[0] + b[0] + c[0]) / 3, (a[1] + b[1] + c[1]) / 3, (a[2] + b[2] + c[2]) / 3};
  }
  Box<3> box() const {
    const auto& [a, b, c] = corners;
    return joined(joined(Box<3>{a, a}, {b, b}), {c, c});
  }
  double area() const {
    const auto& [a, b, c] = corners;
    return 0.5 * length(cross(difference(b, a), difference(c, a)));
  }
};

// The longest edge of a triangle, from corner k to the next one.
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

// The smallest d and its location; ties are decided by coordinates, independent of the rank.
struct LeastSpacing {
  double d = std::numeric_limits<double>::infinity();
  Point<3> at{};

  void add(const LeastSpacing& other) {
    if (std::tie(other.d, other.at) < std::tie(d, at)) *this = other;
  }
};

class Cutter {
 public:
  Cutter(const Communicator& comm, const Surface& surface, const SpacingEvaluator<3>& spacing,
         const NodeLimit& limit, const RankCells& cells)
      : comm_(comm), surface_(surface), spacing_(spacing), limit_(limit), cells_(cells) {
    patches_.resize(index(surface.features().patches));
  }

  std::vector<PatchPieces> run() {
    std::vector<Triangle> open = whole_facets();
    // All ranks continue as long as one does, because evaluating d may be collective.
    while (const std::int64_t batches = most_batches(open)) open = cut(open, batches);
    for (PatchPieces& patch : patches_) sort(patch.pieces);
    return std::move(patches_);
  }

 private:
  static std::size_t index(std::int32_t i) { return static_cast<std::size_t>(i); }

  std::vector<Triangle> whole_facets() {
    std::vector<Triangle> facets;
    for (std::int32_t f = 0; f < static_cast<std::int32_t>(surface_.mesh().facets.size()); ++f) {
      if (surface_.patch(f) < 0) continue;
      const Triangle facet{f, surface_.corners(f)};
      patches_[index(surface_.patch(f))].area += facet.area();
      keep(facet, facets);
    }
    for (const Triangle& facet : facets) patches_[index(surface_.patch(facet.facet))].met = true;
    for (std::int32_t p = 0; p < surface_.features().patches; ++p)
      max_d_.push_back(surface_.has_features(p)
                           ? std::numeric_limits<double>::infinity()
                           : std::sqrt(Lattice<2>::kDensity * patches_[index(p)].area /
                                       method::kMinNodesOfClosedPatch));
    return facets;
  }

  // Adds the triangle to `open` unless all its pieces belong to other ranks.
  void keep(const Triangle& triangle, std::vector<Triangle>& open) const {
    if (cells_.meet(triangle.box())) open.push_back(triangle);
  }

  std::int64_t most_batches(const std::vector<Triangle>& open) const {
    return static_cast<std::int64_t>(
        comm_.allreduce_max(static_cast<double>((std::ssize(open) + kBatch - 1) / kBatch)));
  }

  std::vector<double> spacing_at(const std::vector<Point<3>>& x, std::int64_t batches) const {
    std::vector<double> d(x.size());
    const std::int64_t count = std::ssize(x);
    for (std::int64_t batch = 0; batch < batches; ++batch) {
      const std::int64_t first = std::min(batch * kBatch, count);
      spacing_(std::min(kBatch, count - first), x.data() + first, d.data() + first);
    }
    return d;
  }

  // Halves the triangles that are too wide across their longest edge. The others become pieces.
  std::vector<Triangle> cut(const std::vector<Triangle>& open, std::int64_t batches) {
    std::vector<Point<3>> centres;
    for (const Triangle& triangle : open) centres.push_back(triangle.centre());
    const std::vector<double> d = spacing_at(centres, batches);
    std::vector<Triangle> halves;
    FixedPointSum pending;
    double pieces = 0;  // lower bound of the pieces of this rank
    for (std::size_t n = 0; n < open.size(); ++n) {
      least_.add({d[n], centres[n]});
      const std::int32_t cell = cells_.tree.leaf_at(centres[n]);
      const bool own = cells_.owns(cell);
      const double local = std::min(d[n], max_d_[index(surface_.patch(open[n].facet))]);
      const LongestEdge longest = longest_edge(open[n]);
      if (longest.length > method::kSurfacePieceEdge * local) {
        // A lower bound: where d grows inside the triangle, it may have few nodes.
        if (own) pending.add(0.25 * std::min(1.0, nodes_in(open[n].area(), local)));
        if (own)
          pieces += std::pow(longest.length / (method::kSurfacePieceEdge * local), kNeedlePower);
        halve(open[n], longest.k, halves);
      } else if (own) {
        add({{open[n].facet, centres[n]}, cell, open[n].area(), local});
      }
    }
    require_few_enough(pending);
    // Needles have many pieces and few nodes, so pieces are limited as well.
    const std::uint64_t all_pieces = comm_.allreduce_sum(
        static_cast<std::uint64_t>(std::min(pieces, kMaxThatAddUp / comm_.size())));
    limit_.require_memory_for(static_cast<double>(all_pieces), kBytesPerPiece,
                              "pieces of the surface");
    return halves;
  }

  void halve(const Triangle& triangle, std::size_t k, std::vector<Triangle>& halves) const {
    const Point<3>&a = triangle.corners[k], &b = triangle.corners[(k + 1) % 3],
          &c = triangle.corners[(k + 2) % 3];
    const Point<3> middle = middle_of<3>(a, b);
    keep({triangle.facet, {a, middle, c}}, halves);
    keep({triangle.facet, {middle, b, c}}, halves);
  }

  void add(const SurfacePiece& piece) {
    patches_[index(surface_.patch(piece.centre.facet))].pieces.push_back(piece);
    nodes_.add(nodes_in(piece.area, piece.d));
  }

  void require_few_enough(FixedPointSum all) const {
    all.add(nodes_);
    const double nodes = comm_.allreduce_sum(all).value();
    if (nodes <= static_cast<double>(limit_.max_nodes)) return;
    Bytes mine;
    pack(mine, least_);
    LeastSpacing least;
    for_records<LeastSpacing>(comm_.allgather(mine),
                              [&](const LeastSpacing& of_rank) { least.add(of_rank); });
    limit_.report_too_many(nodes, least.d, point_text(least.at));
  }

  void sort(std::vector<SurfacePiece>& pieces) const {
    std::stable_sort(pieces.begin(), pieces.end(),
                     [this](const SurfacePiece& a, const SurfacePiece& b) {
                       return morton_before(cells_.tree.fine_index(a.centre.position),
                                            cells_.tree.fine_index(b.centre.position));
                     });
  }

  const Communicator& comm_;
  const Surface& surface_;
  const SpacingEvaluator<3>& spacing_;
  const NodeLimit& limit_;
  const RankCells& cells_;
  std::vector<PatchPieces> patches_;
  std::vector<double> max_d_;  // per patch
  FixedPointSum nodes_;        // that the pieces of this rank require
  LeastSpacing least_;
};

}  // namespace

std::vector<PatchPieces> cut_to_pieces(const Communicator& comm, const Surface& surface,
                                       const SpacingEvaluator<3>& spacing, const NodeLimit& limit,
                                       const RankCells& cells) {
  return Cutter(comm, surface, spacing, limit, cells).run();
}

}  // namespace pnpbs
