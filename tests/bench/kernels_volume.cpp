// SPDX-License-Identifier: BSD-3-Clause
#include "base/lattice.hpp"
#include "core/bubbles.hpp"
#include "delaunay/volume/volume_stars.hpp"
#include "dynamics/pair_laws.hpp"
#include "kernel_rows.hpp"

namespace {

std::vector<Bubble<3>> moved_lattice(double d, double max) {
  const double cell = d * pnpbs::Lattice<3>::kCell;
  Random random(1);
  std::vector<Bubble<3>> nodes;
  for (int half : {0, 1})
    for (double x = 0.5 * cell * half; x < 1; x += cell)
      for (double y = 0.5 * cell * half; y < 1; y += cell)
        for (double z = 0.5 * cell * half; z < 1; z += cell) {
          Point<3> p{x, y, z};
          for (double& along : p)
            along = std::clamp(along + random.between(-max * d, max * d), 0.0, 1.0);
          nodes.push_back({p, d, std::ssize(nodes), is_inner<3>(unit_box<3>(), p, 2 * d)});
        }
  return nodes;
}

}  // namespace

void measure_in_space(const KernelArguments& arguments, double list_radius) {
  const double d = std::cbrt(2 / arguments.nodes) / pnpbs::Lattice<3>::kCell;
  Bubbles<3> bubbles;
  bubbles.grow_tree([d](const Point<3>&) { return d; });
  bubbles.set(moved_lattice(d, arguments.moved));
  const pnpbs::Nodes<3>& nodes = bubbles.nodes;
  const double count = static_cast<double>(nodes.count);
  const pnpbs::DefaultLaw<3> law;
  const pnpbs::Motion motion = kMotionInSpace;
  const pnpbs::KnownRegion<3> everywhere;
  pnpbs::Field<3> there;
  pnpbs::VolumeStars stars;
  Rows times;
  for (int r = 0; r < arguments.repeat; ++r) {
    times.measure("lists", [&] { bubbles.list(list_radius); });
    pnpbs::reserve_field<3>(there, "pnpbs::bench::there", nodes.count + pnpbs::kLanes);
    times.measure("force", [&] { evaluate_forces<3>(nodes, bubbles.lists, law, there); });
    times.measure("damped step",
                  [&] { pnpbs::damped_step<3>(bubbles.nodes, bubbles.lists, law, motion, there); });
    times.measure("stars", [&] {
      stars.build({nodes, bubbles.tree, bubbles.buckets, bubbles.lists, everywhere});
    });
  }
  const double listed = listed_per_node(nodes, bubbles.lists);
  std::printf(
      "in space, list radius %.1f: %.0f nodes, %.2f listed neighbours per node, %.2f to fill "
      "blocks\n",
      list_radius, count, listed, rows_per_block(bubbles.lists));
  times.print_medians(count);
  std::printf("  %-32s %7.2f ns per listed pair\n  %-32s %7.2f microseconds per node\n", "force",
              1e9 * times.median("force") / (count * listed), "stars",
              1e6 * times.median("stars") / count);
}
