// SPDX-License-Identifier: BSD-3-Clause
// Point location in a distributed triangulation. Each rank stores a patch, and all ranks have boxes
// that cover the patches of the others. A point is sent to the ranks in whose boxes it lies.
#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "comm/communicator.hpp"
#include "spacing/nodal_patch.hpp"
#include "spacing/sphere_patch.hpp"

namespace pnpbs {

// The search in the patches of all ranks. `Searched` is NodalPatch or SpherePatch.
template <class Searched>
class NodalSearch {
 public:
  static constexpr int kIn = Searched::kIn;
  using Answer = PatchAnswer<Searched::kDim>;

  // Stores the patch of this rank and gathers the boxes of all ranks. Collective.
  NodalSearch(std::shared_ptr<const Communicator> comm, Searched patch);

  // Returns one answer for each point: from the simplex that contains it, otherwise from the
  // nearest point of the border. The answers do not depend on the distribution. If all ranks pass
  // the same points, each rank searches its own patch without sending points. Throws Error if no
  // patch has any simplex.
  // Collective. Each rank may pass a different number of points, including none.
  std::vector<Answer> find(std::int64_t n, const Point<kIn>* x) const;

  const Searched& patch() const { return patch_; }  // patch of this rank
  const Communicator& communicator() const { return *comm_; }

 private:
  // Boxes of all ranks with the rank of each.
  struct Directory {
    std::vector<Box<kIn>> boxes;
    std::vector<std::int32_t> ranks;
    BoxTree<kIn> tree;
  };
  using Find = void (Searched::*)(const Point<kIn>& x, Answer& best) const;

  Directory gather_boxes(const std::vector<Box<kIn>>& mine) const;
  std::vector<std::int32_t> ranks_holding(const Point<kIn>& x) const;
  std::vector<std::int32_t> ranks_nearest(const Point<kIn>& x) const;
  template <class Ranks>
  void look(std::int64_t n, const Point<kIn>* x, bool same, const Ranks& ranks_for, Find how,
            std::vector<Answer>& answers) const;
  std::int64_t open_on_all(const std::vector<Answer>& answers) const;

  std::shared_ptr<const Communicator> comm_;
  Searched patch_;
  Directory simplices_, borders_;
};

extern template class NodalSearch<NodalPatch<2>>;
extern template class NodalSearch<NodalPatch<3>>;
extern template class NodalSearch<SpherePatch>;

}  // namespace pnpbs
