// SPDX-License-Identifier: BSD-3-Clause
// What the partition costs that is done once for all ranks, on a core of its own: the table of
// cells that every rank makes, and the cut of their graph, which the first rank makes. The cells
// are those of a square with even d, 250 to 1000 for each rank. usage: partition_cost RANKS... A
// line of names and values for each.
#include <sys/resource.h>

#include <cstdint>
#include <cstdio>
#include <cstdlib>
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

std::vector<PartitionCell<2>> even_cells(std::int64_t ranks) {
  std::int32_t depth = 0;
  while ((std::int64_t{1} << (2 * depth)) < kCellsPerRank * ranks) ++depth;
  std::vector<PartitionCell<2>> cells;
  for (std::uint32_t i = 0; i < 1u << depth; ++i)
    for (std::uint32_t j = 0; j < 1u << depth; ++j) cells.push_back({{i, j}, depth, 1000, 0.001});
  return cells;
}

void measure(int ranks) {
  const std::vector<PartitionCell<2>> list = even_cells(ranks);
  const double start = seconds_on_a_core();
  const pnpbs::PartitionCells<2> cells({{0, 0}, {1, 1}}, list);
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
  for (int a = 1; a < argc; ++a) measure(std::atoi(argv[a]));
  pnpbs::end_kokkos();
}
