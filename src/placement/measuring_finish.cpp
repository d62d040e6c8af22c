// SPDX-License-Identifier: BSD-3-Clause
#include "placement/measuring_finish.hpp"

#include <string>

#include "placement/conformity.hpp"
#include "placement/holding_spacing.hpp"

namespace pnpbs {

template <int Dim>
void gather_unknown_uses(const Level<Dim>& level, RunState& run) {
  run.unknown_uses = static_cast<std::int64_t>(level.comm->allreduce_sum(
      static_cast<std::uint64_t>(run.unknown_uses_before + level.unknown_uses)));
  if (run.unknown_uses > 0)
    run.warnings.push_back(
        "the nodes may depend on the number of ranks: " + std::to_string(run.unknown_uses) +
        " decisions looked beyond what a rank knows (statistic unknown_uses); on "
        "one rank they do not");
}

void measure_finish(Results<2>&, const PlacedSpacing<2>&, RunState&) {}

void measure_finish(Results<3>& results, const PlacedSpacing<3>& placed, RunState& run) {
  results.prepare_stars();
  const Level<3>& level = results.level();
  const View<char> held = held_nodes(level, placed);  // there d is not the user's
  agreed(*level.comm, [&] {
    run.edge_bands = measure_edge_bands<3>(*level.comm, level.nodes, level.stars, held);
  });
  run.surface_fit = measure_surface_fit(level);
}

// In the plane they do, as soon as the boundary is one that encloses something.
bool elements_conform(Results<2>&, RunState&, std::vector<Point<2>>&) { return true; }

bool elements_conform(Results<3>& results, RunState& run, std::vector<Point<3>>& unresolved) {
  const Communicator& comm = results.communicator();
  const Conformity<3> conformity = conformity_of(results);
  run.warn(text_of(conformity, results));
  unresolved.clear();
  if (conformity.holds()) return true;
  if (!conformity.any_elements()) return false;  // d means another body
  const auto none = [&] { return comm.allreduce_sum(unresolved.size()) == 0; };
  unresolved = conformity.torn;
  if (none()) agreed(comm, [&] { unresolved = bridging_nodes(results.level()); });
  if (none()) unresolved = run.surface_fit.places;
  return false;
}

template void gather_unknown_uses(const Level<2>&, RunState&);
template void gather_unknown_uses(const Level<3>&, RunState&);

}  // namespace pnpbs
