// SPDX-License-Identifier: BSD-3-Clause
// A triangulation with values at its nodes as several ranks have it, without the ranks.
#pragma once

#include <vector>

#include "random.hpp"
#include "spacing/nodal_patch.hpp"

// Simplices and facets distributed over several patches, in another order.
template <int Dim>
std::vector<pnpbs::NodalPatch<Dim>> distributed(const pnpbs::Patch<Dim>& whole, std::size_t many,
                                                Random& random) {
  std::vector<pnpbs::Patch<Dim>> parts(many);
  const auto deal = [&](const auto& rows, auto member) {
    auto shuffled = rows;
    random.shuffle(shuffled);
    for (const auto& row : shuffled)
      (parts[static_cast<std::size_t>(random.below(static_cast<std::int64_t>(many)))].*member)
          .push_back(row);
  };
  deal(whole.simplices, &pnpbs::Patch<Dim>::simplices);
  deal(whole.border, &pnpbs::Patch<Dim>::border);
  std::vector<pnpbs::NodalPatch<Dim>> patches;
  for (pnpbs::Patch<Dim>& part : parts) {
    part.nodes = whole.nodes;
    patches.emplace_back(part);
  }
  return patches;
}

template <int Dim>
pnpbs::PatchAnswer<Dim> ask(const std::vector<pnpbs::NodalPatch<Dim>>& patches,
                            const pnpbs::Point<Dim>& x) {
  pnpbs::PatchAnswer<Dim> best;
  for (const pnpbs::NodalPatch<Dim>& patch : patches) {
    pnpbs::PatchAnswer<Dim> answer;
    patch.interpolate(x, answer);
    if (answer < best) best = answer;
  }
  if (best.found()) return best;
  for (const pnpbs::NodalPatch<Dim>& patch : patches) {
    pnpbs::PatchAnswer<Dim> answer;
    patch.extend(x, answer);
    if (answer < best) best = answer;
  }
  return best;
}
