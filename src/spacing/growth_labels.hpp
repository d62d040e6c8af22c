// SPDX-License-Identifier: BSD-3-Clause
// The source that limits d in each leaf of a distributed tree. Leaves start with the samples of d
// in them and pass their source on to the leaves that they touch. Where no boundary crosses the
// segment from the source, the limit grows with the straight distance from it. Around corners of
// the boundary, the path continues from the representative point of the leaf.
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
// The leaves of this rank with their limits, and copies of adjacent leaves of other ranks.
class GrowthLabels {
 public:
  using Beat = std::function<void()>;

  GrowthLabels() = default;
  // Computes the limits from the leaves `own` of this rank. Calls beat() repeatedly. Collective.
  GrowthLabels(const Communicator& comm, const LineOfSight<Dim>& ways,
               const std::vector<GrowthLeaf<Dim>>& own, const GrowthRule<Dim>& rule,
               const Beat& beat);

  const TreePart<Dim>& tree() const { return tree_; }
  // Returns the limit of d at a point in a leaf of this rank, and infinity elsewhere. It is the
  // smallest limit by the source of that leaf and by those of touching leaves that no boundary
  // separates.
  double limit_at(const LineOfSight<Dim>& ways, const Point<Dim>& x) const;

 private:
  using Label = GrowthLabel<Dim>;
  // The representative point of a leaf. `placed`: there is one; `inside`: it lies inside the
  // domain; `crossed`: the boundary crosses the leaf.
  struct LeafPoint {
    Point<Dim> place;
    bool placed, inside, crossed;
  };
  struct LabelQueue;

  void settle(const Communicator& comm, const LineOfSight<Dim>& ways, const Beat& beat);
  void hand_on(const LineOfSight<Dim>& ways, const std::vector<std::int32_t>& leaves,
               std::vector<std::int32_t>& changed, const Beat& beat);
  bool open_way(const LineOfSight<Dim>& ways, const Point<Dim>& from, const LeafPoint& to) const;
  const LeafPoint& spot(std::int64_t leaf) const { return spots_[static_cast<std::size_t>(leaf)]; }
  const Label& label(std::int64_t leaf) const { return labels_[static_cast<std::size_t>(leaf)]; }

  GrowthRule<Dim> rule_;
  TreePart<Dim> tree_;
  std::vector<LeafPoint> spots_;  // for own leaves, then copies, like labels_
  std::vector<Label> labels_;
};

extern template class GrowthLabels<2>;
extern template class GrowthLabels<3>;

}  // namespace pnpbs
