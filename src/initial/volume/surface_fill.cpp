// SPDX-License-Identifier: BSD-3-Clause
#include "initial/volume/surface_fill.hpp"

#include <algorithm>
#include <cmath>
#include <span>

#include "base/execution.hpp"
#include "base/lattice.hpp"
#include "initial/initial_fill.hpp"
#include "initial/volume/flat_lattice.hpp"
#include "initial/volume/piece_sums.hpp"
#include "initial/volume/surface_pieces.hpp"
#include "method/constants.hpp"

namespace pnpbs {

namespace {

// In units of 2^-32, to the nearest: sums of these come out the same in any order.
std::int64_t wanted_nodes(const SurfacePiece& piece) {
  return fixed_point(Lattice<2>::kDensity * piece.area / (piece.d * piece.d) + 0x1p-33);
}

using Pieces = std::span<const SurfacePiece>;

// Sorted along Morton order, those of a cell follow each other.
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

// Of each patch that meets cells of this rank, and then of its pieces cell by cell.
std::vector<PiecesInCell> what_to_sum(const std::vector<PatchPieces>& patches) {
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

// The spacing at which a whole patch has as many nodes as d asks for.
double even_spacing(const PatchPieces& patch, const PatchSums& sums) {
  if (sums.min_d == sums.max_d || sums.nodes.is_zero()) return sums.min_d;
  return std::sqrt(Lattice<2>::kDensity * patch.area / sums.nodes.value());
}

// Of pieces of one cell.
void add_running_sum(const Surface& surface, Pieces pieces, const FixedPointSum& nodes_before,
                     std::vector<SurfacePoint>& nodes) {
  constexpr std::int64_t kOne = kFixedPointOne, kHalf = kOne / 2;
  std::int64_t sum = nodes_before.fraction() + kHalf;
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
      sums_over_patches(comm, surface.features().patches, what_to_sum(patches));
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
      if (!even) add_running_sum(surface, pieces, sum->nodes_before, nodes);
      ++sum;
    }
  }
  return nodes;
}

}  // namespace pnpbs
