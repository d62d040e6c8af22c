// SPDX-License-Identifier: BSD-3-Clause
#include "initial/volume/surface_fill.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <map>
#include <span>
#include <tuple>
#include <utility>
#include <vector>

#include "base/execution.hpp"
#include "base/fixed_point.hpp"
#include "base/index.hpp"
#include "base/lattice.hpp"
#include "base/limits.hpp"
#include "base/space_vectors.hpp"
#include "comm/communicator.hpp"
#include "comm/records.hpp"
#include "domain/volume/surface.hpp"
#include "geometry/volume/triangles.hpp"
#include "initial/initial_fill.hpp"
#include "initial/volume/surface_pieces.hpp"
#include "method/constants.hpp"
#include "predicates/plane.hpp"
#include "tree/box_tree.hpp"

namespace pnpbs {
namespace {

constexpr double kParallel = 1e-4;   // angle below which directions are parallel [radians]
constexpr double kRounding = 1e-12;  // rounding of positions [size of a patch]

// A chain of feature edges with one direction.
struct StraightRun {
  Point<3> begin, end;
  double length() const { return distance<3>(begin, end); }
  Point<3> direction() const { return unit_vector(difference(end, begin)); }
};

std::vector<StraightRun> straight_runs(const Surface& surface, std::int32_t patch) {
  std::vector<StraightRun> runs;
  const auto position = [&](std::int32_t node) {
    return surface.mesh().nodes[index(node)].position;
  };
  for (const FeatureCurve& curve : surface.features().curves) {
    bool goes_on = false;
    for (std::size_t e = 0; e < curve.edge_count(); ++e) {
      const std::vector<std::int32_t>& facets = curve.facets[e];
      if (std::none_of(facets.begin(), facets.end(),
                       [&](std::int32_t f) { return surface.patch(f) == patch; }))
        break;  // no other edge of this curve bounds the patch
      const StraightRun edge{position(curve.nodes[e]), position(curve.nodes[e + 1])};
      if (goes_on && distance<3>(edge.direction(), runs.back().direction()) < kParallel)
        runs.back().end = edge.end;
      else
        runs.push_back(edge);
      goes_on = true;
    }
  }
  return runs;
}

// A flat patch with coordinates (u, v) in its plane.
class FlatPatch {
 public:
  FlatPatch(const Surface& surface, const std::vector<std::int32_t>& facets, const Point<3>& origin,
            const Point<3>& along, const Point<3>& across)
      : surface_(surface), facets_(facets), origin_(origin), along_(along), across_(across) {
    std::vector<Box<2>> boxes;
    for (const std::int32_t f : facets) {
      const std::array<Point<2>, 3> x = corners(f);
      boxes.push_back(joined(joined(Box<2>{x[0], x[0]}, {x[1], x[1]}), {x[2], x[2]}));
      bounds_ = boxes.size() == 1 ? boxes[0] : joined(bounds_, boxes.back());
      for (const Point<3>& corner : surface.corners(f))
        height_ = std::max(height_, distance<3>(corner, in_plane(coordinates(corner))));
    }
    boxes_ = BoxTree<2>(std::move(boxes));
  }

  const Box<2>& bounds() const { return bounds_; }

  Point<2> coordinates(const Point<3>& x) const {
    const Point<3> way = difference(x, origin_);
    return {dot(way, along_), dot(way, across_)};
  }

  // Returns a box around all nodes with coordinates in x. It has a margin because facets may
  // deviate slightly from the plane.
  Box<3> box_around(const Box<2>& x) const {
    Box<3> box = empty_box<3>();
    for (const double u : {x.low[0], x.high[0]})
      for (const double v : {x.low[1], x.high[1]}) include(box, in_plane({u, v}));
    const double size = bounds_.high[0] - bounds_.low[0] + bounds_.high[1] - bounds_.low[1];
    return widened(box, 2 * height_ + kRounding * size);
  }

  // Returns the point of the patch at these coordinates, with the first of the facets there. Facet
  // -1 means outside the patch.
  SurfacePoint at(const Point<2>& x) const {
    std::int32_t facet = std::numeric_limits<std::int32_t>::max();
    boxes_.for_holding(x, [&](std::int32_t n) {
      const std::int32_t f = facets_[index(n)];
      if (f < facet && holds(f, x)) facet = f;
    });
    if (facet == std::numeric_limits<std::int32_t>::max()) return {-1, {}};
    return {facet, nearest_on(surface_.corners(facet), in_plane(x))};
  }

 private:
  Point<3> in_plane(const Point<2>& x) const {
    return shifted(shifted(origin_, x[0], along_), x[1], across_);
  }

  std::array<Point<2>, 3> corners(std::int32_t f) const {
    const auto [a, b, c] = surface_.corners(f);
    return {coordinates(a), coordinates(b), coordinates(c)};
  }

  bool holds(std::int32_t f, const Point<2>& x) const {
    const auto [a, b, c] = corners(f);
    return orientation(a, b, x) >= 0 && orientation(b, c, x) >= 0 && orientation(c, a, x) >= 0;
  }

  const Surface& surface_;
  const std::vector<std::int32_t>& facets_;
  Point<3> origin_, along_, across_;
  Box<2> bounds_{};
  double height_ = 0;  // largest distance of a corner from the plane
  BoxTree<2> boxes_;
};

// Returns the distance between the first row and the farthest long edge parallel to it; 0 if there
// is none.
double distance_to_parallel(const FlatPatch& flat, const std::vector<StraightRun>& runs,
                            const StraightRun& base) {
  double farthest = 0;
  for (const StraightRun& run : runs) {
    const Point<2> a = flat.coordinates(run.begin), b = flat.coordinates(run.end);
    const bool parallel = std::fabs(b[1] - a[1]) < kParallel * run.length();
    if (!parallel || run.length() < 0.5 * base.length()) continue;
    if (std::fabs(a[1]) > std::fabs(farthest)) farthest = a[1];
  }
  return std::fabs(farthest);
}

// Ranges of rows and columns of a lattice. The last ones are excluded.
struct Block {
  std::int64_t first_row, last_row, first_column, last_column;

  bool empty() const { return first_row >= last_row || first_column >= last_column; }
  std::int64_t rows() const { return last_row - first_row; }
  std::int64_t columns() const { return last_column - first_column; }
};

// A hexagonal lattice: rows `row` apart, nodes `step` apart, every second row shifted by half a
// step.
class Rows {
 public:
  Rows(const FlatPatch& flat, double step, double row) : flat_(flat), step_(step), row_(row) {}

  Block whole() const {
    const Box<2>& bounds = flat_.bounds();
    return {whole_number(std::ceil(bounds.low[1] / row_)),
            whole_number(std::floor(bounds.high[1] / row_)) + 1,
            whole_number(std::ceil(bounds.low[0] / step_ - 0.5)),
            whole_number(std::floor(bounds.high[0] / step_)) + 1};
  }

  Point<2> place(std::int64_t r, std::int64_t column) const {
    const double shift = r % 2 != 0 ? 0.5 * step_ : 0;
    return {shift + step_ * static_cast<double>(column), row_ * static_cast<double>(r)};
  }

  // Calls visit(x) for lattice points that may lie in cells of this rank. Halves a block until it
  // is small or meets no such cell.
  template <class Visit>
  void for_places(const Block& block, const RankCells& cells, const Visit& visit) const {
    constexpr std::int64_t kSmall = 8;
    if (block.empty() || !cells.meet(flat_.box_around(box_of(block)))) return;
    Block one = block, other = block;
    if (std::max(block.rows(), block.columns()) <= kSmall) {
      for (std::int64_t r = block.first_row; r < block.last_row; ++r)
        for (std::int64_t c = block.first_column; c < block.last_column; ++c) visit(place(r, c));
      return;
    }
    if (block.rows() > block.columns())
      one.last_row = other.first_row = block.first_row + block.rows() / 2;
    else
      one.last_column = other.first_column = block.first_column + block.columns() / 2;
    for_places(one, cells, visit);
    for_places(other, cells, visit);
  }

 private:
  static std::int64_t whole_number(double t) { return static_cast<std::int64_t>(t); }

  Box<2> box_of(const Block& block) const {
    const auto first_column = static_cast<double>(block.first_column),
               last_column = static_cast<double>(block.last_column);
    return {{step_ * first_column, row_ * static_cast<double>(block.first_row)},
            {step_ * (last_column - 0.5), row_ * static_cast<double>(block.last_row - 1)}};
  }

  const FlatPatch& flat_;
  double step_, row_;
};

// Returns the lattice nodes of a flat patch that lie in cells of this rank. The longest straight
// feature edge is a row of the lattice; if another long edge is parallel to it, rows are fitted in
// between. Nodes keep `clearance` times their distance from features.
std::vector<SurfacePoint> flat_lattice(const Surface& surface, std::int32_t patch,
                                       const std::vector<std::int32_t>& facets, double d,
                                       double clearance, const RankCells& cells) {
  const std::vector<StraightRun> runs = straight_runs(surface, patch);
  if (runs.empty() || facets.empty()) return {};
  const StraightRun& base = *std::max_element(
      runs.begin(), runs.end(),
      [](const StraightRun& a, const StraightRun& b) { return a.length() < b.length(); });
  const Point<3> along = base.direction(), across = cross(surface.normal(facets[0]), along);
  const FlatPatch flat(surface, facets, base.begin, along, across);

  const auto fitted = [](double step, double extent) {
    const double steps = std::round(extent / step);
    return steps >= 1 ? extent / steps : step;
  };
  const double step = fitted(d, base.length());
  const double row = fitted(std::sqrt(0.75) * d, distance_to_parallel(flat, runs, base));
  // A node half a step beside an edge is far enough, even if steps are shorter than d.
  const double free = (1 - 1e-9) * clearance * std::min(step, d);
  std::vector<SurfacePoint> nodes;
  const Rows rows(flat, step, row);
  rows.for_places(rows.whole(), cells, [&](const Point<2>& x) {
    const SurfacePoint at = flat.at(x);
    if (at.facet >= 0 && cells.hold(at.position) && surface.feature_clearance(at, free) >= free)
      nodes.push_back(at);
  });
  return nodes;
}

// Sums over the pieces of each patch. Each patch is assigned to a rank that sums over its cells, so
// messages grow with the cells and patches of a rank and not with its pieces.

// The sum over the pieces of a patch in one cell. kNoCell requests the sums of the patch without
// adding pieces.
struct PiecesInCell {
  static constexpr std::int32_t kNoCell = -1;

  std::int32_t patch, cell = kNoCell;
  FixedPointSum nodes{};  // number of nodes that d requires
  double min_d = std::numeric_limits<double>::infinity(), max_d = 0;
};

// The sums of a patch.
struct PatchSums {
  FixedPointSum start_nodes;  // in the cells before this one
  FixedPointSum nodes;        // in all cells
  double min_d = std::numeric_limits<double>::infinity(), max_d = 0;
};

// A request for the sums of a patch, and the rank that sent it.
struct Question {
  PiecesInCell pieces;
  int rank;
};

// Returns the sums in the order of the requests.
std::vector<PatchSums> answers_to(const std::vector<Question>& questions) {
  std::vector<std::size_t> order;
  for (std::size_t k = 0; k < questions.size(); ++k) order.push_back(k);
  std::sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
    const PiecesInCell &x = questions[a].pieces, &y = questions[b].pieces;
    return std::tie(x.patch, x.cell) < std::tie(y.patch, y.cell);
  });
  std::map<std::int32_t, PatchSums> whole;
  std::vector<PatchSums> answers(questions.size());
  for (const std::size_t k : order) {
    const PiecesInCell& pieces = questions[k].pieces;
    PatchSums& patch = whole[pieces.patch];
    answers[k].start_nodes = patch.nodes;
    patch.nodes.add(pieces.nodes);
    patch.min_d = std::min(patch.min_d, pieces.min_d);
    patch.max_d = std::max(patch.max_d, pieces.max_d);
  }
  for (std::size_t k = 0; k < questions.size(); ++k) {
    const PatchSums& patch = whole[questions[k].pieces.patch];
    answers[k] = {answers[k].start_nodes, patch.nodes, patch.min_d, patch.max_d};
  }
  return answers;
}

// Collective. Returns the patch sums for each entry of `own`. `own` must be ascending by patch (0
// to `patches` - 1), and each cell must belong to one rank. The result does not depend on which
// rank owns a cell.
std::vector<PatchSums> sums_over_patches(const Communicator& comm, std::int32_t patches,
                                         const std::vector<PiecesInCell>& own) {
  const auto asked = [&](std::int32_t patch) {
    return static_cast<int>(std::int64_t{patch} * comm.size() / patches);
  };
  Outbox outgoing, answered;
  for (const PiecesInCell& pieces : own) pack(outgoing.to(asked(pieces.patch)), pieces);
  std::vector<Question> questions;
  for (const Message& theirs : comm.sparse_all_to_all(outgoing.messages()))
    for_records<PiecesInCell>(theirs.bytes, [&](const PiecesInCell& pieces) {
      questions.push_back({pieces, theirs.rank});
    });
  const std::vector<PatchSums> answers = answers_to(questions);
  for (std::size_t k = 0; k < questions.size(); ++k)
    pack(answered.to(questions[k].rank), answers[k]);
  // Messages come in the order of ranks, which is that of the patches.
  std::vector<PatchSums> sums;
  sums.reserve(own.size());
  for (const Message& theirs : comm.sparse_all_to_all(answered.messages()))
    for_records<PatchSums>(theirs.bytes, [&](const PatchSums& sum) { sums.push_back(sum); });
  return sums;
}

// Returns the number of nodes that d requires on a piece, rounded. [2^-32] Sums do not depend on
// their order.
std::int64_t wanted_nodes(const SurfacePiece& piece) {
  return fixed_point(Lattice<2>::kDensity * piece.area / (piece.d * piece.d) + 0x1p-33);
}

using Pieces = std::span<const SurfacePiece>;

// Divides pieces in Morton order into those of each cell, which are contiguous.
std::vector<Pieces> cell_by_cell(const std::vector<SurfacePiece>& pieces) {
  std::vector<Pieces> cells;
  std::size_t first = 0;
  for (std::size_t n = 1; n <= pieces.size(); ++n) {
    if (n < pieces.size() && pieces[n].cell == pieces[first].cell) continue;
    cells.push_back(Pieces(pieces).subspan(first, n - first));
    first = n;
  }
  return cells;
}

// Returns, for each patch that meets cells of this rank, one entry without a cell and then one
// entry per cell with pieces.
std::vector<PiecesInCell> entries_to_sum(const std::vector<PatchPieces>& patches) {
  std::vector<PiecesInCell> found;
  for (std::size_t p = 0; p < patches.size(); ++p) {
    if (!patches[p].met) continue;
    const auto patch = static_cast<std::int32_t>(p);
    found.push_back({.patch = patch});
    for (const Pieces pieces : cell_by_cell(patches[p].pieces)) {
      PiecesInCell& in_cell = found.emplace_back();
      in_cell.patch = patch;
      in_cell.cell = pieces.front().cell;
      for (const SurfacePiece& piece : pieces) {
        in_cell.nodes.add_units(wanted_nodes(piece));
        in_cell.min_d = std::min(in_cell.min_d, piece.d);
        in_cell.max_d = std::max(in_cell.max_d, piece.d);
      }
    }
  }
  return found;
}

// Returns the constant spacing at which the patch has as many nodes as d requires.
double even_spacing(const PatchPieces& patch, const PatchSums& sums) {
  if (sums.min_d == sums.max_d || sums.nodes.is_zero()) return sums.min_d;
  return std::sqrt(Lattice<2>::kDensity * patch.area / sums.nodes.value());
}

// Appends the nodes of the pieces of one cell. `start_nodes` is the sum over the cells before.
void add_running_sum(const Surface& surface, Pieces pieces, const FixedPointSum& start_nodes,
                     std::vector<SurfacePoint>& nodes) {
  constexpr std::int64_t kOne = kFixedPointOne, kHalf = kOne / 2;
  std::int64_t sum = start_nodes.fraction() + kHalf;
  for (const SurfacePiece& piece : pieces) {
    const std::int64_t whole = sum / kOne;
    sum += wanted_nodes(piece);
    if (sum / kOne == whole) continue;
    const double clearance = method::kFillClearance * piece.d;
    if (surface.feature_clearance(piece.centre, clearance) >= clearance)
      nodes.push_back(piece.centre);
  }
}

std::vector<std::vector<std::int32_t>> facets_of_patches(const Features& features) {
  std::vector<std::vector<std::int32_t>> facets(static_cast<std::size_t>(features.patches));
  for (std::size_t f = 0; f < features.patch.size(); ++f)
    if (features.patch[f] >= 0)
      facets[static_cast<std::size_t>(features.patch[f])].push_back(static_cast<std::int32_t>(f));
  return facets;
}

}  // namespace

std::vector<SurfacePoint> surface_fill(const Communicator& comm, const Surface& surface,
                                       const SpacingEvaluator<3>& spacing, const NodeLimit& limit,
                                       const RankCells& cells) {
  const std::vector<PatchPieces> patches = cut_to_pieces(comm, surface, spacing, limit, cells);
  const std::vector<PatchSums> sums =
      sums_over_patches(comm, surface.features().patches, entries_to_sum(patches));
  const std::vector<std::vector<std::int32_t>> facets = facets_of_patches(surface.features());
  std::vector<SurfacePoint> nodes;
  auto sum = sums.begin();
  for (std::size_t p = 0; p < patches.size(); ++p) {
    if (!patches[p].met) continue;
    const auto patch = static_cast<std::int32_t>(p);
    const PatchSums& whole = *sum++;
    const bool even =
        surface.is_flat(patch) && whole.max_d <= method::kPatchVariation * whole.min_d;
    if (even) {
      const std::vector<SurfacePoint> lattice =
          flat_lattice(surface, patch, facets[p], even_spacing(patches[p], whole),
                       method::kFillClearance, cells);
      nodes.insert(nodes.end(), lattice.begin(), lattice.end());
    }
    for (const Pieces pieces : cell_by_cell(patches[p].pieces)) {
      if (!even) add_running_sum(surface, pieces, sum->start_nodes, nodes);
      ++sum;
    }
  }
  return nodes;
}

}  // namespace pnpbs
