// SPDX-License-Identifier: BSD-3-Clause
// Measures the cost of the parts of partitioning that are not distributed, in processor time: the
// table of cells, which every rank builds, and the cut of their graph, which the first rank
// computes. The cells are those of a square with constant d, 250 to 1000 per rank, or of a cube, up
// to 2000.
// usage: partition_cost [space] RANKS...  prints a line of names and values for each
#include <sys/resource.h>

#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <ctime>
#include <vector>

#include "base/kokkos_runtime.hpp"
#include "partition/partition.hpp"
#include "partition/partition_cells.hpp"

namespace {

using pnpbs::PartitionCell;

constexpr std::int64_t kCellsPerRank = 250;  // as in partition/partition_cells.cpp

double seconds_on_a_core() { return static_cast<double>(std::clock()) / CLOCKS_PER_SEC; }

double peak_mib() {
  rusage usage;
  getrusage(RUSAGE_SELF, &usage);
  return static_cast<double>(usage.ru_maxrss) / 1024;
}

template <int Dim>
std::vector<PartitionCell<Dim>> even_cells(std::int64_t ranks) {
  std::int32_t depth = 0;
  while ((std::int64_t{1} << (Dim * depth)) < kCellsPerRank * ranks) ++depth;
  const std::uint32_t side = 1u << depth;
  std::vector<PartitionCell<Dim>> cells;
  for (std::uint32_t i = 0; i < side; ++i)
    for (std::uint32_t j = 0; j < side; ++j)
      if constexpr (Dim == 2)
        cells.push_back({{i, j}, depth, 1000, 0.001});
      else
        for (std::uint32_t k = 0; k < side; ++k) cells.push_back({{i, j, k}, depth, 1000, 0.001});
  return cells;
}

template <int Dim>
void measure(int ranks) {
  const std::vector<PartitionCell<Dim>> list = even_cells<Dim>(ranks);
  const double start = seconds_on_a_core();
  pnpbs::Box<Dim> bounds{};
  for (int axis = 0; axis < Dim; ++axis) bounds.high[axis] = 1;
  const pnpbs::PartitionCells<Dim> cells(bounds, list);
  const double table = seconds_on_a_core(), memory = peak_mib();
  const std::vector<std::int32_t> owner = pnpbs::cut_by_metis(cells, ranks, 1);
  const double cut = seconds_on_a_core();
  std::printf("ranks %d cells %zu table %.3f table_mib %.1f cut %.3f cut_mib %.1f imbalance %.3f\n",
              ranks, list.size(), table - start, memory, cut - table, peak_mib(),
              pnpbs::imbalance(owner, cells.work(), ranks));
}

}  // namespace

int main(int argc, char** argv) {
  pnpbs::start_kokkos(1, 1, [] {});
  const bool space = argc > 1 && std::strcmp(argv[1], "space") == 0;
  for (int a = space ? 2 : 1; a < argc; ++a)
    space ? measure<3>(std::atoi(argv[a])) : measure<2>(std::atoi(argv[a]));
  pnpbs::end_kokkos();
}
