// SPDX-License-Identifier: BSD-3-Clause
// What limits d in each leaf of a tree that is spread over ranks. Leaves begin with the samples of
// d in them and hand on to those they touch: in the open the sample that limits them, so that the
// limit grows with the straight distance from there, around corners the place that stands for them.
#pragma once

#include <cstdint>
#include <functional>
#include <vector>

#include "spacing/growth_leaf.hpp"
#include "spacing/growth_source.hpp"
#include "spacing/line_of_sight.hpp"
#include "tree/tree_part.hpp"

namespace pnpbs {

template <int Dim>
class GrowthLabels {
 public:
  using Beat = std::function<void()>;

  GrowthLabels() = default;
  // Collective.
  GrowthLabels(const Communicator& comm, const LineOfSight<Dim>& ways,
               const std::vector<GrowthLeaf<Dim>>& own, const GrowthRule<Dim>& rule,
               const Beat& beat);

  const TreePart<Dim>& tree() const { return tree_; }
  // The limit of d at a point in one of this rank's leaves: by the source of that leaf, and by
  // those of touching ones where no boundary is between.
  double limit_at(const LineOfSight<Dim>& ways, const Point<Dim>& x) const;

 private:
  using Label = GrowthLabel<Dim>;
  // What a leaf is to those that touch it.
  struct Spot {
    Point<Dim> place;
    bool placed, inside, crossed;
  };
  struct Waiting;

  void settle(const Communicator& comm, const LineOfSight<Dim>& ways, const Beat& beat);
  void hand_on(const LineOfSight<Dim>& ways, const std::vector<std::int32_t>& leaves,
               std::vector<std::int32_t>& changed, const Beat& beat);
  bool open_way(const LineOfSight<Dim>& ways, const Point<Dim>& from, const Spot& to) const;
  const Spot& spot(std::int64_t leaf) const { return spots_[static_cast<std::size_t>(leaf)]; }
  const Label& label(std::int64_t leaf) const { return labels_[static_cast<std::size_t>(leaf)]; }

  GrowthRule<Dim> rule_;
  TreePart<Dim> tree_;
  std::vector<Spot> spots_;  // of own leaves and copies, as the labels
  std::vector<Label> labels_;
};

extern template class GrowthLabels<2>;
extern template class GrowthLabels<3>;

}  // namespace pnpbs
