// SPDX-License-Identifier: BSD-3-Clause
// A placement in the plane or in space: its domain, its spacing and its levels.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "level/finer_places.hpp"
#include "level/laid_nodes.hpp"
#include "level/level.hpp"
#include "level/rebalance.hpp"
#include "level/taken_nodes.hpp"
#include "placement/placement.hpp"
#include "placement/results.hpp"
#include "placement/saved_state.hpp"
#include "placement/simulation.hpp"
#include "spacing/nodal_patch.hpp"
#include "spacing/steepest_growth.hpp"

namespace pnpbs {

// A placement as it is saved: of its nodes, those of this rank.
template <int Dim>
struct Saved {
  SavedState state;
  const Nodes<Dim>* nodes = nullptr;
  std::vector<std::int32_t> owned;    // indices into these
  View<double> spacing;               // by the same
  const Patch<Dim>* patch = nullptr;  // of a spacing by values at nodes there were; else none

  std::int64_t count() const { return static_cast<std::int64_t>(owned.size()); }
  SavedNode<Dim> node(std::int64_t k) const {
    const std::int32_t i = owned[static_cast<std::size_t>(k)];
    return {packed(*nodes, i), spacing(i)};
  }
};

// Where the spacing is held down, since there the elements of an earlier round did not fill the
// domain.
template <int Dim>
struct Held {
  std::vector<GrowthSource<Dim>> places;
  std::int64_t rounds = 0, nodes_before = 0;  // after the round before the first of these
};

// The spacing as it counts: what it would be without the places where it is held down, these, and
// how steep it is where the user sets no limit.
template <int Dim>
struct PlacedSpacing {
  std::shared_ptr<const Spacing<Dim>> d, unheld;
  Held<Dim> held;
  SteepestGrowth<Dim> steepest;
};

template <int Dim>
class PlacementOf : public Placement {
 public:
  PlacementOf(std::shared_ptr<const Communicator> comm, std::shared_ptr<Domain<Dim>> domain,
              Options options)
      : Placement(std::move(comm), std::move(options)),
        domain_(std::move(domain)),
        results_(comm_, domain_) {}

  int dimension() const override { return Dim; }
  Domain<Dim>& domain() { return *domain_; }
  void set_spacing(std::shared_ptr<const Spacing<Dim>> spacing);
  void set_nodes(GivenNodes<Dim> nodes);
  void forget_nodes() override { keep(nullptr); }

  Outcome initialise() override;
  Outcome step(std::int64_t n) override;
  Outcome run() override;
  Outcome adjust_population(PopulationCounts& change) override;
  Outcome rebalance() override;
  Estimate estimate() override;

  Results<Dim>& results() override { return results_; }
  const Results<Dim>& results() const override { return results_; }
  const Level<Dim>& level() const { return results_.level(); }
  std::int64_t unresolved_places() const override { return std::ssize(placed_.held.places); }
  RepairDistances repair_distances() const override {
    if constexpr (Dim == 3) return domain_->repair_distances();
    return {};
  }

  // --- checkpoints ---
  // What is one for all, and the nodes of this rank; between two steps even in a monitor's turn.
  // Throws Error(ErrorKind::state) where the nodes wait for something that they were not yet placed
  // for. Collective.
  Saved<Dim> saved();
  // Throws unless it is of this dimension, domain and these options. Collective.
  void require_same_as(const SavedState& saved);
  // Goes on from there, if the spacing is that of then, too. `nodes`: anyone's, all of them over
  // all ranks. If it fails, all stays as it was. Collective.
  void restore(const SavedState& saved, std::vector<SavedNode<Dim>> nodes, Patch<Dim> patch);

 private:
  // The level there is from now on, whose results are handed out; none if it is null.
  void keep(std::unique_ptr<Level<Dim>> level) {
    level_ = std::move(level);
    results_.show(level_.get());
  }
  Outcome prepare_level();
  Outcome make_level();
  std::unique_ptr<Level<Dim>> level_to_place(const Settings& settings, PlacedSpacing<Dim>& placed);
  Outcome begin_on(std::unique_ptr<Level<Dim>> next, PlacedSpacing<Dim> placed,
                   const Settings& settings);
  void require_savable() const;
  void adopt_state(const SavedState& saved);
  Settings present_settings() const;
  Settings settings_for_new_level() const;
  std::shared_ptr<const Spacing<Dim>> spacing_to_place(const Settings& settings) const;
  std::shared_ptr<const Spacing<Dim>> growth_limited(std::shared_ptr<const Spacing<Dim>> spacing,
                                                     const Settings& settings);
  std::shared_ptr<const Spacing<Dim>> growth_limited(std::shared_ptr<const Spacing<Dim>> spacing,
                                                     const Settings& settings,
                                                     const std::function<void()>& beat) const;
  void hold_down(PlacedSpacing<Dim>& placed, const Settings& settings) const;
  View<char> held_nodes() const;
  bool add_unresolved_places(Held<Dim>& held) const;
  Outcome hold_spacing();
  Outcome begin_held_round(PlacedSpacing<Dim> placed);
  void warn_of_held_spacing();
  void warn_of_features_left_out();  // in space
  void warn_of_coarse_spacing();     // in space
  void warn_of_partial_extent();
  static bool too_steep(const SteepestGrowth<Dim>& steepest);
  static std::string warning_of_growth(const SteepestGrowth<Dim>& steepest, double growth_limit);
  std::shared_ptr<const Spacing<Dim>> bounded(std::shared_ptr<const Spacing<Dim>> spacing,
                                              const Settings& settings) const;
  // Of a body with even d, unless so many nodes are wanted: whole layers come in steps.
  bool lattice_is_stretched() const { return options_.real("wanted_nodes") == 0; }
  double factor_for(double wanted_nodes, const Settings& settings) const;
  double estimated_nodes(std::shared_ptr<const Spacing<Dim>> spacing,
                         const Settings& settings) const;
  std::unique_ptr<Level<Dim>> empty_level(std::shared_ptr<const Spacing<Dim>> spacing,
                                          const Settings& settings,
                                          const Level<Dim>* like = nullptr);
  bool shows_its_level() const override { return level_ && results_.shown() == level_.get(); }
  void gather_warnings(const SteepestGrowth<Dim>& steepest);
  int coarser_levels_that_pay(const Level<Dim>& finest,
                              const std::shared_ptr<const Spacing<Dim>>& spacing) const;
  bool boundary_leaves_room(const Level<Dim>& finest, const Spacing<Dim>& coarser, double factor,
                            double nodes) const;
  TakenNodes put_first_nodes(Level<Dim>& level, GivenNodes<Dim>& from_coarser, int which,
                             Outcome& outcome);
  void settle_surfaces(Level<Dim>& level, GivenNodes<Dim>& nodes, Outcome& outcome,
                       LevelRole role = LevelRole::surfaces);  // in space
  void rest_on_surfaces(Level<Dim>& level, GivenNodes<Dim> on_surfaces,
                        const GivenNodes<Dim>& on_features, Outcome& outcome,
                        LevelRole role);                                   // in space
  std::int64_t put_on_surfaces(Level<Dim>& level, GivenNodes<Dim> nodes);  // in space
  TakenNodes begin_on_surfaces(Level<Dim>& finest,
                               const std::shared_ptr<const Spacing<Dim>>& spacing,
                               const Settings& settings, Outcome& outcome);  // in space
  int surface_levels_that_pay(const Level<Dim>& finest) const;               // in space
  GivenNodes<Dim> nodes_from_coarser_levels(const Level<Dim>& finest,
                                            const std::shared_ptr<const Spacing<Dim>>& spacing,
                                            const Settings& settings, Outcome& outcome);
  void require_same_domain() const;
  template <class Work>
  auto while_moving(const Work& work);
  template <class Work>
  Outcome knowing_finer_places(const Work& work);
  template <class Steps>
  Outcome taking_steps(const Steps& steps);
  void remember(const FinerPlaces& found);  // in space
  // Shares of a run's work, for its progress: coarser levels, and steps without the finish.
  static constexpr double kCoarseShare = 0.5, kStepsShare = 0.9;
  void fill(Level<Dim>& level, LaidNodes<Dim> laid);
  Simulation<Dim> simulation() { return {*level_, state_.schedule, state_, monitoring_}; }
  Outcome steps_and_finish();
  double done_by_rounds() const;
  ProgressPart part_of_steps() const;
  void gather_unknown_uses();
  void measure_finish();    // in space
  bool elements_conform();  // if not there is a warning; collective

  std::shared_ptr<Domain<Dim>> domain_;
  std::shared_ptr<const Spacing<Dim>> spacing_;
  std::unique_ptr<Level<Dim>> level_;
  Results<Dim> results_;
  GivenNodes<Dim> given_;  // nodes to start from instead of a fill
  bool start_from_given_ = false;
  bool spacing_replaced_ = false;       // since the level was made
  PlacedSpacing<Dim> placed_;           // with which it was
  int rounds_of_run_ = 0;               // in which d is held down, in the call in progress
  std::vector<Point<Dim>> unresolved_;  // by the last finish, this rank's places
  Options level_options_;               // with which it was
};

// Calls work(placement) with it as what it is.
template <class Work>
auto in_its_dimension(Placement& placement, const Work& work) {
  if (placement.dimension() == 2) return work(static_cast<PlacementOf<2>&>(placement));
  return work(static_cast<PlacementOf<3>&>(placement));
}
}  // namespace pnpbs
