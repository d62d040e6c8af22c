// SPDX-License-Identifier: BSD-3-Clause
// Common part of pnpbs-bench-kernels in the plane and in space.
#pragma once

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <map>
#include <string>
#include <vector>

#include "dynamics/schemes.hpp"
#include "neighbors/adjacency_list.hpp"

struct KernelArguments {
  double nodes = 1e5, moved = 0.1;
  int repeat = 15;
};

// The seconds of each kernel, once per repetition, in the order of their first measurement.
class Rows {
 public:
  void add(const std::string& name, double seconds) {
    if (seconds_.count(name) == 0) names_.push_back(name);
    seconds_[name].push_back(seconds);
  }
  template <class Kernel>
  void measure(const std::string& name, const Kernel& kernel) {
    const auto start = std::chrono::steady_clock::now();
    kernel();
    const std::chrono::duration<double> passed = std::chrono::steady_clock::now() - start;
    add(name, passed.count());
  }
  void print_medians(double nodes) {
    for (const std::string& name : names_)
      std::printf("  %-32s %7.2f ns per node\n", name.c_str(), 1e9 * median(name) / nodes);
  }
  double median(const std::string& name) {
    std::vector<double>& seconds = seconds_[name];
    std::sort(seconds.begin(), seconds.end());
    return seconds[seconds.size() / 2];
  }

 private:
  std::vector<std::string> names_;
  std::map<std::string, std::vector<double>> seconds_;
};

// Evaluates the forces. Each pair is in the lists of both its nodes and is evaluated twice.
template <int Dim, class Law>
void evaluate_forces(const pnpbs::Nodes<Dim>& nodes, const pnpbs::AdjacencyList<Dim>& lists,
                     const Law& law, pnpbs::Field<Dim>& forces) {
  const pnpbs::Positions<Dim> x = pnpbs::positions_of<Dim>(nodes.x);
  const double* const d = nodes.d.data();
  pnpbs::for_each(
      "pnpbs::bench::forces", lists.block_count(), [=, &nodes, &lists, &forces](std::int64_t b) {
        std::int64_t self[pnpbs::kLanes];
        pnpbs::block_nodes(b, nodes.count, self);
        pnpbs::BlockVector<Dim> force;
        pnpbs::block_force<Dim>(lists.block(b), law, x, d, self, force);
        for (int k = 0; k < Dim; ++k)
          std::copy(force[k].begin(), force[k].end(), forces[k].data() + b * pnpbs::kLanes);
      });
}

template <int Dim>
double listed_per_node(const pnpbs::Nodes<Dim>& nodes, const pnpbs::AdjacencyList<Dim>& lists) {
  std::int64_t listed = 0;
  for (std::int64_t i = 0; i < nodes.count; ++i)
    lists.for_neighbours(i, [&](std::int64_t) { ++listed; });
  return static_cast<double>(listed) / static_cast<double>(nodes.count);
}

// Returns the mean number of rows that kernels process per block: the length of its longest list.
template <int Dim>
double rows_per_block(const pnpbs::AdjacencyList<Dim>& lists) {
  std::int64_t rows = 0;
  for (std::int64_t b = 0; b < lists.block_count(); ++b) rows += lists.block(b).length;
  return static_cast<double>(rows) / static_cast<double>(lists.block_count());
}

// Measures kernels on a body-centred cubic lattice in the unit cube.
void measure_in_space(const KernelArguments& arguments, double list_radius);
