// SPDX-License-Identifier: BSD-3-Clause
// The spacing from values at the nodes of an earlier placement, which live distributed: each rank
// holds the simplices it owned, and all ranks know boxes around what each of them holds. A point is
// asked of the ranks whose boxes it lies in.
#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "comm/communicator.hpp"
#include "spacing/nodal_patch.hpp"
#include "spacing/spacing.hpp"

namespace pnpbs {

template <int Dim>
class NodalSpacing : public Spacing<Dim> {
 public:
  // Collective.
  NodalSpacing(std::shared_ptr<const Communicator> comm, Patch<Dim> patch);

  // Collective: all ranks ask at the same time, as many points as each wants. Where all ask the
  // same points, each point is looked for by the ranks that may hold it, without a question.
  void evaluate(std::int64_t n, const Point<Dim>* x, double* d) const override;

 private:
  // Boxes of all ranks.
  struct Directory {
    std::vector<Box<Dim>> boxes;
    std::vector<std::int32_t> ranks;
    BoxTree<Dim> tree;
  };
  using Find = void (NodalPatch<Dim>::*)(const Point<Dim>& x, PatchAnswer<Dim>& best) const;

  Directory gather_boxes(const std::vector<Box<Dim>>& mine) const;
  std::vector<std::int32_t> ranks_holding(const Point<Dim>& x) const;
  std::vector<std::int32_t> ranks_nearest(const Point<Dim>& x) const;
  template <class Ranks>
  void look(std::int64_t n, const Point<Dim>* x, bool same, const Ranks& ranks_for, Find find,
            std::vector<PatchAnswer<Dim>>& answers) const;
  std::int64_t open_on_all(const std::vector<PatchAnswer<Dim>>& answers) const;

  std::shared_ptr<const Communicator> comm_;
  NodalPatch<Dim> patch_;
  Directory simplices_, borders_;
};

extern template class NodalSpacing<2>;
extern template class NodalSpacing<3>;

}  // namespace pnpbs
