// SPDX-License-Identifier: BSD-3-Clause
// Nodes on surfaces that move along them to remove slivers: the changed stars, against stars built
// from scratch.
#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <set>
#include <vector>

#include "delaunay/volume/domain_rule.hpp"
#include "mapped_volume.hpp"
#include "quality/volume/node_move.hpp"
#include "quality/volume/sliver_repair.hpp"
#include "quality/volume/tetrahedron_quality.hpp"
#include "run_kernel_suite.hpp"
#include "sliver_rounds.hpp"
#include "volume_tetrahedra.hpp"

using pnpbs::Carrier;
using P = Point<3>;
using volume_tetrahedra::Ids;
using volume_tetrahedra::in_stars;
using volume_tetrahedra::Places;
using volume_tetrahedra::places_by_id;

namespace {

constexpr double kUnit = 0x1p-6, kStep = 3 * kUnit;  // the corners of a cube are six apart
const pnpbs::KnownRegion<3> kEverywhere;

// Returns whether a cube of the pierced cube lies beside the point in this octant.
bool solid_beside(const std::array<std::int64_t, 3>& place, unsigned octant) {
  std::array<std::int64_t, 3> cube;
  for (std::size_t k = 0; k < 3; ++k) {
    const std::int64_t twice = 2 * place[k] + (octant >> k & 1 ? 1 : -1);
    if (twice < 0 || twice > 2 * 48) return false;
    cube[k] = twice / 12;
  }
  const auto& [i, j, k] = cube;
  const bool hole = i >= 4 && i < 6 && j >= 3 && j < 6;
  const bool cavity = i >= 1 && i < 3 && j >= 2 && j < 4 && k >= 3 && k < 6;
  return !hole && !cavity;
}

struct Lattice {
  std::vector<Bubble<3>> bubbles;
  std::map<std::int64_t, int> axis;  // by id, for nodes inside a side: the axis orthogonal to it

  // Nodes on sides are displaced along these.
  Lattice(double inner_shake, double side_shake) {
    Random random(24);
    for (std::int64_t i = 0; i <= 48; i += 3)
      for (std::int64_t j = 0; j <= 48; j += 3)
        for (std::int64_t k = 0; k <= 48; k += 3) add({i, j, k}, random, inner_shake, side_shake);
    random.shuffle(bubbles);
  }

 private:
  void add(const std::array<std::int64_t, 3>& place, Random& random, double inner_shake,
           double side_shake) {
    int solid = 0, side = -1;
    for (unsigned octant = 0; octant < 8; ++octant) solid += solid_beside(place, octant);
    if (solid == 0) return;
    for (unsigned k = 0; k < 3 && solid == 4; ++k) {
      bool alike = true;  // on each side of it
      for (unsigned octant = 0; octant < 8; ++octant)
        alike = alike && solid_beside(place, octant) == solid_beside(place, octant & (1u << k));
      if (alike) side = static_cast<int>(k);
    }
    P x;
    for (std::size_t k = 0; k < 3; ++k) {
      const double shake = solid == 8 ? inner_shake : side >= 0 ? side_shake : 0;
      x[k] = kUnit * static_cast<double>(place[k]);
      if (static_cast<int>(k) != side) x[k] += random.between(-shake, shake) * kStep;
    }
    const std::int64_t id = std::ssize(bubbles);
    bubbles.push_back({x, kStep, id, solid == 8});
    if (side >= 0) axis[id] = side;
  }
};

// A lattice with the pierced cube as domain.
struct Pierced {
  Mapped domain;
  Lattice lattice;
  Bubbles<3> b;
  pnpbs::VolumeStars stars;

  Pierced(double inner_shake, double side_shake)
      : domain(scaled(surfaces::pierced_cube(), kUnit), constant(kStep)),
        lattice(inner_shake, side_shake) {
    b.box = domain.surface.bounds();
    b.grow_tree([](const P&) { return kStep; });
    b.set(lattice.bubbles);
    for (std::int64_t i = 0; i < b.nodes.count; ++i)
      if (lattice.axis.contains(b.nodes.id(i))) b.nodes.carrier(i) = Carrier::surface;
    make_stars();
  }
  Pierced(const Pierced&) = delete;

  pnpbs::VolumeStarInput input() const {
    pnpbs::VolumeStarInput input = volume_tetrahedra::input_of(b, kEverywhere);
    input.facets = &domain.map;
    return input;
  }
  void make_stars() {
    b.list(1.5);
    stars.build(input());
  }
  pnpbs::SurfaceNodeMove::InDomain rule() const {
    return [this](const std::array<std::int64_t, 4>& nodes, const pnpbs::Tetrahedron& corners) {
      return pnpbs::in_domain(input(), nodes, corners);
    };
  }
  bool on_side(std::int64_t i) const { return b.nodes.carrier(i) == Carrier::surface; }
  P along_side(std::int64_t i, P way) const {
    way[static_cast<std::size_t>(lattice.axis.at(b.nodes.id(i)))] = 0;
    return way;
  }
  pnpbs::AlongSurfaces along_surfaces() {
    const auto walk = [this](std::int64_t i, const P& direction, double length) {
      const P way = along_side(i, direction);
      P x = b.nodes.position(i);
      const double whole = std::hypot(way[0], way[1], way[2]);
      for (std::size_t k = 0; k < 3; ++k) x[k] += length / whole * way[k];
      return pnpbs::AlongSurfaces::Place{x, 7};
    };
    return {walk, rule(), {}, {}};
  }

  // Counts slivers with a node on a side, by the current stars.
  std::int64_t slivers_at_sides() const {
    std::int64_t found = 0;
    for (std::int64_t i = 0; i < b.nodes.count; ++i)
      stars.for_simplices(i, [&](const std::array<std::int32_t, 3>& others) {
        std::array<P, 4> x{b.nodes.position(i)};
        for (std::size_t k = 0; k < 3; ++k) x[k + 1] = b.nodes.position(others[k]);
        found += on_side(i) && pnpbs::min_dihedral_angle(x) < 30;
      });
    return found;
  }
};

bool are_among(const std::vector<pnpbs::TetrahedronNodes>& some,
               const std::vector<pnpbs::TetrahedronNodes>& all) {
  const auto corners = [](const std::vector<pnpbs::TetrahedronNodes>& tetrahedra) {
    std::set<pnpbs::TetrahedronNodes> sets;
    for (pnpbs::TetrahedronNodes t : tetrahedra) {
      std::sort(t.begin(), t.end());
      sets.insert(t);
    }
    return sets;
  };
  return std::ranges::includes(corners(all), corners(some));
}

}  // namespace

START_TEST(stars_follow_nodes_on_surfaces) {
  Pierced p(0.15, 0.15);
  pnpbs::Nodes<3>& nodes = p.b.nodes;
  pnpbs::StarChanges changes(nodes, p.stars, true);
  const pnpbs::SurfaceNodeMove::InDomain rule = p.rule();
  Random random(3);
  std::int64_t on_sides = 0, inner = 0, refused = 0, changed = 0;
  while (on_sides < 400) {
    const auto i = static_cast<std::int32_t>(random.below(nodes.count));
    P way;
    for (double& along : way) along = random.between(-0.2, 0.2) * kStep;
    if (p.on_side(i)) way = p.along_side(i, way);
    const P x =
        pnpbs::Point<3>{nodes.x[0](i) + way[0], nodes.x[1](i) + way[1], nodes.x[2](i) + way[2]};
    pnpbs::StarChange change{i, x, {}, {}};
    if (p.on_side(i)) {
      ++on_sides;
      pnpbs::SurfaceNodeMove move(nodes, changes, i, {}, rule);
      move.go_to(x, 5);
      const pnpbs::StarChange bounds = move.change();
      if (!move.complete()) {
        ++refused;
        continue;
      }
      change = move.change();
      ck_assert_int_eq(change.on, 5);
      quick_assert(are_among(bounds.made, change.made) && are_among(change.gone, bounds.gone));
      changed += change.gone.size() != change.made.size();
    } else if (nodes.moves(i) && ++inner % 4 == 0) {
      pnpbs::NodeMove move(nodes, changes, i);
      if (!move.go_to(x) || !move.complete()) continue;
      change = move.change();
    } else {
      continue;
    }
    changes.accept({&change, 1});
    nodes.set_position(i, x);
  }
  ck_assert_int_gt(changed, 50);
  ck_assert_int_lt(refused, 5);
  const std::multiset<Ids> followed = in_stars(p.b.nodes, changes);
  p.make_stars();
  quick_assert(followed == in_stars(p.b.nodes, p.stars));
}
END_TEST

// Free nodes are not allowed to move here, so nodes on sides do.
START_TEST(slivers_at_surfaces_are_mended) {
  Pierced p(0.25, 0.25);
  const auto nowhere = [](std::int64_t, const P&) { return false; };
  const Places before = places_by_id(p.b.nodes);
  const std::int64_t slivers_before = p.slivers_at_sides();
  ck_assert_int_gt(slivers_before, 20);
  pnpbs::SliverRepair repair(p.b.nodes, p.stars, kSlivers, nowhere, p.along_surfaces());
  std::int64_t moved = 0;
  for (std::int64_t round = 50; round < 150; ++round) moved += one_round(repair, round);
  ck_assert_int_gt(moved, 10);
  p.make_stars();
  ck_assert_int_lt(5 * p.slivers_at_sides(), 4 * slivers_before);
  for (std::int64_t i = 0; i < p.b.nodes.count; ++i) {
    const P x = p.b.nodes.position(i), old = before.at(p.b.nodes.id(i));
    if (!p.on_side(i)) {
      quick_assert(x == old);
      continue;
    }
    const auto axis = static_cast<std::size_t>(p.lattice.axis.at(p.b.nodes.id(i)));
    quick_assert(x[axis] == old[axis]);
    ck_assert_int_eq(p.b.nodes.boundary_node(i), x == old ? 0 : 7);
  }
}
END_TEST

// Nodes whose walks end beside the surface are projected onto it, or do not move at all.
START_TEST(nodes_are_settled_on_surfaces) {
  for (const bool found : {true, false}) {
    Pierced p(0.25, 0.25);
    const auto nowhere = [](std::int64_t, const P&) { return false; };
    const Places before = places_by_id(p.b.nodes);
    pnpbs::AlongSurfaces ways = p.along_surfaces();
    const auto on_surface = ways.walk;
    ways.walk = [&](std::int64_t i, const P& direction, double length) {
      pnpbs::AlongSurfaces::Place to = on_surface(i, direction, length);
      const auto axis = static_cast<std::size_t>(p.lattice.axis.at(p.b.nodes.id(i)));
      to.x[axis] += 0x1p-12;
      return to;
    };
    std::size_t settled = 0;
    ways.settle = [&](std::vector<pnpbs::AlongSurfaces::Place>& places) {
      for (pnpbs::AlongSurfaces::Place& place : places) {
        ++settled;
        for (double& c : place.x)  // coordinates on surfaces are multiples of kUnit
          if (std::fabs(c - 0x1p-12 - kUnit * std::round(c / kUnit)) < 1e-12) c -= 0x1p-12;
        place.facet = found ? 9 : -1;
      }
    };
    pnpbs::SliverRepair repair(p.b.nodes, p.stars, kSlivers, nowhere, ways);
    std::int64_t moved = 0;
    for (std::int64_t round = 50; round < 100; ++round) moved += one_round(repair, round);
    ck_assert_uint_gt(settled, 10);
    ck_assert_int_eq(moved > 10, found);
    ck_assert_int_eq(moved == 0, !found);
    for (std::int64_t i = 0; i < p.b.nodes.count; ++i) {
      const P x = p.b.nodes.position(i), old = before.at(p.b.nodes.id(i));
      if (x == old) continue;
      const auto axis = static_cast<std::size_t>(p.lattice.axis.at(p.b.nodes.id(i)));
      quick_assert(x[axis] == old[axis]);
      ck_assert_int_eq(p.b.nodes.boundary_node(i), 9);
    }
    pnpbs::VolumeStars stars = p.stars;
    repair.write_stars(stars);
    const std::multiset<Ids> kept = in_stars(p.b.nodes, stars);
    p.make_stars();
    quick_assert(kept == in_stars(p.b.nodes, p.stars));
  }
}
END_TEST

// Nodes on surfaces stay as long as free nodes can remove the sliver, and also if there is no rule
// for moving along surfaces.
START_TEST(free_nodes_come_first) {
  Pierced p(0.25, 0), alone(0.25, 0);
  const auto anywhere = [](std::int64_t, const P&) { return true; };
  pnpbs::SliverRepair repair(p.b.nodes, p.stars, kSlivers, anywhere, p.along_surfaces());
  pnpbs::SliverRepair without(alone.b.nodes, alone.stars, kSlivers, anywhere);
  const Places before = places_by_id(p.b.nodes);
  std::int64_t moved = 0;
  for (std::int64_t round = 0; round < 20; ++round) moved += one_round(repair, round);
  for (std::int64_t round = 0; round < 80; ++round) one_round(without, round);
  ck_assert_int_gt(moved, 20);
  for (std::int64_t i = 0; i < p.b.nodes.count; ++i)
    if (p.on_side(i)) quick_assert(p.b.nodes.position(i) == before.at(p.b.nodes.id(i)));
  for (const auto& [id, x] : places_by_id(alone.b.nodes))
    if (p.lattice.axis.contains(id)) quick_assert(x == before.at(id));
}
END_TEST

// Two ranks that own one half each, and exchange changes including facets.
START_TEST(the_same_from_two_halves) {
  Pierced whole(0.25, 0.25), low(0.25, 0.25), high(0.25, 0.25);
  for (std::int64_t i = 0; i < low.b.nodes.count; ++i) {
    low.b.nodes.owned(i) = low.b.nodes.position(i)[1] < 0.4;
    high.b.nodes.owned(i) = high.b.nodes.position(i)[1] >= 0.4;
  }
  const auto keeps_off = [](const Pierced& p) {
    return [&p](std::int64_t i, const P& x) {
      for (std::size_t k = 0; k < 3; ++k)
        if (std::fabs(x[k] - 0.4) > 0.3) return false;
      return p.b.nodes.moves(i);
    };
  };
  pnpbs::SliverRepair all(whole.b.nodes, whole.stars, kSlivers, keeps_off(whole),
                          whole.along_surfaces()),
      of_low(low.b.nodes, low.stars, kSlivers, keeps_off(low), low.along_surfaces()),
      of_high(high.b.nodes, high.stars, kSlivers, keeps_off(high), high.along_surfaces());
  const auto news_of = [](const pnpbs::SliverRepair& repair) {
    std::vector<pnpbs::ChangedTetrahedron> news;
    for (const std::int32_t i : repair.moved_nodes()) {
      const auto more = repair.changes_of(i);
      news.insert(news.end(), more.begin(), more.end());
    }
    return news;
  };
  const auto facets = [](const Pierced& p) {
    std::map<std::int64_t, std::int32_t> all_of;
    for (std::int64_t i = 0; i < p.b.nodes.count; ++i)
      all_of[p.b.nodes.id(i)] = p.b.nodes.boundary_node(i);
    return all_of;
  };
  std::int64_t here = 0, there = 0;
  for (std::int64_t round = 40; round < 70; ++round) {
    const std::int64_t moved = one_round(all, round);
    draw_on_both(of_low, of_high, round);
    const std::int64_t low_moved = of_low.move(), high_moved = of_high.move();
    ck_assert_int_eq(low_moved + high_moved, moved);
    here += low_moved;
    there += high_moved;
    of_low.follow(news_of(of_high));
    of_high.follow(news_of(of_low));
    quick_assert(places_by_id(low.b.nodes) == places_by_id(whole.b.nodes) &&
                 places_by_id(high.b.nodes) == places_by_id(whole.b.nodes));
    quick_assert(facets(low) == facets(whole) && facets(high) == facets(whole));
  }
  ck_assert_int_gt(here, 10);
  ck_assert_int_gt(there, 10);
}
END_TEST

TEST_SUITE(test_surface_moves) {
  return run_kernel_suite(
      "surface_moves",
      {stars_follow_nodes_on_surfaces, slivers_at_surfaces_are_mended,
       nodes_are_settled_on_surfaces, free_nodes_come_first, the_same_from_two_halves});
}
