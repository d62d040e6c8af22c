// SPDX-License-Identifier: BSD-3-Clause
// The spacing from values at the nodes of an earlier placement, which live distributed.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <utility>

#include "spacing/nodal_search.hpp"
#include "spacing/spacing.hpp"
#include "sphere/stereographic_chart.hpp"

namespace pnpbs {

template <int Dim>
class NodalSpacing : public Spacing<Dim> {
 public:
  // In the chart of a sphere, values are those along the sphere. Collective.
  NodalSpacing(std::shared_ptr<const Communicator> comm, Patch<Dim> patch,
               const StereographicChart* chart = nullptr)
      : search_(std::move(comm), NodalPatch<Dim>(std::move(patch))) {
    if (chart) chart_ = *chart;
  }

  // Collective: all ranks ask at the same time.
  void evaluate(std::int64_t n, const Point<Dim>* x, double* d) const override {
    const std::vector<PatchAnswer<Dim>> answers = search_.find(n, x);
    for (std::size_t i = 0; i < answers.size(); ++i) {
      d[i] = answers[i].value;
      if constexpr (Dim == 2)
        if (chart_) d[i] *= chart_->stretch(x[i]);
    }
  }

  const Patch<Dim>& patch() const { return search_.patch().patch(); }  // of this rank

 private:
  NodalSearch<NodalPatch<Dim>> search_;
  std::optional<StereographicChart> chart_;
};

}  // namespace pnpbs
