// SPDX-License-Identifier: BSD-3-Clause
// The leaves of the tree on which the growth of a spacing is limited: refined by d, with the
// samples of d in them, and distributed over the ranks in contiguous ranges.
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

// The leaves of this rank in Morton order. The references must outlive this object.
template <int Dim>
class GrowthLeaves {
 public:
  // Constructs one leaf for the whole domain. `places` are sample points in addition to the
  // boundary nodes.
  GrowthLeaves(const Communicator& comm, const LineOfSight<Dim>& ways, const GrowthRule<Dim>& rule,
               const NodeLimit& limit, std::vector<Point<Dim>> places = {});

  // Splits leaves that are too wide for some d, and leaves over which d grows faster than the
  // limit, so that the tips of steep funnels are found. The latter are split to a third of their
  // smallest d. Stores the sources, and redistributes the leaves. `known` are values elsewhere
  // towards which leaves are split even if no sample has them.
  // Collective.
  void refine(const SpacingEvaluator<Dim>& raw, const std::vector<GrowthSource<Dim>>& known);
  // Splits leaves that are too wide for the limited d. Each rank evaluates `limited` in its own
  // leaves only. Returns whether any rank split a leaf.
  // Collective.
  bool fit(const SpacingEvaluator<Dim>& limited);
  // Searches for dips of d between the samples, as densely as nodes would lie, in leaves not yet
  // searched, and splits leaves towards the dips. Returns whether any rank found one.
  // Collective.
  bool find_dips(const SpacingEvaluator<Dim>& raw, const SpacingEvaluator<Dim>& limited);
  // Samples d for sources in the leaves that fit() made, and redistributes the leaves evenly.
  // Collective.
  void look_into_new(const SpacingEvaluator<Dim>& raw);

  const std::vector<GrowthLeaf<Dim>>& own() const { return leaves_; }

 private:
  // Sample points and their d, grouped by leaf.
  struct Samples {
    std::vector<std::size_t> leaves;
    std::vector<std::size_t> first{0};  // first sample of each leaf, and the end
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
  void sample_adjacent_cells(const SpacingEvaluator<Dim>& raw);
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
  std::vector<GrowthLeaf<Dim>> leaves_;  // leaves of this rank, in Morton order
};

extern template class GrowthLeaves<2>;
extern template class GrowthLeaves<3>;

}  // namespace pnpbs
