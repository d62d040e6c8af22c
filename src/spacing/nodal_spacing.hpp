// SPDX-License-Identifier: BSD-3-Clause
// The spacing from values at the nodes of an earlier placement, which live distributed: each rank
// holds the triangles it owned, and all ranks know boxes around what each of them holds. A point is
// asked of the ranks whose boxes it lies in.
#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "comm/communicator.hpp"
#include "spacing/nodal_patch.hpp"
#include "spacing/spacing.hpp"

namespace pnpbs {

class NodalSpacing : public Spacing<2> {
 public:
  // Collective.
  NodalSpacing(std::shared_ptr<const Communicator> comm, Patch patch);

  // Collective: all ranks ask at the same time, as many points as each wants. Where all ask the
  // same points, each point is looked for by the ranks that may hold it, without a question.
  void evaluate(std::int64_t n, const Point<2>* x, double* d) const override;

 private:
  // Boxes of all ranks.
  struct Directory {
    std::vector<Box<2>> boxes;
    std::vector<std::int32_t> ranks;
    BoxTree<2> tree;
  };
  using Find = void (NodalPatch::*)(const Point<2>& x, PatchAnswer& best) const;

  Directory gather_boxes(const std::vector<Box<2>>& mine) const;
  std::vector<std::int32_t> ranks_holding(const Point<2>& x) const;
  std::vector<std::int32_t> ranks_nearest(const Point<2>& x) const;
  template <class Ranks>
  void look(std::int64_t n, const Point<2>* x, bool same, const Ranks& ranks_for, Find find,
            std::vector<PatchAnswer>& answers) const;
  std::int64_t open_on_all(const std::vector<PatchAnswer>& answers) const;
  bool same_points(std::int64_t n, const Point<2>* x) const;

  std::shared_ptr<const Communicator> comm_;
  NodalPatch patch_;
  Directory triangles_, rims_;
};

}  // namespace pnpbs
