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
#include "placement/facet_tag.hpp"
#include "placement/inner_facets.hpp"
#include "placement/placement.hpp"
#include "placement/saved_state.hpp"
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
      : Placement(std::move(comm), std::move(options)), domain_(std::move(domain)) {}

  int dimension() const override { return Dim; }
  Domain<Dim>& domain() { return *domain_; }
  void set_spacing(std::shared_ptr<const Spacing<Dim>> spacing);
  void set_nodes(GivenNodes<Dim> nodes);
  void forget_nodes() override { level_.reset(); }

  Outcome initialise() override;
  Outcome step(std::int64_t n) override;
  Outcome run() override;
  Outcome adjust_population(PopulationCounts& change) override;
  Outcome rebalance() override;
  Estimate estimate() override;

  bool has_nodes() const override { return level_ != nullptr; }
  // Counts them, unless the order of nodes has.
  std::int64_t count() const override;
  NodeColumns nodes() const override;
  const Level<Dim>& level() const { return *level_; }
  const Domain<Dim>& domain() const { return *domain_; }
  void prepare_order() override;
  void prepare_lists() override;
  void prepare_stars() override;
  // Calls visit(places of its corners) for every element, a triangle or a tetrahedron, once, over
  // all ranks: at the owner of its node with the least id, which comes first. After prepare_stars.
  template <class Visit>
  void for_elements(const Visit& visit) const {
    for_elements(0, count(), visit);
  }
  // Only those whose first node has a place from begin up to end, by that place.
  template <class Visit>
  void for_elements(std::int64_t begin, std::int64_t end, const Visit& visit) const;
  // Calls visit(places of its nodes, tag) for every facet of the boundary once, over all ranks. In
  // the plane an edge comes at the owner of the node it begins with, after prepare_order; in space
  // it is the open facets, after prepare_stars.
  template <class Visit>
  void for_boundary_facets(const Visit& visit) const;
  template <class Visit>
  void for_boundary_facets(std::int64_t begin, std::int64_t end, const Visit& visit) const
      requires(Dim == 3);
  // Calls visit(places) for every face of only one tetrahedron, once, over all ranks: at the owner
  // of its node with the least id, which comes first; so that from outside they turn
  // counter-clockwise. After prepare_stars.
  template <class Visit>
  void for_open_facets(const Visit& visit) const requires(Dim == 3) {
    for_open_facets(0, count(), visit);
  }
  // Only those whose first node has a place from begin up to end, by that place. Of surfaces alone,
  // all triangles.
  template <class Visit>
  void for_open_facets(std::int64_t begin, std::int64_t end, const Visit& visit) const
      requires(Dim == 3);
  // Calls visit(places of its nodes, tag) for every face between tetrahedra that stands for a
  // surface inside, once, over all ranks: at the owner of its node with the least id, which comes
  // first and has a place from begin up to end. They turn as the surface does. After prepare_stars.
  template <class Visit>
  void for_inner_facets(std::int64_t begin, std::int64_t end, const Visit& visit) const
      requires(Dim == 3);
  template <class Visit>
  void for_inner_facets(const Visit& visit) const requires(Dim == 3) {
    for_inner_facets(0, count(), visit);
  }
  // Whether the domain is surfaces alone, and of what its bubbles fill.
  bool surfaces_alone() const {
    if constexpr (Dim == 3) return !domain_->filled();
    return false;
  }
  int owner_of(std::int64_t node) const {
    return level_->tree->owner_at(level_->nodes.position(node));
  }
  std::shared_ptr<const ExchangePattern> exchange_pattern() override;
  // The triangulation there is, with one node for each place of this rank, and no values.
  // Collective.
  Patch<Dim> patch();
  // d by its values at this rank's nodes, in places. Collective.
  std::shared_ptr<const Spacing<Dim>> spacing_from(std::vector<double> values);

  std::int64_t rebuilds() const override {
    return state_.rebuilds_before + (level_ ? level_->neighbourhood.rebuilds() : 0);
  }
  std::int64_t rebalances() const override {
    return state_.rebalances_before + (level_ ? level_->rebalances : 0);
  }
  std::int64_t left_out() const override { return level_ ? level_->left_out : 0; }
  std::int64_t unresolved_places() const override { return std::ssize(placed_.held.places); }
  RepairDistances repair_distances() const override {
    if constexpr (Dim == 3) return domain_->repair_distances();
    return {};
  }
  Speeds speeds() const override { return level_ ? speeds_of(*level_) : Speeds{}; }
  LevelFigures level_figures() const override;
  std::int64_t boundary_nodes() const override;
  double imbalance() const override { return level_ ? imbalance_of(*level_) : 1; }
  NearestNeighbourError spacing_error() override;
  const ElementQuality& element_quality() override;
  std::uint64_t hash() const override;

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
  LevelStamp stamp() const override { return level_ ? level_->stamp() : LevelStamp(); }
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
  void adopt_level(std::unique_ptr<Level<Dim>> next);
  void gather_warnings(const SteepestGrowth<Dim>& steepest);
  int coarser_levels_that_pay(const Level<Dim>& finest,
                              const std::shared_ptr<const Spacing<Dim>>& spacing) const;
  bool boundary_leaves_room(const Level<Dim>& finest, const Spacing<Dim>& coarser, double factor,
                            double nodes) const;
  TakenNodes put_first_nodes(std::unique_ptr<Level<Dim>>& level, GivenNodes<Dim>& from_coarser,
                             int which, Outcome& outcome);
  void settle_surfaces(std::unique_ptr<Level<Dim>>& level, GivenNodes<Dim>& nodes, Outcome& outcome,
                       bool multiplied = false);                           // in space
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
  bool bubbles_rest() const;
  Outcome advance(std::int64_t until, ProgressPart part);
  void event();
  double tolerance_of_mean(int round) const;
  void control_population();
  void keep_balance();
  void rebalance_now();
  bool far_too_few() const;
  bool stops_after_step(bool is_event, double fraction);
  void fill(Level<Dim>& level, LaidNodes<Dim> laid);
  void repair_defects();
  Outcome finish();
  Outcome steps_and_finish();
  double done_by_rounds() const;
  ProgressPart part_of_steps() const;
  template <class Stops>
  Outcome smooth(const Stops& stops);
  void gather_unknown_uses();
  void measure_finish();    // in space
  bool elements_conform();  // if not there is a warning; collective

  std::shared_ptr<Domain<Dim>> domain_;
  std::shared_ptr<const Spacing<Dim>> spacing_;
  std::unique_ptr<Level<Dim>> level_;
  GivenNodes<Dim> given_;  // nodes to start from instead of a fill
  bool start_from_given_ = false;
  bool spacing_replaced_ = false;       // since the level was made
  PlacedSpacing<Dim> placed_;           // with which it was
  int rounds_of_run_ = 0;               // in which d is held down, in the call in progress
  std::vector<Point<Dim>> unresolved_;  // by the last finish, this rank's places
  Options level_options_;               // with which it was
};

template <int Dim>
template <class Visit>
void PlacementOf<Dim>::for_elements(std::int64_t begin, std::int64_t end,
                                    const Visit& visit) const {
  const View<std::int64_t> id = level_->nodes.id;
  for (std::int64_t p = begin; p < end; ++p) {
    const std::int64_t i = node_at(p);
    level_->stars.for_simplices(i, [&](const typename Stars<Dim>::Corners& others) {
      std::array<std::int64_t, Dim + 1> places{p};
      for (std::size_t k = 0; k < Dim; ++k) {
        if (id(others[k]) < id(i)) return;
        places[k + 1] = place_of(others[k]);
      }
      visit(places);
    });
  }
}

template <int Dim>
template <class Visit>
void PlacementOf<Dim>::for_boundary_facets(const Visit& visit) const {
  if constexpr (Dim == 2) {
    const Boundary& boundary = level_->ground.boundary();
    const Nodes<2>& nodes = level_->nodes;
    std::vector<std::int64_t> place(boundary.nodes.size(), -1);
    for (std::int64_t i = 0; i < nodes.count; ++i)
      if (!nodes.moves(i)) place[static_cast<std::size_t>(nodes.boundary_node(i))] = place_of(i);
    const std::int64_t owned = count();
    for (const BoundaryEdge& e : boundary.facets) {
      if (e.begin == e.end) continue;  // a fixed node
      const std::int64_t begin = place[static_cast<std::size_t>(e.begin)];
      if (begin >= 0 && begin < owned)
        visit(std::array<std::int64_t, 2>{begin, place[static_cast<std::size_t>(e.end)]}, e.tag);
    }
  } else {
    for_boundary_facets(0, count(), visit);
  }
}

template <int Dim>
template <class Visit>
void PlacementOf<Dim>::for_boundary_facets(std::int64_t begin, std::int64_t end,
                                           const Visit& visit) const requires(Dim == 3) {
  for_open_facets(begin, end, [&](const std::array<std::int64_t, 3>& places) {
    const auto [a, b, c] = places;
    visit(places, facet_tag(*level_, {node_at(a), node_at(b), node_at(c)}));
  });
}

template <int Dim>
template <class Visit>
void PlacementOf<Dim>::for_inner_facets(std::int64_t begin, std::int64_t end,
                                        const Visit& visit) const requires(Dim == 3) {
  InnerFacets facets(*level_);
  for (std::int64_t p = begin; p < (facets.any() ? end : begin); ++p)
    for (const InnerFacet& facet : facets.at(node_at(p)))
      visit(std::array<std::int64_t, 3>{p, place_of(facet.nodes[1]), place_of(facet.nodes[2])},
            facet.tag);
}

// Of the tetrahedra around a node, those of its faces that come once.
template <int Dim>
template <class Visit>
void PlacementOf<Dim>::for_open_facets(std::int64_t begin, std::int64_t end,
                                       const Visit& visit) const requires(Dim == 3) {
  const View<std::int64_t> id = level_->nodes.id;
  struct Face {
    std::int64_t low, high;               // ids of the other two nodes
    std::array<std::int64_t, 3> turning;  // places, as seen from outside
  };
  std::vector<Face> faces;
  for (std::int64_t p = begin; p < end; ++p) {
    const std::int64_t i = node_at(p);
    level_->stars.for_triangles(i, [&](const std::array<std::int32_t, 2>& others) {
      const auto [a, b] = others;
      if (id(i) < id(a) && id(i) < id(b))
        visit(std::array<std::int64_t, 3>{p, place_of(a), place_of(b)});
    });
    if (level_->stars.closed(i)) continue;
    faces.clear();
    level_->stars.for_simplices(i, [&](const typename Stars<Dim>::Corners& others) {
      // (i, a, b, c) turns right-handed: from outside, its faces with i turn as i, b, a.
      for (std::size_t k = 0; k < 3; ++k) {
        const std::int64_t a = others[k], b = others[(k + 1) % 3];
        if (id(a) < id(i) || id(b) < id(i)) continue;
        faces.push_back(
            {std::min(id(a), id(b)), std::max(id(a), id(b)), {p, place_of(b), place_of(a)}});
      }
    });
    std::sort(faces.begin(), faces.end(), [](const Face& f, const Face& g) {
      return f.low != g.low ? f.low < g.low : f.high < g.high;
    });
    const auto same = [&](std::size_t f, std::size_t g) {
      return g < faces.size() && faces[f].low == faces[g].low && faces[f].high == faces[g].high;
    };
    for (std::size_t f = 0; f < faces.size(); ++f)
      if (!same(f, f + 1) && !(f > 0 && same(f, f - 1))) visit(faces[f].turning);
  }
}

// Calls work(placement) with it as what it is.
template <class Work>
auto in_its_dimension(Placement& placement, const Work& work) {
  if (placement.dimension() == 2) return work(static_cast<PlacementOf<2>&>(placement));
  return work(static_cast<PlacementOf<3>&>(placement));
}
template <class Work>
auto in_its_dimension(const Placement& placement, const Work& work) {
  if (placement.dimension() == 2) return work(static_cast<const PlacementOf<2>&>(placement));
  return work(static_cast<const PlacementOf<3>&>(placement));
}

}  // namespace pnpbs
