// SPDX-License-Identifier: BSD-3-Clause
// A triangulation with nodal values in several parts, as ranks store it, on a single rank.
#pragma once

#include <cstddef>
#include <iterator>
#include <vector>

#include "comm/communicator.hpp"
#include "quick_assert.hpp"
#include "random.hpp"
#include "spacing/nodal_patch.hpp"
#include "spacing/nodal_spacing.hpp"

// Distributes simplices and facets over several patches, in random order.
template <int Dim>
std::vector<pnpbs::NodalPatch<Dim>> distributed(const pnpbs::Patch<Dim>& whole, std::size_t many,
                                                Random& random) {
  std::vector<pnpbs::Patch<Dim>> parts(many);
  const auto spread = [&](const auto& rows, auto member) {
    auto shuffled = rows;
    random.shuffle(shuffled);
    for (const auto& row : shuffled)
      (parts[static_cast<std::size_t>(random.below(static_cast<std::int64_t>(many)))].*member)
          .push_back(row);
  };
  spread(whole.simplices, &pnpbs::Patch<Dim>::simplices);
  spread(whole.border, &pnpbs::Patch<Dim>::border);
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

// Expects that one patch, several patches, and a NodalSpacing built from the patch return the same
// bits.
template <int Dim>
void expect_the_same_however_distributed(const pnpbs::Patch<Dim>& patch,
                                         const std::vector<pnpbs::Point<Dim>>& points,
                                         Random& random) {
  const std::vector<pnpbs::NodalPatch<Dim>> whole = distributed<Dim>(patch, 1, random);
  const pnpbs::NodalSpacing<Dim> spacing(pnpbs::serial_communicator(), patch);
  std::vector<double> d(points.size());
  spacing.evaluate(std::ssize(points), points.data(), d.data());
  for (const std::size_t many : {2u, 3u, 7u}) {
    const std::vector<pnpbs::NodalPatch<Dim>> parts = distributed<Dim>(patch, many, random);
    for (std::size_t i = 0; i < points.size(); ++i) {
      const pnpbs::PatchAnswer<Dim> a = ask<Dim>(whole, points[i]), b = ask<Dim>(parts, points[i]);
      quick_assert(a.ids == b.ids && a.gap == b.gap && a.value == b.value && d[i] == a.value);
    }
  }
}
