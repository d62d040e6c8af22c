// SPDX-License-Identifier: BSD-3-Clause
// The spacing from values at the nodes of an earlier placement, which are distributed over the
// ranks.
#pragma once

#include <cstdint>
#include <memory>
#include <utility>

#include "spacing/nodal_search.hpp"
#include "spacing/spacing.hpp"
#include "sphere/embedding.hpp"

namespace pnpbs {

// A spacing that is interpolated in the distributed triangulation of an earlier placement.
template <int Dim>
class NodalSpacing : public Spacing<Dim> {
 public:
  // The values of `patch` are lengths as users measure them. Collective.
  NodalSpacing(std::shared_ptr<const Communicator> comm, Patch<Dim> patch,
               const Embedding<Dim>& embedding = {})
      : search_(std::move(comm), NodalPatch<Dim>(std::move(patch))), embedding_(embedding) {}

  // Collective. Each rank may pass a different number of points, including none.
  void evaluate(std::int64_t n, const Point<Dim>* x, double* d) const override {
    const std::vector<PatchAnswer<Dim>> answers = search_.find(n, x);
    for (std::size_t i = 0; i < answers.size(); ++i)
      d[i] = embedding_.coordinate_length(x[i], answers[i].value);
  }

  const Patch<Dim>& patch() const { return search_.patch().patch(); }  // patch of this rank

 private:
  NodalSearch<NodalPatch<Dim>> search_;
  Embedding<Dim> embedding_;
};

}  // namespace pnpbs
