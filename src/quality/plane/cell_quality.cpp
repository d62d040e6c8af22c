// SPDX-License-Identifier: BSD-3-Clause
#include "quality/plane/cell_quality.hpp"

#include <algorithm>
#include <array>
#include <limits>
#include <optional>
#include <vector>

#include "base/fixed_point.hpp"
#include "quality/plane/cell_centroids.hpp"
#include "quality/plane/voronoi_ring.hpp"

namespace pnpbs {

namespace {

// The direction in which a figure gets worse.
enum class Worse { larger, smaller };

// Number, sum and worst value of a figure on this rank.
struct FigureSums {
  std::int64_t number = 0;
  FixedPointSum sum;
  double worst = -std::numeric_limits<double>::infinity();  // negated if smaller values are worse

  // Adds a bounded value. The circumcentre of a nearly flat triangle may be anywhere, and a single
  // one must not dominate the mean.
  void add(double value, Worse worse) {
    constexpr double kMost = 33;
    const double bounded = worse == Worse::larger ? (value < kMost ? value : kMost)
                                                  : (value > 0 ? value : 0);  // 0 for NaN
    ++number;
    sum.add(bounded);
    worst = std::max(worst, worse == Worse::larger ? bounded : -bounded);
  }
  void add(const FigureSums& other) {
    number += other.number;
    sum.add(other.sum);
    worst = std::max(worst, other.worst);
  }
  CellFigure figure(Worse worse) const {
    if (number == 0) return {};
    return {number, sum.value() / static_cast<double>(number),
            worse == Worse::larger ? worst : -worst};
  }
};

// Sums of the figures of a CellShape.
struct ShapeSums {
  enum Figure : std::size_t { edge_ratio, area_ratio, dual_offset, kFigures };
  static constexpr std::array<Worse, kFigures> kWorse{Worse::smaller, Worse::smaller,
                                                      Worse::larger};
  std::array<FigureSums, kFigures> of;

  void add(Figure figure, double value) { of[figure].add(value, kWorse[figure]); }
  void add(const ShapeSums& other) {
    for (std::size_t k = 0; k < kFigures; ++k) of[k].add(other.of[k]);
  }
  CellShape shape() const {
    const auto figure = [&](Figure k) { return of[k].figure(kWorse[k]); };
    return {figure(edge_ratio), figure(area_ratio), figure(dual_offset)};
  }
};

// All sums that a rank contributes to a CellQuality.
struct CellSums {
  std::int64_t cells = 0, uncrossed = 0;
  FixedPointSum offset;
  double max_offset = 0;
  std::array<ShapeSums, SpacingBands::kMaxBands> bands;

  ShapeSums& in_band(int band) { return bands[static_cast<std::size_t>(band)]; }
  void add(const CellSums& other) {
    cells += other.cells;
    uncrossed += other.uncrossed;
    offset.add(other.offset);
    max_offset = std::max(max_offset, other.max_offset);
    for (std::size_t k = 0; k < bands.size(); ++k) bands[k].add(other.bands[k]);
  }
};

// Sums of one thread, with scratch storage for a cell.
template <int N>
struct CellWork {
  CellSums sums;
  VoronoiRing<N> ring;

  void add(const CellWork& other) { sums.add(other.sums); }
};

// The measurement of this rank's cells. It has two passes, because the second requires the areas at
// ghosts.
template <int N>
class CellMeasurement {
 public:
  CellMeasurement(const MeasuredNodes<2>& measured, const DelaunayStars& stars,
                  const SpacingBands& bands)
      : measured_(measured),
        nodes_(measured.nodes),
        stars_(stars),
        bands_(bands),
        centroids_(measured.nodes, stars, measured.embedding),
        areas_(make_view<double>("pnpbs::cell_areas", measured.nodes.count)) {}

  // Computes all sums but those of area ratios, and the areas of the cells.
  CellSums sums_of_cells() {
    return sums_over("pnpbs::measure_cells", nodes_.count, CellWork<N>(),
                     [&](std::int64_t i, CellWork<N>& work) {
                       areas_(i) = 0;
                       if (nodes_.owned(i)) measure(i, work.ring, work.sums);
                     })
        .sums;
  }
  // Returns the area of each owned node's cell; 0 for nodes without a measured cell.
  const View<double>& areas() const { return areas_; }
  // Computes the sums of area ratios. The areas at ghosts must be filled before.
  CellSums sums_of_areas() const {
    return sums_over("pnpbs::measure_cell_areas", nodes_.count, CellSums(),
                     [&](std::int64_t i, CellSums& sums) {
                       if (nodes_.owned(i) && areas_(i) > 0) compare_areas(i, sums);
                     });
  }

 private:
  void measure(std::int64_t i, VoronoiRing<N>& ring, CellSums& sums) {
    ring.gather(measured_, stars_, i);
    for (std::size_t k = 0; k < ring.size(); ++k)
      sums.uncrossed += counts_here(i, ring.neighbour(k)) && ring.is_uncrossed(k);
    if (!centroids_.has(i)) return;
    const double d = measured_.d(i), offset = measured_.distance_to(i, centroids_.of(i)) / d;
    ++sums.cells;
    sums.offset.add(offset);
    sums.max_offset = std::max(sums.max_offset, offset);
    ring.find_vertices();
    areas_(i) = ring.area();
    sums.in_band(bands_.band_of(d)).add(ShapeSums::edge_ratio, ring.edge_ratio());
    for (std::size_t k = 0; k < ring.size(); ++k) {
      const std::int64_t j = ring.neighbour(k);
      if (!counts_here(i, j) || !nodes_.moves(j)) continue;
      sums.in_band(band_of_edge(i, j)).add(ShapeSums::dual_offset, ring.dual_offset(k));
    }
  }

  void compare_areas(std::int64_t i, CellSums& sums) const {
    stars_.for_neighbours(i, [&](std::int64_t j) {
      if (!counts_here(i, j) || !(areas_(j) > 0)) return;
      const auto [smaller, larger] = std::minmax(areas_(i), areas_(j));
      sums.in_band(band_of_edge(i, j)).add(ShapeSums::area_ratio, smaller / larger);
    });
  }

  // Returns whether edge (i, j) is counted at node i: at its end with the smaller id.
  bool counts_here(std::int64_t i, std::int64_t j) const { return nodes_.id(i) < nodes_.id(j); }
  int band_of_edge(std::int64_t i, std::int64_t j) const {
    return bands_.count() == 1 ? 0 : bands_.band_of(0.5 * (measured_.d(i) + measured_.d(j)));
  }

  const MeasuredNodes<2>& measured_;
  const Nodes<2>& nodes_;
  const DelaunayStars& stars_;
  const SpacingBands& bands_;
  const CellCentroids centroids_;
  const View<double> areas_;
};

// Returns the sums of this rank. Collective: areas at ghosts are exchanged.
template <int N>
CellSums local_sums(const Communicator& comm, const MeasuredNodes<2>& measured,
                    const DelaunayStars& stars, const SpacingBands& bands,
                    const FillGhosts& fill_ghosts) {
  std::optional<CellMeasurement<N>> cells;
  CellSums sums;
  collective_try(comm, [&] {
    cells.emplace(measured, stars, bands);
    sums = cells->sums_of_cells();
  });
  fill_ghosts(cells->areas());
  sums.add(cells->sums_of_areas());
  return sums;
}

// Replaces the sums of this rank by those of all ranks. Collective.
void add_ranks(const Communicator& comm, CellSums& sums) {
  std::vector<std::int64_t> numbers{sums.cells, sums.uncrossed};
  std::vector<FixedPointSum> values{sums.offset};
  for (ShapeSums& band : sums.bands)
    for (FigureSums& figure : band.of) {
      numbers.push_back(figure.number);
      values.push_back(figure.sum);
    }
  comm.allreduce_sum(numbers, values);
  sums.cells = numbers[0];
  sums.uncrossed = numbers[1];
  sums.offset = values[0];
  sums.max_offset = comm.allreduce_max(sums.max_offset);
  std::size_t next = 0;
  for (ShapeSums& band : sums.bands)
    for (FigureSums& figure : band.of) {
      figure.number = numbers[next + 2];
      figure.sum = values[++next];
      if (figure.number > 0) figure.worst = comm.allreduce_max(figure.worst);
    }
}

}  // namespace

CellQuality measure_cells(const Communicator& comm, const MeasuredNodes<2>& measured,
                          const DelaunayStars& stars, const SpacingBands& bands,
                          const FillGhosts& fill_ghosts) {
  CellSums sums = measured.embedding.is_sphere()
                      ? local_sums<3>(comm, measured, stars, bands, fill_ghosts)
                      : local_sums<2>(comm, measured, stars, bands, fill_ghosts);
  add_ranks(comm, sums);
  CellQuality found;
  found.mean_offset = sums.cells > 0 ? sums.offset.value() / static_cast<double>(sums.cells) : 0;
  found.max_offset = sums.max_offset;
  found.uncrossed = sums.uncrossed;
  ShapeSums all;
  for (int band = 0; band < bands.count(); ++band) {
    all.add(sums.in_band(band));
    const CellShape shape = sums.in_band(band).shape();
    if (shape.edge_ratio.number + shape.dual_offset.number > 0)
      found.bands.push_back({bands.from(band), bands.to(band), shape});
  }
  found.shape = all.shape();
  return found;
}

}  // namespace pnpbs
