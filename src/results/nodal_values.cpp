// SPDX-License-Identifier: BSD-3-Clause
#include "results/nodal_values.hpp"

#include <algorithm>
#include <array>

#include "base/error.hpp"
#include "level/plane/closed_sphere.hpp"
#include "spacing/nodal_spacing.hpp"
#include "spacing/patch_images.hpp"

namespace pnpbs {

namespace {

// Calls visit(result indices, behind) for each facet of a star that borders a gap, at the owner of
// its node with the smallest id. `behind` is the result index of the fourth (in the plane: third)
// corner of its simplex, or -1.
template <class Visit>
void for_rim_facets(const Results<2>& results, const Visit& visit) {
  const Level<2>& level = results.level();
  const Nodes<2>& nodes = level.nodes;
  std::vector<std::pair<std::int64_t, bool>> star;
  const std::int64_t owned = results.count();
  for (std::int64_t p = 0; p < owned; ++p) {
    const std::int64_t i = results.node_at(p);
    star.clear();
    level.stars.for_neighbours_in_order(
        i, [&](std::int64_t j, bool triangle) { star.emplace_back(j, triangle); });
    for (std::size_t k = 0; k < star.size(); ++k) {
      const auto& before = star[k > 0 ? k - 1 : star.size() - 1];
      const auto& after = star[k + 1 < star.size() ? k + 1 : 0];
      if ((star[k].second && before.second) || nodes.id(star[k].first) < nodes.id(i)) continue;
      const std::int64_t behind = star[k].second  ? results.place_of(after.first)
                                  : before.second ? results.place_of(before.first)
                                                  : -1;
      visit(std::array<std::int64_t, 2>{p, results.place_of(star[k].first)}, behind);
    }
  }
}

template <class Visit>
void for_rim_facets(const Results<3>& results, const Visit& visit) {
  const Level<3>& level = results.level();
  results.for_open_facets([&](const std::array<std::int64_t, 3>& places) {
    std::int64_t behind = -1;
    const std::int64_t a = results.node_at(places[1]), b = results.node_at(places[2]);
    if (results.kind() != GeometryKind::surface)
      level.stars.for_simplices(results.node_at(places[0]), [&](const auto& others) {
        std::int64_t third = -1;
        int shared = 0;
        for (const std::int64_t other : others)
          if (other == a || other == b)
            ++shared;
          else
            third = other;
        if (shared == 2) behind = results.place_of(third);
      });
    visit(places, behind);
  });
}

// Prepares the stars for values that are given in the present order of results. Throws if this
// changes the owned nodes. All ranks must call it, and if one rank throws, all ranks throw.
template <int Dim>
void prepare_same_stars(Results<Dim>& results) {
  const auto ids = [&] {
    std::vector<std::int64_t> all;
    const std::int64_t owned = results.count();
    for (std::int64_t p = 0; p < owned; ++p)
      all.push_back(results.level().nodes.id(results.node_at(p)));
    return all;
  };
  results.prepare_order();
  const std::vector<std::int64_t> before = ids();
  results.prepare_stars();
  if (ids() != before)
    throw Error(ErrorKind::state,
                "nodes have changed their ranks since the computation before failed: query the "
                "nodes again, and give the values at them");
}

template <int Dim, class Position, int In>
void add_nodes(const Results<Dim>& results, const Position& position, Patch<Dim, In>& patch) {
  const Nodes<Dim>& nodes = results.level().nodes;
  for (std::int64_t p = 0; p < nodes.count; ++p) {
    const std::int64_t i = results.node_at(p);
    patch.nodes.push_back({position(i), nodes.id(i), 0});
  }
}

template <int In, std::size_t Corners>
std::array<std::int32_t, Corners> by_ids(const std::vector<PatchNode<In>>& nodes,
                                         const std::array<std::int64_t, Corners>& places) {
  std::array<std::int32_t, Corners> corners;
  std::copy(places.begin(), places.end(), corners.begin());
  std::sort(corners.begin(), corners.end(), [&](std::int32_t a, std::int32_t b) {
    return nodes[static_cast<std::size_t>(a)].id < nodes[static_cast<std::size_t>(b)].id;
  });
  return corners;
}

template <int Dim, int In>
void add_rim(const Results<Dim>& results, Patch<Dim, In>& patch) {
  for_rim_facets(results, [&](const auto& places, std::int64_t behind) {
    patch.border.push_back(by_ids(patch.nodes, places));
    patch.behind.push_back(static_cast<std::int32_t>(behind));
  });
}

// Adds the triangle that closes a whole sphere as three border edges, because it is not part of the
// chart. Returns false for other elements.
template <class Row>
bool add_what_closes(const Results<2>& results, const std::array<std::int64_t, 3>& places,
                     const Row& row, Patch<2>& patch) {
  const auto node = [&](std::size_t k) { return results.node_at(places[k]); };
  if (!closes_sphere(results.level(), {node(0), node(1), node(2)})) return false;
  for (std::size_t k = 0; k < 3; ++k) {
    patch.border.push_back(row(std::array<std::int64_t, 2>{places[k], places[(k + 1) % 3]}));
    patch.behind.push_back(-1);
  }
  return true;
}
template <class Row>
bool add_what_closes(const Results<3>&, const std::array<std::int64_t, 4>&, const Row&, Patch<3>&) {
  return false;
}

}  // namespace

template <int Dim>
Patch<Dim> patch_of(Results<Dim>& results) {
  prepare_same_stars(results);
  Patch<Dim> patch;
  add_nodes(
      results, [&](std::int64_t i) { return results.level().nodes.position(i); }, patch);
  const auto row = [&](const auto& places) { return by_ids(patch.nodes, places); };
  results.for_elements([&](const auto& places) {
    if (!add_what_closes(results, places, row, patch)) patch.simplices.push_back(row(places));
  });
  add_rim(results, patch);
  return patch;
}

Patch<2, 3> sphere_patch_of(Results<2>& results) {
  prepare_same_stars(results);
  Patch<2, 3> patch;
  add_nodes(
      results, [&](std::int64_t i) { return results.point_in_space(i); }, patch);
  results.for_elements(
      [&](const auto& places) { patch.simplices.push_back(by_ids(patch.nodes, places)); });
  add_rim(results, patch);
  return patch;
}

template <int Dim>
std::shared_ptr<const Spacing<Dim>> spacing_from(Results<Dim>& results,
                                                 std::vector<double> values) {
  Patch<Dim> patch = patch_of(results);
  values.resize(patch.nodes.size());
  fill_ghosts(results.communicator(), *results.exchange_pattern(), values);
  for (std::size_t p = 0; p < values.size(); ++p) patch.nodes[p].value = values[p];
  collective_try(results.communicator(), [&] { add_images(patch, results.level().nodes.cell); });
  return std::make_shared<NodalSpacing<Dim>>(results.ranks(), std::move(patch),
                                             results.embedding());
}

template Patch<2> patch_of(Results<2>&);
template Patch<3> patch_of(Results<3>&);
template std::shared_ptr<const Spacing<2>> spacing_from(Results<2>&, std::vector<double>);
template std::shared_ptr<const Spacing<3>> spacing_from(Results<3>&, std::vector<double>);

}  // namespace pnpbs
