// SPDX-License-Identifier: BSD-3-Clause
// A placement in the plane or in space: its domain, its spacing and the level that owns its nodes.
// It decides when levels are built, advanced and finished; the components implement these steps.
#pragma once

#include <cstdint>
#include <memory>
#include <utility>
#include <vector>

#include "check/boundary_distance.hpp"
#include "check/element_measure.hpp"
#include "checkpoint/saving.hpp"
#include "level/level.hpp"
#include "level/undersampled_points.hpp"
#include "placement/placement.hpp"
#include "placement/placement_state.hpp"
#include "results/results.hpp"
#include "run/finished_round.hpp"
#include "run/level_builder.hpp"
#include "run/measuring_finish.hpp"
#include "run/simulation.hpp"
#include "sizing/limiting_growth.hpp"
#include "sizing/placed_spacing.hpp"
#include "spacing/nodal_patch.hpp"

namespace pnpbs {

template <int Dim>
class PlacementImpl : public Placement {
 public:
  PlacementImpl(std::shared_ptr<const Communicator> comm, std::shared_ptr<Domain<Dim>> domain,
                Options options)
      : Placement(std::move(comm), std::move(options)),
        domain_(std::move(domain)),
        results_(comm_, domain_) {}

  int dimension() const override { return Dim; }
  Domain<Dim>& domain() { return *domain_; }
  void set_spacing(std::shared_ptr<const Spacing<Dim>> spacing) {
    now_.spacing = field_from(std::move(spacing));
    now_.spacing_replaced = true;
    now_.placed.held = {};
  }
  // Adds points at which the spacing is sampled. All ranks must call it, and if one rank throws,
  // all ranks throw and nothing changes.
  void add_spacing_hints(const std::vector<Point<Dim>>& points);
  void set_nodes(IncomingNodes<Dim> nodes) {
    given_ = std::move(nodes);
    start_from_given_ = true;
    keep(nullptr);
  }
  void release_nodes() override { keep(nullptr); }

  Outcome initialise() override;
  Outcome step(std::int64_t n) override;
  Outcome run() override;
  Outcome adjust_population(PopulationCounts& change) override;
  Outcome rebalance() override;
  Estimate estimate() override;

  Results<Dim>& results() override { return results_; }
  const Results<Dim>& results() const override { return results_; }
  const Level<Dim>& level() const { return results_.level(); }
  std::int64_t unresolved_places() const override { return std::ssize(now_.placed.held.places); }
  std::int64_t unresolved_nodes() const override { return now_.placed.held.expected_nodes; }
  double unresolved_spacing() const override { return now_.placed.held.least_before; }
  double volume_of_elements() override {
    results_.prepare_stars();
    return pnpbs::volume_of_elements(results_);
  }
  double volume_of_domain() const override {
    if constexpr (Dim == 3)
      if (results_.has_nodes() && results_.kind() == GeometryKind::body)
        return results_.level().geometry.measure();
    return 0;
  }
  BoundaryDistance boundary_distance() override {
    results_.prepare_stars();
    if (boundary_stamp_ == level().stamp()) return boundary_distance_;
    boundary_distance_ = pnpbs::boundary_distance(results_);
    boundary_stamp_ = level().stamp();
    return boundary_distance_;
  }
  RepairDistances repair_distances() const override {
    if constexpr (Dim == 3) return domain_->repair_distances();
    return {};
  }

  // --- checkpoints ---
  // Returns the state to store: the global state and the owned nodes of this rank. A monitor may
  // call it between two steps. Throws Error(ErrorKind::state) if there are no nodes, or if the
  // spacing or an option that they depend on was changed after they were placed. All ranks must
  // call it, and if one rank throws, all ranks throw.
  Saved<Dim> saved();
  // Throws unless the state belongs to this dimension, this domain and these options. Collective.
  void require_same_as(const SavedState& saved);
  // Continues from a stored state. The spacing must be the one it was stored with. `nodes` may be
  // distributed over the ranks in any way; together they must be complete. If it fails, the
  // placement is unchanged. All ranks must call it, and if one rank throws, all ranks throw.
  void restore(const SavedState& saved, std::vector<SavedNode<Dim>> nodes, Patch<Dim> patch);

 private:
  // Returns the spacing, with a callback that runs the monitor during long evaluations.
  SizingField<Dim> field_from(std::shared_ptr<const Spacing<Dim>> spacing) {
    SizingField<Dim> field(std::move(spacing));
    field.set_beat([this] { monitoring_.beat(); });
    return field;
  }

  // Throws Error(ErrorKind::state) if no spacing has been set. Local.
  void require_spacing() const;

  // --- transactions ---
  // Runs `work`. If it throws on any rank, all ranks restore the nodes, the spacing, the schedule
  // and the counts from before, and throw. Repeating the call gives the result that it would have
  // given in the first place. All ranks must call it.
  template <class Work>
  auto transaction(const Work& work);
  void roll_back(PlacementBefore<Dim>& before) noexcept;

  // --- the present level ---
  // Installs `level` as the one whose results are accessible, or clears the results if it is null.
  void keep(std::shared_ptr<Level<Dim>> level) {
    now_.level = std::move(level);
    results_.show(now_.level.get());
  }
  // Releases the present nodes. The copy for a roll-back keeps those from the beginning of the
  // call.
  void release_present_nodes();
  bool shows_its_level() const override {
    return now_.level && results_.shown() == now_.level.get();
  }
  Settings present_settings() const;
  Settings settings_for_new_level();
  EffectiveSpacing<Dim> placement_spacing() const {
    return {comm_, now_.closed, now_.spacing, options_};
  }
  LevelBuilder<Dim> builder();
  StartNodes<Dim> start_nodes() const;
  Outcome prepare_level();
  Outcome make_level();
  Outcome adopt(BuiltLevel<Dim> made, std::shared_ptr<Level<Dim>>* replaced = nullptr);
  std::shared_ptr<Level<Dim>> replace_level(std::shared_ptr<Level<Dim>> next,
                                            PlacedSpacing<Dim> placed);

  // --- steps and finish of the present level ---
  Simulation<Dim> simulation() { return {*now_.level, state_.schedule, state_, monitoring_}; }
  template <class Work>
  auto with_exact_ghosts(const Work& work);
  template <class Work>
  Outcome retry_with_refined_tree(const Work& work);
  template <class Steps>
  Outcome run_steps(const Steps& steps);
  Outcome run_to_end();
  double count_error() const;
  Outcome run_with_corrected_number();
  Outcome steps_and_finish();
  Outcome repeat_with_reduced_spacing(Outcome first);
  Outcome return_to(FinishedRound<Dim> round);
  Outcome reduce_spacing(bool conforms, std::shared_ptr<Level<Dim>>& replaced);
  Outcome begin_held_round(PlacedSpacing<Dim> placed, bool conforms,
                           std::shared_ptr<Level<Dim>>& replaced);
  void require_savable() const;
  void continue_from(const SavedState& saved, std::vector<SavedNode<Dim>> nodes, Patch<Dim> patch);

  std::shared_ptr<Domain<Dim>> domain_;
  PlacementState<Dim> now_;
  PlacementBefore<Dim>* before_ = nullptr;  // set during a transaction
  Results<Dim> results_;
  BoundaryDistance boundary_distance_;  // valid for boundary_stamp_
  LevelStamp boundary_stamp_;
  IncomingNodes<Dim> given_;  // start nodes of the user, used instead of a fill
  bool start_from_given_ = false;
  // Number of repeated rounds in the call in progress: with d reduced, or the number corrected.
  int rounds_of_run_ = 0;
};

extern template class PlacementImpl<2>;
extern template class PlacementImpl<3>;

// Calls work(placement) with the placement cast to its dimension.
template <class Work>
auto visit_dimension(Placement& placement, const Work& work) {
  if (placement.dimension() == 2) return work(static_cast<PlacementImpl<2>&>(placement));
  return work(static_cast<PlacementImpl<3>&>(placement));
}

}  // namespace pnpbs
