// SPDX-License-Identifier: BSD-3-Clause
// pnpbs-bench-kernels: measures the kernels separately, on a hexagonal lattice in the unit square
// with small random displacements. Lists have the default radius and a larger one, which reaches a
// part of the second shell. Then the same in space. Usage:
//   pnpbs-bench-kernels [--nodes N] [--repeat R] [--moved M]
// M: largest displacement of a coordinate, in spacings. Results are medians of the repetitions.
// OMP_NUM_THREADS sets the number of threads.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <string>
#include <vector>

#include "base/kokkos_runtime.hpp"
#include "core/level_run.hpp"
#include "core/random.hpp"
#include "kernel_rows.hpp"

namespace {

using pnpbs::CubicLaw;
using pnpbs::Field;
using pnpbs::kLanes;
using Level = pnpbs::Level<2>;
using pnpbs::LinearPush;
using pnpbs::Nodes;
using pnpbs::Phase;

KernelArguments read(int argc, char** argv) {
  KernelArguments arguments;
  for (int a = 1; a < argc; a += 2) {
    const std::string name = argv[a];
    const double value = a + 1 < argc ? std::atof(argv[a + 1]) : 0;
    if (name == "--nodes" && value >= 100) {
      arguments.nodes = value;
    } else if (name == "--repeat" && value >= 1) {
      arguments.repeat = static_cast<int>(value);
    } else if (name == "--moved" && value >= 0) {
      arguments.moved = value;
    } else {
      std::fprintf(stderr, "usage: %s [--nodes N] [--repeat R] [--moved M]\n", argv[0]);
      std::exit(2);
    }
  }
  return arguments;
}

void fill_square(pnpbs::PlaneDomain& domain) {
  shapes::add_loop(domain, shapes::rectangle(0, 0, 1, 1));
}

pnpbs::IncomingNodes<2> moved_lattice(double d, double max) {
  LevelRun lattice(fill_square, constant(d));
  fill_level(*lattice.level);
  pnpbs::IncomingNodes<2> nodes = inner_nodes_of(*lattice.level);
  Random random(1);
  for (pnpbs::IncomingNode<2>& node : nodes)
    for (double& x : node.position) x += random.between(-max * d, max * d);
  return nodes;
}

struct Scratch {
  Field<2> there;
  pnpbs::Stages<2> stages;
};

void measure_forces(const Level& level, Scratch& scratch, Rows& rows) {
  const Nodes<2>& nodes = level.nodes;
  const LinearPush push{1, level.settings.rest_length};
  rows.measure("force, push",
               [&] { evaluate_forces<2>(nodes, level.lists(), push, scratch.there); });
  rows.measure("force, cubic",
               [&] { evaluate_forces<2>(nodes, level.lists(), CubicLaw{}, scratch.there); });
}

// Velocities change but positions do not, so all steps start from the same positions.
void measure_steps(Level& level, Scratch& scratch, Rows& rows) {
  Nodes<2>& nodes = level.nodes;
  const pnpbs::AdjacencyList<2>& lists = level.lists();
  const pnpbs::Motion& motion = level.settings.motion;
  const LinearPush push{1, level.settings.rest_length};
  const CubicLaw cubic;
  rows.measure("damped step, push",
               [&] { pnpbs::damped_step<2>(nodes, lists, push, motion, scratch.there); });
  rows.measure("damped step, cubic",
               [&] { pnpbs::damped_step<2>(nodes, lists, cubic, motion, scratch.there); });
  rows.measure("predictor-corrector step, cubic", [&] {
    pnpbs::predictor_corrector_step<2>(nodes, lists, cubic, motion, scratch.stages, scratch.there);
  });
  rows.measure("Runge-Kutta step, cubic", [&] {
    pnpbs::runge_kutta_step<2>(nodes, lists, cubic, motion, scratch.stages, scratch.there);
  });
}

// Measures the time of a phase of the level, divided by the number of times it runs.
template <class Work>
void measure_phase(const std::string& name, const pnpbs::Timers& timers, Phase phase, int times,
                   Rows& rows, const Work& work) {
  const double before = timers.seconds(phase);
  work();
  rows.add(name, (timers.seconds(phase) - before) / times);
}

void run(const KernelArguments& arguments, const char* list_radius) {
  constexpr int kSweeps = 5;  // a block, within which the stars stay
  const double d = std::sqrt(2 / std::sqrt(3.0) / arguments.nodes);
  const pnpbs::IncomingNodes<2> lattice = moved_lattice(d, arguments.moved);
  LevelRun run(fill_square, constant(d), {{"list_radius", list_radius}, {"smoothing_rounds", "0"}});
  Level& level = *run.level;
  Scratch scratch;
  Rows times;
  double listed = 0, rows = 0;
  for (int r = 0; r < arguments.repeat; ++r) {
    pnpbs::take(level, lattice, 0);
    measure_phase("lists", *run.timers, Phase::lists, 1, times,
                  [&] { pnpbs::rebuild_lists_for_steps(level); });
    listed = listed_per_node<2>(level.nodes, level.lists());
    rows = rows_per_block<2>(level.lists());
    pnpbs::reserve_field<2>(scratch.there, "pnpbs::bench::there", level.nodes.count + kLanes);
    measure_forces(level, scratch, times);
    measure_steps(level, scratch, times);
    measure_phase("stars", *run.timers, Phase::stars, 1, times,
                  [&] { pnpbs::rebuild_stars(level); });
    measure_phase("sweep", *run.timers, Phase::sweeps, kSweeps, times,
                  [&] { pnpbs::sweep_and_repair(level, kSweeps); });
  }
  const double nodes = static_cast<double>(level.nodes.count);
  std::printf("list radius %s: %.0f nodes, %.2f listed neighbours per node, %.2f to fill blocks\n",
              list_radius, nodes, listed, rows);
  times.print_medians(nodes);
}

}  // namespace

int main(int argc, char** argv) {
  const KernelArguments arguments = read(argc, argv);
  pnpbs::start_kokkos(0, 1, [] {});
  for (const char* list_radius : {"1.6", "1.7"}) run(arguments, list_radius);
  for (const double list_radius : {1.5, 1.7}) measure_in_space(arguments, list_radius);
  pnpbs::end_kokkos();
  return 0;
}
