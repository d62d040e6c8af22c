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
#include "spacing/sphere_patch.hpp"

namespace pnpbs {

// Searched: NodalPatch or SpherePatch.
template <class Searched>
class NodalSearch {
 public:
  static constexpr int kIn = Searched::kIn;
  using Answer = PatchAnswer<Searched::kDim>;

  // Collective.
  NodalSearch(std::shared_ptr<const Communicator> comm, Searched patch);

  // The answers for some points, the same ones whoever holds what: from the simplex that a point
  // lies in, otherwise from the nearest place of the border. Collective: all ranks ask at the same
  // time, as many points as each wants. Where all ask the same points, each point is looked for by
  // the ranks that may hold it, without a question.
  std::vector<Answer> find(std::int64_t n, const Point<kIn>* x) const;

  const Searched& patch() const { return patch_; }  // of this rank
  const Communicator& communicator() const { return *comm_; }

 private:
  // Boxes of all ranks.
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
