// SPDX-License-Identifier: BSD-3-Clause
// The result check detects errors in space and describes them. Correct results are corrupted by
// hand, in one way each time.
#include <cmath>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "check/conformity.hpp"
#include "check/element_measure.hpp"
#include "complaints.hpp"
#include "run_kernel_suite.hpp"

using Point3 = pnpbs::Point<3>;
using pnpbs::Carrier;
using Placement3 = pnpbs::PlacementImpl<3>;

namespace {

// Returns a cube with a small cavity.
std::unique_ptr<Placement3> small_placement() {
  auto domain = std::make_shared<pnpbs::VolumeDomain>();
  domain->add_box({0, 0, 0}, {1, 1, 1}, 1);
  domain->add_box({0.4, 0.4, 0.4}, {0.65, 0.65, 0.65}, 2);
  auto placement = std::make_unique<Placement3>(pnpbs::serial_communicator(), std::move(domain),
                                                pnpbs::Options());
  placement->set_spacing(std::make_shared<pnpbs::ConstantSpacing<3>>(0.125));
  ck_assert(placement->run() != pnpbs::Outcome::stopped);
  placement->results().prepare_stars();
  return placement;
}

// Returns the level for corruption.
pnpbs::Level<3>& level_of(Placement3& placement) {
  return const_cast<pnpbs::Level<3>&>(placement.level());
}

pnpbs::Nodes<3>& nodes_of(Placement3& placement) { return level_of(placement).nodes; }

// Returns the node with this carrier that is nearest to a point.
std::int64_t node_near(Placement3& placement, Carrier carrier, const Point3& x) {
  const pnpbs::Nodes<3>& nodes = nodes_of(placement);
  std::int64_t nearest = -1;
  for (std::int64_t i = 0; i < nodes.count; ++i)
    if (nodes.carrier(i) == carrier &&
        (nearest < 0 ||
         pnpbs::distance<3>(nodes.position(i), x) < pnpbs::distance<3>(nodes.position(nearest), x)))
      nearest = i;
  return nearest;
}

std::int64_t inner_node(Placement3& placement) {
  return node_near(placement, Carrier::free, {0.2, 0.2, 0.2});
}

std::int64_t neighbour_of(Placement3& placement, std::int64_t i) {
  std::int64_t neighbour = -1;
  placement.level().lists().for_neighbours(i, [&](std::int64_t j) { neighbour = j; });
  return neighbour;
}

std::string id_text(Placement3& placement, std::int64_t i) {
  return std::to_string(nodes_of(placement).id(i));
}

// Builds the stars again from the current nodes and lists, with these facets and this known region.
void rebuild_stars(Placement3& placement, const pnpbs::FacetIndex<3>* facets,
                   const pnpbs::KnownRegion<3>& known) {
  pnpbs::Level<3>& level = level_of(placement);
  const auto nowhere = [](std::int64_t) { return false; };  // no list is complete
  level.stars.build({level.nodes, level.tree->tree(), level.neighbourhood.buckets(), level.lists(),
                     known, facets, nowhere});
}

void expect_complaint(const std::function<std::vector<std::string>(Placement3&)>& spoil) {
  expect_check_to_say<3>(*small_placement(), spoil);
}

}  // namespace

START_TEST(finds_an_id_that_comes_twice) {
  expect_complaint([](Placement3& p) -> std::vector<std::string> {
    const std::int64_t i = inner_node(p), j = node_near(p, Carrier::free, {0.8, 0.8, 0.8});
    nodes_of(p).id(i) = nodes_of(p).id(j);
    return {"two nodes have the id", id_text(p, j), place_text(nodes_of(p).position(i))};
  });
}
END_TEST

START_TEST(finds_two_nodes_in_one_place) {
  expect_complaint([](Placement3& p) -> std::vector<std::string> {
    const std::int64_t i = inner_node(p), j = neighbour_of(p, i);
    nodes_of(p).set_position(i, nodes_of(p).position(j));
    return {"at the same point", id_text(p, i), id_text(p, j)};
  });
}
END_TEST

START_TEST(finds_nodes_that_are_not_inside) {
  for (const Point3& x : {Point3{0.2, 0.2, -0.01}, Point3{0.5, 0.52, 0.55}, Point3{1, 0.123, 0.4},
                          Point3{NAN, 0.2, 0.2}})
    expect_complaint([&](Placement3& p) -> std::vector<std::string> {
      const std::int64_t i = inner_node(p);
      nodes_of(p).set_position(i, x);
      return {id_text(p, i) + " " + place_text(x),
              std::isnan(x[0]) ? "has coordinates that are not usable" : " lie"};
    });
}
END_TEST

START_TEST(finds_boundary_nodes_moved_or_missing) {
  const auto corner = [](Placement3& p) { return node_near(p, Carrier::fixed, {0, 0, 0}); };
  expect_complaint([](Placement3& p) -> std::vector<std::string> {
    const std::int64_t i = node_near(p, Carrier::surface, {0.5, 0.5, 0});
    const Point3 x = nodes_of(p).position(i);
    nodes_of(p).set_position(i, {x[0], x[1], 1e-9});
    return {id_text(p, i), "is on a surface, but 1e-09 away"};
  });
  expect_complaint([&](Placement3& p) -> std::vector<std::string> {
    nodes_of(p).set_position(corner(p), {0, 0, 0.001});
    return {"(0, 0, 0.001) is on the boundary, but not where it was placed: (0, 0, 0)"};
  });
  expect_complaint([&](Placement3& p) -> std::vector<std::string> {
    const std::int64_t i = corner(p);
    nodes_of(p).set_position(i, {0.01, 0.01, 0.01});
    nodes_of(p).boundary_node(i) = -1;
    nodes_of(p).carrier(i) = Carrier::free;
    return {"the boundary's node (0, 0, 0) occurs 0 times"};
  });
}
END_TEST

START_TEST(finds_a_list_that_lacks_a_neighbour) {
  expect_complaint([](Placement3& p) -> std::vector<std::string> {
    const std::int64_t i = inner_node(p);
    const pnpbs::ListBlock block = p.level().lists().block(i / pnpbs::kLanes);
    std::int64_t last = -1;
    std::int32_t n = 0;
    p.level().lists().for_neighbours(i, [&](std::int64_t j) { last = j, ++n; });
    const_cast<std::int32_t&>(block.entries[(n - 1) * pnpbs::kLanes + i % pnpbs::kLanes]) =
        static_cast<std::int32_t>(nodes_of(p).count);  // the index of the padding
    return {"adjacency list", id_text(p, i), id_text(p, last)};
  });
}
END_TEST

START_TEST(finds_a_tetrahedron_turned_over) {
  expect_complaint([](Placement3& p) -> std::vector<std::string> {
    const std::int64_t i = inner_node(p);
    nodes_of(p).set_position(i, {0.81, 0.77, 0.79});
    return {"has no positive volume", id_text(p, i)};
  });
}
END_TEST

// Nodes whose stars reach an unknown leaf have no star.
START_TEST(finds_stars_that_do_not_agree) {
  expect_complaint([](Placement3& p) -> std::vector<std::string> {
    const pnpbs::BackgroundTree<3>& tree = p.level().tree->tree();
    std::vector<char> known(static_cast<std::size_t>(tree.leaf_count()), 1);
    known[static_cast<std::size_t>(tree.leaf_at({0.2, 0.2, 0.2}))] = 0;
    rebuild_stars(p, &p.level().geometry.domain().index().sides(),
                  pnpbs::KnownRegion<3>(tree, known));
    return {"lacks the tetrahedron with nodes"};
  });
}
END_TEST

// Tetrahedra with circumspheres wider than a node's d allows are not elements.
START_TEST(finds_gaps_inside) {
  expect_complaint([](Placement3& p) -> std::vector<std::string> {
    const std::int64_t i = inner_node(p);
    const double d = nodes_of(p).d(i);
    nodes_of(p).d(i) = 1e-3;
    rebuild_stars(p, &p.level().geometry.domain().index().sides(), {});
    nodes_of(p).d(i) = d;
    return {"lies inside, but "};
  });
}
END_TEST

/* A node in the plane of three others with which it forms a tetrahedron. */
START_TEST(tells_of_tetrahedra_without_a_volume) {
  const std::unique_ptr<Placement3> p = small_placement();
  ck_assert_int_eq(pnpbs::conformity_of(p->results()).flat.count, 0);
  const std::int64_t i = inner_node(*p);
  std::array<std::int32_t, 3> others{};
  p->level().stars.for_simplices(i, [&](const std::array<std::int32_t, 3>& at) { others = at; });
  Point3 middle{};
  for (const std::int32_t j : others)
    for (std::size_t k = 0; k < 3; ++k) middle[k] += nodes_of(*p).position(j)[k] / 3;
  nodes_of(*p).set_position(i, middle);
  const pnpbs::Conformity<3> found = pnpbs::conformity_of(p->results());
  ck_assert_int_eq(found.flat.count, 1);
  ck_assert_int_eq(std::ssize(found.torn), 4);
  ck_assert(!found.holds());
  ck_assert(pnpbs::text_of(found, p->results())
                .text()
                .starts_with("of no volume: 1 tetrahedra, one of them at "));
}
END_TEST

START_TEST(finds_tetrahedra_outside) {
  expect_complaint([](Placement3& p) -> std::vector<std::string> {
    rebuild_stars(p, nullptr, {});
    return {"the tetrahedra have the volume ", ", the domain 0.984"};
  });
}
END_TEST

// A coin without an inside. Chords replace its circles, and cut off more of its flat sides than of
// its rim, which is low.
START_TEST(allows_for_chords_of_edges_of_flat_sides) {
  constexpr double kHeight = 0.05;
  auto domain = std::make_shared<pnpbs::VolumeDomain>();
  domain->add_cylinder({0, 0, 0}, {0, 0, kHeight}, 1, 1);
  domain->set_filled(false);
  Placement3 placement(pnpbs::serial_communicator(), std::move(domain), pnpbs::Options());
  placement.set_spacing(std::make_shared<pnpbs::ConstantSpacing<3>>(2 * kHeight));
  ck_assert(placement.run() != pnpbs::Outcome::stopped);
  placement.results().prepare_stars();
  const pnpbs::ElementMeasure measure = pnpbs::measure_of_elements(placement.results());
  ck_assert_double_gt(measure.domain - measure.elements, 1e-4 * measure.domain);
  ck_assert(measure.agrees());
  // The tolerance, the area between chords and circles, exceeds the actual difference only by a
  // small factor, so that a missing triangle is still detected.
  ck_assert_double_lt(measure.between, 8 * measure.difference());
}
END_TEST

TEST_SUITE(test_volume_result_check) {
  return run_kernel_suite(
      "volume_result_check",
      {finds_an_id_that_comes_twice, finds_two_nodes_in_one_place, finds_nodes_that_are_not_inside,
       finds_boundary_nodes_moved_or_missing, finds_a_list_that_lacks_a_neighbour,
       finds_a_tetrahedron_turned_over, finds_stars_that_do_not_agree, finds_gaps_inside,
       finds_tetrahedra_outside, tells_of_tetrahedra_without_a_volume,
       allows_for_chords_of_edges_of_flat_sides});
}
