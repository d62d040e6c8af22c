// SPDX-License-Identifier: BSD-3-Clause
#include "parallel/partition.hpp"

#include <algorithm>
#include <numeric>

#include "core/build_config.hpp"

#if PNPBS_HAVE_MPI
#include <metis.h>
#endif

namespace pnpbs {

namespace {

// Equal shares of the work along the Morton order.
std::vector<std::int32_t> cut_morton_order(const std::vector<std::int64_t>& work, int ranks) {
  const std::int64_t total =
      std::max<std::int64_t>(1, std::accumulate(work.begin(), work.end(), std::int64_t{0}));
  std::vector<std::int32_t> owner(work.size());
  std::int64_t before = 0;
  for (std::size_t leaf = 0; leaf < work.size(); ++leaf) {
    const double middle = static_cast<double>(before) + 0.5 * static_cast<double>(work[leaf]);
    owner[leaf] =
        std::min(ranks - 1, static_cast<std::int32_t>(middle / static_cast<double>(total) * ranks));
    before += work[leaf];
  }
  return owner;
}

#if PNPBS_HAVE_MPI

// The graph of the leaves that have work; METIS dislikes weights of 0 and empty graphs.
struct WorkGraph {
  std::vector<std::int32_t> leaf;  // of each vertex
  std::vector<idx_t> offset{0}, neighbour, weight;
};

WorkGraph make_graph(const LeafGraph<2>& graph, const std::vector<std::int64_t>& work) {
  WorkGraph result;
  std::vector<std::int32_t> vertex(work.size(), -1);
  for (std::size_t leaf = 0; leaf < work.size(); ++leaf) {
    if (work[leaf] == 0) continue;
    vertex[leaf] = static_cast<std::int32_t>(result.leaf.size());
    result.leaf.push_back(static_cast<std::int32_t>(leaf));
  }
  // Weights must add up within idx_t.
  const std::int64_t total = std::accumulate(work.begin(), work.end(), std::int64_t{0});
  const std::int64_t scale = std::max<std::int64_t>(1, total / 1000000000);
  for (std::int32_t leaf : result.leaf) {
    graph.for_neighbours(leaf, [&](std::int32_t other) {
      if (other != leaf && vertex[static_cast<std::size_t>(other)] >= 0)
        result.neighbour.push_back(vertex[static_cast<std::size_t>(other)]);
    });
    result.offset.push_back(static_cast<idx_t>(result.neighbour.size()));
    result.weight.push_back(static_cast<idx_t>(
        std::max<std::int64_t>(1, work[static_cast<std::size_t>(leaf)] / scale)));
  }
  return result;
}

bool cut_by_metis(const WorkGraph& graph, int ranks, std::int64_t seed, std::vector<idx_t>& part) {
  idx_t vertices = static_cast<idx_t>(graph.leaf.size()), constraints = 1, parts = ranks, cut = 0;
  if (vertices < 4 * parts) return false;
  idx_t options[METIS_NOPTIONS];
  METIS_SetDefaultOptions(options);
  options[METIS_OPTION_SEED] = static_cast<idx_t>(seed);
  options[METIS_OPTION_UFACTOR] = 20;  // allows an imbalance of 1.02
  part.resize(graph.leaf.size());
  auto* offset = const_cast<idx_t*>(graph.offset.data());
  auto* neighbour = const_cast<idx_t*>(graph.neighbour.data());
  auto* weight = const_cast<idx_t*>(graph.weight.data());
  return METIS_PartGraphKway(&vertices, &constraints, offset, neighbour, weight, nullptr, nullptr,
                             &parts, nullptr, nullptr, options, &cut, part.data()) == METIS_OK;
}

#endif

}  // namespace

double imbalance(const std::vector<std::int32_t>& owner, const std::vector<std::int64_t>& work,
                 int ranks) {
  std::vector<std::int64_t> sums(static_cast<std::size_t>(ranks), 0);
  std::int64_t total = 0;
  for (std::size_t leaf = 0; leaf < work.size(); ++leaf) {
    sums[static_cast<std::size_t>(owner[leaf])] += work[leaf];
    total += work[leaf];
  }
  if (total == 0) return 1;
  return static_cast<double>(*std::max_element(sums.begin(), sums.end())) * ranks /
         static_cast<double>(total);
}

std::vector<std::int32_t> partition_leaves(const LeafGraph<2>& graph,
                                           const std::vector<std::int64_t>& work, int ranks,
                                           std::int64_t seed) {
  std::vector<std::int32_t> owner = cut_morton_order(work, ranks);
  if (ranks == 1) return owner;
#if PNPBS_HAVE_MPI
  const WorkGraph vertices = make_graph(graph, work);
  std::vector<idx_t> part;
  if (!cut_by_metis(vertices, ranks, seed, part)) return owner;
  std::vector<std::int32_t> cut = owner;
  for (std::size_t v = 0; v < part.size(); ++v)
    cut[static_cast<std::size_t>(vertices.leaf[v])] = static_cast<std::int32_t>(part[v]);
  // Worse than the plain cut by far: an empty or swollen part.
  if (imbalance(cut, work, ranks) > 1.2 * imbalance(owner, work, ranks)) return owner;
  return cut;
#else
  static_cast<void>(graph);
  static_cast<void>(seed);
  return owner;
#endif
}

}  // namespace pnpbs
