// SPDX-License-Identifier: BSD-3-Clause
// What the stars of a finished run in space tell, the same from which results are handed out.
#include <string>

#include "placement/conformity.hpp"

namespace pnpbs {

// Collective.
template <int Dim>
void PlacementOf<Dim>::gather_unknown_uses() {
  unknown_uses_ = static_cast<std::int64_t>(comm_->allreduce_sum(
      static_cast<std::uint64_t>(unknown_uses_before_ + level_->unknown_uses)));
  if (unknown_uses_ > 0)
    warnings_.push_back(
        "the nodes may depend on the number of ranks: " + std::to_string(unknown_uses_) +
        " decisions looked beyond what a rank knows (statistic unknown_uses); on "
        "one rank they do not");
}
template void PlacementOf<2>::gather_unknown_uses();
template void PlacementOf<3>::gather_unknown_uses();

// Collective.
template <>
void PlacementOf<3>::measure_finish() {
  prepare_stars();
  const View<char> held = held_nodes();  // there d is not the user's
  agreed(*comm_,
         [&] { edge_bands_ = measure_edge_bands<3>(*comm_, level_->nodes, level_->stars, held); });
  surface_fit_ = measure_surface_fit(*level_);
}

// In the plane they do, as soon as the boundary is one that encloses something.
template <>
bool PlacementOf<2>::elements_conform() {
  return true;
}
template <>
bool PlacementOf<3>::elements_conform() {
  const Conformity<3> conformity = conformity_of(*this);
  const std::string text = text_of(conformity, *this);
  if (!text.empty()) warnings_.push_back(text);
  unresolved_.clear();
  if (conformity.holds()) return true;
  if (!conformity.any_elements()) return false;  // d means another body
  const auto none = [this] { return comm_->allreduce_sum(unresolved_.size()) == 0; };
  unresolved_ = conformity.torn;
  if (none()) agreed(*comm_, [this] { unresolved_ = bridging_nodes(*level_); });
  if (none()) unresolved_ = surface_fit_.places;
  return false;
}

}  // namespace pnpbs
