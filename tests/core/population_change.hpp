// SPDX-License-Identifier: BSD-3-Clause
// The changes that population control chooses for a set of bubbles, identified by ids.
#pragma once

#include <algorithm>
#include <cstdint>
#include <map>
#include <set>
#include <vector>

#include "bubbles.hpp"
#include "population/free_place.hpp"
#include "population/population.hpp"
#include "quick_assert.hpp"
#include "settings/settings.hpp"

using pnpbs::PopulationChange;
using pnpbs::PopulationRule;

template <int Dim>
using Set = std::vector<Bubble<Dim>>;

// Returns the rule of a run without options.
template <int Dim>
PopulationRule default_rule() {
  return pnpbs::Settings(pnpbs::Options(), Dim).population;
}

// Returns a rule with thresholds only and without a target mean distance. In the plane they are
// those of the paper (section 2.4).
template <int Dim>
PopulationRule by_thresholds() {
  PopulationRule rule = default_rule<Dim>();
  rule.mean_distance = 0;
  if (Dim == 2) {
    rule.delete_above = 9;
    rule.insert_below = 5;
  }
  return rule;
}

// Deleted and inserted nodes by id, independent of the order in memory.
template <int Dim>
struct Change {
  std::set<std::int64_t> deleted;
  std::map<std::int64_t, Point<Dim>> born;  // position by id of the parent
  bool operator==(const Change&) const = default;
};

struct Freedom {
  std::set<std::int64_t> must_go;
  bool (*fits)(double x, double y) = [](double, double) { return true; };
};

template <int Dim>
Change<Dim> choose(const Set<Dim>& set, const PopulationRule& rule, const Freedom& freedom = {},
                   double radius = 1.5) {
  Bubbles<Dim> b;
  b.box = {set[0].x, set[0].x};
  for (const Bubble<Dim>& bubble : set)
    for (int k = 0; k < Dim; ++k) {
      b.box.low[k] = std::min(b.box.low[k], bubble.x[k]);
      b.box.high[k] = std::max(b.box.high[k], bubble.x[k]);
    }
  b.grow_tree([&](const Point<Dim>&) { return set[0].d; });
  b.set(set);
  b.list(radius);
  const pnpbs::View<double> ratios = pnpbs::overlap_ratios<Dim>(b.nodes, b.lists);
  const pnpbs::View<pnpbs::Bid<Dim>> bids = pnpbs::bids_of_owned<Dim>(
      b.nodes, b.lists, ratios, rule,
      pnpbs::choose_thresholds<Dim>(*pnpbs::serial_communicator(), b.nodes, b.lists, ratios, rule,
                                    pnpbs::method::kDistanceTolerance),
      [&](std::int64_t i) { return freedom.must_go.count(b.nodes.id(i)) > 0; },
      [&](std::int64_t i) { return pnpbs::free_place<Dim>(b.nodes, b.lists, i); },
      [&](const Point<Dim>& x, double) { return freedom.fits(x[0], x[1]); });
  const PopulationChange<Dim> change = pnpbs::outcome_of_contest<Dim>(
      b.nodes, b.lists, bids, pnpbs::own_bidders<Dim>(b.nodes, bids));
  Change<Dim> by_id;
  for (std::int32_t i : change.deleted) quick_assert(by_id.deleted.insert(b.nodes.id(i)).second);
  quick_assert(std::is_sorted(change.deleted.begin(), change.deleted.end()));
  for (const pnpbs::Birth<Dim>& birth : change.born) {
    quick_assert(by_id.born.emplace(birth.parent, birth.position).second);
    for (const Bubble<Dim>& bubble : set)
      quick_assert(bubble.id != birth.parent || bubble.d == birth.d);
  }
  return by_id;
}

template <int Dim>
std::size_t nearest_to(const Set<Dim>& set, const Point<Dim>& x) {
  std::size_t nearest = 0;
  for (std::size_t i = 1; i < set.size(); ++i)
    if (pnpbs::distance<Dim>(set[i].x, x) < pnpbs::distance<Dim>(set[nearest].x, x)) nearest = i;
  return nearest;
}

template <int Dim>
bool adjacent(const Bubble<Dim>& a, const Bubble<Dim>& b, double radius) {
  return pnpbs::distance<Dim>(a.x, b.x) < radius * 0.5 * (a.d + b.d);
}

// Returns the bubbles that are at most `hops` steps over neighbours from bubble i.
template <int Dim>
std::vector<std::size_t> within_hops(const Set<Dim>& set, std::size_t i, int hops, double radius) {
  std::set<std::size_t> seen{i};
  for (int hop = 0; hop < hops; ++hop) {
    std::set<std::size_t> more;
    for (std::size_t a : seen)
      for (std::size_t b = 0; b < set.size(); ++b)
        if (adjacent<Dim>(set[a], set[b], radius)) more.insert(b);
    seen.insert(more.begin(), more.end());
  }
  return {seen.begin(), seen.end()};
}

// Expects that no two bubbles that act are within three hops of each other and, in space, within
// 1.5 spacings.
template <int Dim>
void expect_actors_far_apart(const Set<Dim>& set, const Change<Dim>& change, double radius) {
  const auto acts = [&](std::size_t i) {
    return change.born.count(set[i].id) + change.deleted.count(set[i].id) > 0;
  };
  const auto place = [&](std::size_t i) {
    const auto birth = change.born.find(set[i].id);
    return birth == change.born.end() ? set[i].x : birth->second;
  };
  const auto near = [&](std::size_t i, std::size_t j) {
    return Dim == 2 || pnpbs::distance<Dim>(place(i), place(j)) <= 1.5 * set[i].d;
  };
  for (std::size_t i = 0; i < set.size(); ++i) {
    if (!acts(i)) continue;
    for (std::size_t j : within_hops<Dim>(set, i, 3, radius))
      quick_assert(j == i || !acts(j) || !near(i, j));
  }
}
