// SPDX-License-Identifier: BSD-3-Clause
// What the stars of a finished run in space tell, the same from which results are handed out.
#include <string>

#include "placement/conformity.hpp"
#include "placement/placement_of.hpp"

namespace pnpbs {

// Collective.
template <int Dim>
void PlacementOf<Dim>::gather_unknown_uses() {
  state_.unknown_uses = static_cast<std::int64_t>(comm_->allreduce_sum(
      static_cast<std::uint64_t>(state_.unknown_uses_before + level_->unknown_uses)));
  if (state_.unknown_uses > 0)
    state_.warnings.push_back(
        "the nodes may depend on the number of ranks: " + std::to_string(state_.unknown_uses) +
        " decisions looked beyond what a rank knows (statistic unknown_uses); on "
        "one rank they do not");
}
template void PlacementOf<2>::gather_unknown_uses();
template void PlacementOf<3>::gather_unknown_uses();

// Collective.
template <>
void PlacementOf<3>::measure_finish() {
  results_.prepare_stars();
  const View<char> held = held_nodes();  // there d is not the user's
  agreed(*comm_, [&] {
    state_.edge_bands = measure_edge_bands<3>(*comm_, level_->nodes, level_->stars, held);
  });
  state_.surface_fit = measure_surface_fit(*level_);
}

// In the plane they do, as soon as the boundary is one that encloses something.
template <>
bool PlacementOf<2>::elements_conform() {
  return true;
}
template <>
bool PlacementOf<3>::elements_conform() {
  const Conformity<3> conformity = conformity_of(results_);
  const std::string text = text_of(conformity, results_);
  if (!text.empty()) state_.warnings.push_back(text);
  unresolved_.clear();
  if (conformity.holds()) return true;
  if (!conformity.any_elements()) return false;  // d means another body
  const auto none = [this] { return comm_->allreduce_sum(unresolved_.size()) == 0; };
  unresolved_ = conformity.torn;
  if (none()) agreed(*comm_, [this] { unresolved_ = bridging_nodes(*level_); });
  if (none()) unresolved_ = state_.surface_fit.places;
  return false;
}

}  // namespace pnpbs
