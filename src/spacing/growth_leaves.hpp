// SPDX-License-Identifier: BSD-3-Clause
// The leaves on which a spacing with limited growth is found: refined by d, with the samples of d
// in them, each rank with a stretch of them.
#pragma once

#include <cstdint>
#include <functional>
#include <vector>

#include "comm/communicator.hpp"
#include "domain/node_limit.hpp"
#include "domain/spacing_evaluator.hpp"
#include "spacing/growth_leaf.hpp"
#include "spacing/growth_source.hpp"
#include "spacing/growth_sources.hpp"
#include "spacing/leaf_points.hpp"
#include "spacing/line_of_sight.hpp"

namespace pnpbs {

template <int Dim>
class GrowthLeaves {
 public:
  // All of the domain in one leaf. `places` in it are samples like the boundary nodes.
  GrowthLeaves(const Communicator& comm, const LineOfSight<Dim>& ways, const GrowthRule<Dim>& rule,
               const NodeLimit& limit, std::vector<Point<Dim>> places = {});

  // Splits leaves wider than some d, and those over which d grows faster than the limit, so that
  // the tips of steep funnels are found: down to a third of their least d. Keeps sources of d.
  // Leaves change their ranks. Collective, as all that follows.
  // `known`: values elsewhere, so that leaves are split towards them though no sample meets them.
  void refine(const SpacingEvaluator<Dim>& raw, const std::vector<GrowthSource<Dim>>& known);
  // Splits leaves wider than some of the limited d, which is asked in this rank's leaves alone.
  // Was there any on any rank?
  bool fit(const SpacingEvaluator<Dim>& limited);
  // Looks for dips of d between the samples, as densely as nodes would lie, in leaves where that
  // was not done, and splits these towards what it finds. Was there any on any rank?
  bool find_dips(const SpacingEvaluator<Dim>& raw, const SpacingEvaluator<Dim>& limited);
  // Looks for sources where fit() has split, and spreads the leaves evenly again.
  void look_into_new(const SpacingEvaluator<Dim>& raw);

  const std::vector<GrowthLeaf<Dim>>& own() const { return leaves_; }

 private:
  struct Samples {
    std::vector<std::size_t> leaves;
    std::vector<std::size_t> first{0};  // of each leaf, and the end
    std::vector<Point<Dim>> x;
    std::vector<double> d;
  };

  template <class Wanted, class Add>
  Samples samples_in(const Wanted& wanted, const Add& add) const;
  template <class Wanted>
  Samples samples_in(const Wanted& wanted) const;
  void take_places(const std::vector<Point<Dim>>& places);
  void look_at_domain(GrowthLeaf<Dim>& leaf) const;
  void take_range(const Samples& samples);
  Samples samples_in_slivers() const;
  void move_into_cells(Samples& samples) const;
  void look_beside(const SpacingEvaluator<Dim>& raw);
  void expect_known(const Samples& samples, const GrowthSources<Dim>& known);
  void take_sources(const Samples& samples);
  bool any_open() const;
  bool too_wide(const GrowthLeaf<Dim>& leaf, double steepest) const;
  bool split_open(double steepest);
  void split(const GrowthLeaf<Dim>& leaf, std::vector<GrowthLeaf<Dim>>& next) const;
  void require_small_node_set() const;
  [[noreturn]] void report_too_many(double nodes) const;

  const Communicator& comm_;
  const LineOfSight<Dim>& ways_;
  GrowthRule<Dim> rule_;
  NodeLimit limit_;
  LeafPoints<Dim> points_;
  std::vector<GrowthLeaf<Dim>> leaves_;  // in Morton order
};

extern template class GrowthLeaves<2>;
extern template class GrowthLeaves<3>;

}  // namespace pnpbs
