// SPDX-License-Identifier: BSD-3-Clause
// Who holds the simplex of a distributed triangulation that a point lies in: each rank holds the
// simplices it owned, and all ranks know boxes around what each of them holds. A point is asked of
// the ranks whose boxes it lies in.
#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "comm/communicator.hpp"
#include "spacing/nodal_patch.hpp"

namespace pnpbs {

template <int Dim>
class NodalSearch {
 public:
  // Collective.
  NodalSearch(std::shared_ptr<const Communicator> comm, Patch<Dim> patch);

  // The answers for some points, the same ones whoever holds what: from the simplex that a point
  // lies in, otherwise from the nearest place of the border. Collective: all ranks ask at the same
  // time, as many points as each wants. Where all ask the same points, each point is looked for by
  // the ranks that may hold it, without a question.
  std::vector<PatchAnswer<Dim>> find(std::int64_t n, const Point<Dim>* x) const;

  const NodalPatch<Dim>& patch() const { return patch_; }  // of this rank
  const Communicator& communicator() const { return *comm_; }

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
  void look(std::int64_t n, const Point<Dim>* x, bool same, const Ranks& ranks_for, Find how,
            std::vector<PatchAnswer<Dim>>& answers) const;
  std::int64_t open_on_all(const std::vector<PatchAnswer<Dim>>& answers) const;

  std::shared_ptr<const Communicator> comm_;
  NodalPatch<Dim> patch_;
  Directory simplices_, borders_;
};

extern template class NodalSearch<2>;
extern template class NodalSearch<3>;

}  // namespace pnpbs
