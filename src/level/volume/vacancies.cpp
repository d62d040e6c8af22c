// SPDX-License-Identifier: BSD-3-Clause
#include "level/volume/vacancies.hpp"

#include <algorithm>
#include <array>
#include <tuple>
#include <utility>
#include <vector>

#include "base/space_vectors.hpp"
#include "comm/records.hpp"
#include "delaunay/volume/circumsphere.hpp"
#include "domain/volume/surface_walk.hpp"
#include "geometry/clearance.hpp"
#include "level/exchange.hpp"
#include "level/lists_and_stars.hpp"
#include "level/reach.hpp"
#include "level/volume/added_nodes.hpp"
#include "level/volume/gaps.hpp"
#include "level/volume/surface_level.hpp"
#include "level/volume/surface_stars.hpp"
#include "method/constants.hpp"

namespace pnpbs {

namespace {

// A point of a surface that is far from all nodes.
struct Vacancy {
  double radius;                    // of the circle through the nodes around it, in units of d
  std::array<std::int64_t, 3> ids;  // ids of these nodes
  Point<3> x;
  double d;
  std::int64_t facet;
};

// Adds the vacancy at the centre of the circle through three nodes, if there is one. Node i must be
// a surface node. The result has the same bits for each order of the nodes.
void add_vacancy(const Level<3>& level, std::int64_t i, std::array<std::int64_t, 3> around,
                 std::vector<Vacancy>& found) {
  const Nodes<3>& nodes = level.nodes;
  std::ranges::sort(around, {}, [&](std::int64_t j) { return nodes.id(j); });
  std::array<Point<3>, 3> x;
  std::array<std::int64_t, 3> ids;
  for (std::size_t k = 0; k < 3; ++k) {
    x[k] = nodes.position(around[k]);
    ids[k] = nodes.id(around[k]);
  }
  const Point<3> centre = circle_centre(x);
  const double d = nodes.d(i), radius = distance<3>(centre, x[0]) / d;
  if (!(radius > method::kVacant && radius < level.lists().radius())) return;
  const Surface& surface = level.geometry.surface();
  const SurfacePoint at = pull_back(surface, centre, nodes.boundary_node(i));
  const double room = method::kBoundaryClearance * d;
  if (distance<3>(at.position, centre) > method::kVacancyBend * d ||
      surface.feature_clearance(at, room) < room)
    return;
  found.push_back({radius, ids, at.position, d, at.facet});
}

std::vector<Vacancy> vacancies_of_own(const Level<3>& level) {
  const Nodes<3>& nodes = level.nodes;
  const auto is_first = [&](std::int64_t i, std::int64_t j) {
    return nodes.carrier(j) != Carrier::surface || nodes.id(i) < nodes.id(j);
  };
  std::vector<Vacancy> found;
  for (std::int64_t i = 0; i < nodes.count; ++i) {
    if (!nodes.owned(i) || nodes.carrier(i) != Carrier::surface) continue;
    const std::vector<SurfaceStarEntry> star = surface_star(level, i);
    for (std::size_t k = 0; k < star.size(); ++k) {
      const std::int64_t j = star[k].node, next = star[(k + 1) % star.size()].node;
      if (star[k].triangle && is_first(i, j) && is_first(i, next))
        add_vacancy(level, i, {i, j, next}, found);
    }
  }
  return found;
}

IncomingNode<3> node_in(const Level<3>& level, const Vacancy& vacancy) {
  return new_surface_node(level.geometry, {static_cast<std::int32_t>(vacancy.facet), vacancy.x});
}

// Returns, of the vacancies of all ranks that are too close to each other, the widest ones. There
// are few, so they are gathered on all ranks. Collective.
std::vector<Vacancy> widest(const Level<3>& level, const std::vector<Vacancy>& own) {
  std::vector<Vacancy> all = of_all_ranks(*level.comm, own), kept;
  std::ranges::sort(all, [](const Vacancy& a, const Vacancy& b) {
    return std::tie(b.radius, a.ids) < std::tie(a.radius, b.ids);
  });
  for (const Vacancy& vacancy : all)
    if (std::ranges::none_of(kept, [&](const Vacancy& other) {
          return distance<3>(other.x, vacancy.x) < method::kVacant * other.d;
        }))
      kept.push_back(vacancy);
  return kept;
}

}  // namespace

std::int64_t fill_vacancies(Level<3>& level) {
  exchange(level, kStarHops);
  std::vector<Vacancy> own;
  collective_try(*level.comm, [&] {
    rebuild_lists(level, level.settings.list_radius);
    own = vacancies_of_own(level);
    std::erase_if(own, [&](const Vacancy& vacancy) {
      return is_covered(level, node_in(level, vacancy), method::kVacant);
    });
  });
  IncomingNodes<3> nodes;
  for (const Vacancy& vacancy : widest(level, own))
    if (level.tree->owns(level.tree->tree().leaf_at(vacancy.x)))
      nodes.push_back(node_in(level, vacancy));
  return add_nodes(level, std::move(nodes));
}

}  // namespace pnpbs
