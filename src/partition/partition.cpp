// SPDX-License-Identifier: BSD-3-Clause
#include "partition/partition.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <numeric>
#include <tuple>

#include "base/build_config.hpp"
#include "partition/metis_functions.hpp"
#include "tree/leaf_graph.hpp"

namespace pnpbs {

std::vector<std::int32_t> cut_morton_order(const std::vector<std::int64_t>& work, int ranks) {
  const std::int64_t total =
      std::max<std::int64_t>(1, std::accumulate(work.begin(), work.end(), std::int64_t{0}));
  std::vector<std::int32_t> owner(work.size());
  std::int64_t before = 0;
  for (std::size_t cell = 0; cell < work.size(); ++cell) {
    const double middle = static_cast<double>(before) + 0.5 * static_cast<double>(work[cell]);
    owner[cell] =
        std::min(ranks - 1, static_cast<std::int32_t>(middle / static_cast<double>(total) * ranks));
    before += work[cell];
  }
  return owner;
}

namespace {

#if PNPBS_HAVE_MPI

std::vector<idx_t> as_metis(const std::vector<std::int32_t>& values) {
  return {values.begin(), values.end()};
}

constexpr int kMaxBisected = 32, kMaxTried = 8;  // numbers of ranks

bool cut_graph(const CellGraph& graph, int ranks, std::int64_t seed, std::vector<idx_t>& part) {
  idx_t vertices = static_cast<idx_t>(graph.cell.size()), parts = ranks, cut = 0;
  if (vertices < 4 * parts) return false;
  idx_t constraints = static_cast<idx_t>(graph.weight.size()) / vertices;
  idx_t options[METIS_NOPTIONS];
  metis().set_default_options(options);
  options[METIS_OPTION_SEED] = static_cast<idx_t>(seed);
  // Allows an imbalance of 1.015, or of 1.03 with rare work, because few cells have some of it.
  options[METIS_OPTION_UFACTOR] = constraints == 1 ? 15 : 30;
  // With few parts, recursive bisection cuts a fifth less than k-way partitioning, and the best of
  // several tries even less. Its cost grows with the number of parts.
  const bool bisect = ranks <= kMaxBisected;
  if (ranks <= kMaxTried) options[METIS_OPTION_NCUTS] = 10;
  part.resize(graph.cell.size());
  std::vector<idx_t> offset = as_metis(graph.offset), neighbour = as_metis(graph.neighbour),
                     weight = as_metis(graph.weight), cut_weight = as_metis(graph.cut_weight);
  return (bisect ? metis().part_graph_recursive : metis().part_graph_kway)(
             &vertices, &constraints, offset.data(), neighbour.data(), weight.data(), nullptr,
             cut_weight.data(), &parts, nullptr, nullptr, options, &cut, part.data()) == METIS_OK;
}

#endif

}  // namespace

double imbalance(const std::vector<std::int32_t>& owner, const std::vector<std::int64_t>& work,
                 int ranks) {
  std::vector<std::int64_t> sums(static_cast<std::size_t>(ranks), 0);
  std::int64_t total = 0;
  for (std::size_t cell = 0; cell < work.size(); ++cell) {
    sums[static_cast<std::size_t>(owner[cell])] += work[cell];
    total += work[cell];
  }
  if (total == 0) return 1;
  return static_cast<double>(*std::max_element(sums.begin(), sums.end())) * ranks /
         static_cast<double>(total);
}

template <int Dim>
std::vector<std::int32_t> cut_by_metis(const PartitionCells<Dim>& cells, int ranks,
                                       std::int64_t seed) {
  std::vector<std::int32_t> owner = cut_morton_order(cells.work(), ranks);
  if (ranks == 1) return owner;
#if PNPBS_HAVE_MPI
  const CellGraph graph = cell_graph(cells);
  std::vector<idx_t> part;
  if (!cut_graph(graph, ranks, seed, part)) return owner;
  std::vector<std::int32_t> cut = owner;
  for (std::size_t v = 0; v < part.size(); ++v)
    cut[static_cast<std::size_t>(graph.cell[v])] = static_cast<std::int32_t>(part[v]);
  // METIS has left a part empty or much too large.
  if (imbalance(cut, cells.work(), ranks) > 1.1 * imbalance(owner, cells.work(), ranks))
    return owner;
  return cut;
#else
  static_cast<void>(seed);
  return owner;
#endif
}

// Matches parts and ranks greedily, the pair with the most common work first. Parts without common
// work get the remaining ranks in increasing order.
std::vector<std::int32_t> renumbered_parts(std::vector<std::int32_t> owner,
                                           std::vector<KeptWork> kept, int ranks) {
  std::sort(kept.begin(), kept.end(), [](const KeptWork& a, const KeptWork& b) {
    return std::tie(b.work, a.part, a.rank) < std::tie(a.work, b.part, b.rank);
  });
  std::vector<int> rank_of(static_cast<std::size_t>(ranks), -1);
  std::vector<char> taken(static_cast<std::size_t>(ranks), 0);
  const auto match = [&](int part, int rank) {
    rank_of[static_cast<std::size_t>(part)] = rank;
    taken[static_cast<std::size_t>(rank)] = 1;
  };
  for (const KeptWork& entry : kept)
    if (rank_of[static_cast<std::size_t>(entry.part)] < 0 &&
        !taken[static_cast<std::size_t>(entry.rank)])
      match(entry.part, entry.rank);
  int free = 0;
  for (int part = 0; part < ranks; ++part) {
    if (rank_of[static_cast<std::size_t>(part)] >= 0) continue;
    while (taken[static_cast<std::size_t>(free)]) ++free;
    match(part, free);
  }
  for (std::int32_t& part : owner) part = rank_of[static_cast<std::size_t>(part)];
  return owner;
}

template std::vector<std::int32_t> cut_by_metis(const PartitionCells<2>&, int, std::int64_t);
template std::vector<std::int32_t> cut_by_metis(const PartitionCells<3>&, int, std::int64_t);

namespace {

// Returns the length of the side (area of the face) that two touching cells share, 0 if they share
// none. The shortest of the common extents is the one across the face and is left out.
template <int Dim>
double shared_face(const Box<Dim>& a, const Box<Dim>& b) {
  std::array<double, Dim> common;
  for (int k = 0; k < Dim; ++k)
    common[k] = std::max(0.0, std::min(a.high[k], b.high[k]) - std::max(a.low[k], b.low[k]));
  std::sort(common.begin(), common.end());
  return std::accumulate(common.begin() + 1, common.end(), 1.0, std::multiplies<>());
}

// Returns the number of nodes per unit of length for a number per unit of area (volume).
template <int Dim>
double nodes_per_length(double density) {
  return Dim == 2 ? std::sqrt(density) : std::cbrt(density);
}

// Returns whether cells are linked. A common face is the whole face of the smaller cell; a smaller
// value is a rounding error.
template <int Dim>
bool is_linked(double face, double smaller_side) {
  return Dim == 2 || face > 0.5 * std::pow(smaller_side, Dim - 1);
}

// Returns what a sum of weights must be divided by to fit into the integers of METIS.
std::int64_t scale_of(const std::vector<std::int64_t>& weights) {
  return std::max<std::int64_t>(
      1, std::accumulate(weights.begin(), weights.end(), std::int64_t{0}) / 1000000000);
}

// Extent of a cell and density of its work, for the links to its neighbours.
template <int Dim>
struct CellExtent {
  Box<Dim> box;
  double side, density;  // work per area (volume)

  CellExtent(const PartitionCells<Dim>& cells, std::int32_t c)
      : box(cells.tree().cell_box(cells.tree().leaf_cell(c))),
        side(cells.tree().cell_side(cells.tree().leaf_cell(c))),
        density(static_cast<double>(cells.work(c)) / std::pow(side, Dim)) {}
};

}  // namespace

template <int Dim>
CellGraph cell_graph(const PartitionCells<Dim>& cells) {
  const BackgroundTree<Dim>& tree = cells.tree();
  const LeafGraph<Dim> touching(tree, std::vector<double>(static_cast<std::size_t>(cells.count()),
                                                          std::ldexp(tree.side(), -40)));
  CellGraph result;
  std::vector<std::int32_t> vertex(static_cast<std::size_t>(cells.count()), -1);
  for (std::int32_t c = 0; c < cells.count(); ++c) {
    if (cells.work(c) <= 0) continue;
    vertex[static_cast<std::size_t>(c)] = static_cast<std::int32_t>(result.cell.size());
    result.cell.push_back(c);
  }
  const std::vector<std::int64_t>& rare = cells.rare_work();
  const std::int64_t scale = scale_of(cells.work()), rare_scale = scale_of(rare);
  const bool has_rare = std::ranges::any_of(rare, [](std::int64_t work) { return work > 0; });
  for (std::int32_t c : result.cell) {
    const CellExtent<Dim> own(cells, c);
    touching.for_neighbours(c, [&](std::int32_t other) {
      if (other == c || vertex[static_cast<std::size_t>(other)] < 0) return;
      const CellExtent<Dim> near(cells, other);
      // The number of pairs across the common face is about the number of bubbles in it.
      double pairs = shared_face<Dim>(own.box, near.box);
      if (!is_linked<Dim>(pairs, std::min(own.side, near.side))) return;
      const double per_length = nodes_per_length<Dim>(std::max(own.density, near.density));
      for (int k = 1; k < Dim; ++k) pairs *= per_length;
      result.neighbour.push_back(vertex[static_cast<std::size_t>(other)]);
      result.cut_weight.push_back(static_cast<std::int32_t>(1 + std::min(pairs, 1e6)));
    });
    result.offset.push_back(static_cast<std::int32_t>(result.neighbour.size()));
    result.weight.push_back(
        static_cast<std::int32_t>(std::max<std::int64_t>(1, cells.work(c) / scale)));
    if (has_rare)
      result.weight.push_back(
          static_cast<std::int32_t>(rare[static_cast<std::size_t>(c)] / rare_scale));
  }
  return result;
}

template CellGraph cell_graph(const PartitionCells<2>&);
template CellGraph cell_graph(const PartitionCells<3>&);

}  // namespace pnpbs
