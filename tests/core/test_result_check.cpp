// SPDX-License-Identifier: BSD-3-Clause
// The result check detects errors and describes them. Correct results are corrupted by hand, in one
// way each time.
#include <functional>
#include <string>

#include "complaints.hpp"
#include "level_run.hpp"
#include "run_kernel_suite.hpp"

using pnpbs::DelaunayStars;
using Placement = pnpbs::PlacementImpl<2>;

namespace {

// Returns a square with a slit, whose edges have triangles on both sides.
std::unique_ptr<Placement> small_placement() {
  auto domain = std::make_shared<pnpbs::PlaneDomain>();
  shapes::add_loop(*domain, shapes::rectangle(0, 0, 1, 1));
  const double slit[] = {0.3, 0.5, 0.7, 0.5};
  domain->add_polyline(pnpbs::CurveRole::inner, false, 2, slit, nullptr, 0);
  auto placement =
      std::make_unique<Placement>(pnpbs::serial_communicator(), domain, pnpbs::Options());
  placement->set_spacing(spacing_of(constant(0.1)));
  ck_assert(placement->run() != pnpbs::Outcome::stopped);
  placement->results().prepare_stars();
  return placement;
}

// Returns a whole sphere with its closing patch.
std::unique_ptr<Placement> laid_sphere() {
  auto domain = std::make_shared<pnpbs::PlaneDomain>(pnpbs::StereographicChart(1, {0, 0, 1}));
  auto placement =
      std::make_unique<Placement>(pnpbs::serial_communicator(), domain, pnpbs::Options());
  const pnpbs::StereographicChart chart = domain->embedding().chart();
  placement->set_spacing(spacing_of([chart](double x, double y) {
    return 0.1 * chart.stretch({x, y});
  }));
  ck_assert(placement->initialise() != pnpbs::Outcome::stopped);
  return placement;
}

const pnpbs::Nodes<2>& nodes_of(const Placement& placement) { return placement.level().nodes; }

// Returns the nodes for corruption.
pnpbs::Nodes<2>& nodes_of(Placement& placement) {
  return const_cast<pnpbs::Nodes<2>&>(placement.level().nodes);
}

// Returns the inner node nearest to a point.
std::int64_t node_near(const Placement& placement, const pnpbs::Point<2>& x) {
  const pnpbs::Nodes<2>& nodes = nodes_of(placement);
  std::int64_t nearest = -1;
  for (std::int64_t i = 0; i < nodes.count; ++i)
    if (nodes.moves(i) && (nearest < 0 || pnpbs::distance<2>(nodes.position(i), x) <
                                              pnpbs::distance<2>(nodes.position(nearest), x)))
      nearest = i;
  return nearest;
}

// Returns a neighbour in the star.
std::int64_t neighbour_of(const Placement& placement, std::int64_t i) {
  std::int64_t neighbour = -1;
  placement.level().stars.for_neighbours(i, [&](std::int64_t j) { neighbour = j; });
  return neighbour;
}

void expect_complaint(const std::function<std::vector<std::string>(Placement&)>& spoil) {
  expect_check_to_say<2>(*small_placement(), spoil);
}

DelaunayStars& stars_of(Placement& placement) {
  return const_cast<DelaunayStars&>(placement.level().stars);
}

std::string id_text(const Placement& placement, std::int64_t i) {
  return std::to_string(nodes_of(placement).id(i));
}

}  // namespace

START_TEST(finds_an_id_that_comes_twice) {
  expect_complaint([](Placement& p) -> std::vector<std::string> {
    const std::int64_t i = node_near(p, {0.2, 0.2}), j = node_near(p, {0.8, 0.8});
    nodes_of(p).id(i) = nodes_of(p).id(j);
    return {"two nodes have the id", id_text(p, j), place_text(nodes_of(p).position(i)),
            place_text(nodes_of(p).position(j))};
  });
}
END_TEST

START_TEST(finds_two_nodes_in_one_place) {
  expect_complaint([](Placement& p) -> std::vector<std::string> {
    const std::int64_t i = node_near(p, {0.2, 0.2}), j = neighbour_of(p, i);
    nodes_of(p).set_position(i, nodes_of(p).position(j));
    return {"at the same point", id_text(p, i), id_text(p, j), place_text(nodes_of(p).position(j))};
  });
}
END_TEST

START_TEST(finds_nodes_that_are_not_inside) {
  for (const pnpbs::Point<2>& x :
       {pnpbs::Point<2>{0.2, -0.01}, pnpbs::Point<2>{1, 0.123}, pnpbs::Point<2>{NAN, 0.2}})
    expect_complaint([&](Placement& p) -> std::vector<std::string> {
      const std::int64_t i = node_near(p, {0.2, 0.2});
      nodes_of(p).set_position(i, x);
      return {id_text(p, i) + " " + place_text(x),
              std::isnan(x[0]) ? "has coordinates that are not usable" : " lie"};
    });
}
END_TEST

START_TEST(finds_a_boundary_node_moved_or_missing) {
  const auto corner = [](Placement& p) {
    std::int64_t i = 0;
    while (nodes_of(p).boundary_node(i) != 0) ++i;
    return i;
  };
  expect_complaint([&](Placement& p) -> std::vector<std::string> {
    nodes_of(p).set_position(corner(p), {0.001, 0.001});
    return {"(0.001, 0.001) is on the boundary, but not where it was placed: (0, 0)"};
  });
  expect_complaint([&](Placement& p) -> std::vector<std::string> {
    const std::int64_t i = corner(p);
    nodes_of(p).set_position(i, {0.01, 0.01});
    nodes_of(p).boundary_node(i) = -1;
    nodes_of(p).carrier(i) = pnpbs::Carrier::free;
    return {"the boundary's node (0, 0) occurs 0 times"};
  });
}
END_TEST

// The check requires all nodes in the margin of the patch before the finish frees them.
START_TEST(finds_a_node_of_a_patch_missing) {
  expect_check_to_say<2>(*laid_sphere(), [](Placement& p) -> std::vector<std::string> {
    pnpbs::Nodes<2>& nodes = nodes_of(p);
    std::int64_t i = 0;
    while (nodes.boundary_node(i) < 0 ||
           !p.level().geometry.domain().is_in_margin(nodes.position(i)))
      ++i;
    nodes.boundary_node(i) = -1;
    nodes.carrier(i) = pnpbs::Carrier::free;
    return {"the boundary's node " + place_text(nodes.position(i)) + " occurs 0 times"};
  });
}
END_TEST

START_TEST(finds_a_list_that_lacks_a_neighbour) {
  expect_complaint([](Placement& p) -> std::vector<std::string> {
    const std::int64_t i = node_near(p, {0.2, 0.2});
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

START_TEST(finds_stars_that_do_not_agree) {
  expect_complaint([](Placement& p) -> std::vector<std::string> {
    const std::int64_t i = node_near(p, {0.2, 0.2}), j = neighbour_of(p, i);
    stars_of(p).remove(i, j);
    return {"lacks the triangle", id_text(p, i), id_text(p, j)};
  });
  expect_complaint([](Placement& p) -> std::vector<std::string> {
    const std::int64_t i = node_near(p, {0.2, 0.2});
    stars_of(p).clear(i);
    return {"in no triangle: 1 nodes, one of them at (0.2046, 0.1617)"};
  });
}
END_TEST

START_TEST(finds_a_triangle_turned_round) {
  expect_complaint([](Placement& p) -> std::vector<std::string> {
    const std::int64_t i = node_near(p, {0.2, 0.2});
    nodes_of(p).set_position(i, {0.81, 0.77});
    return {"is not counter-clockwise", id_text(p, i)};
  });
}
END_TEST

START_TEST(finds_triangles_on_the_wrong_side_of_the_boundary) {
  expect_complaint([](Placement& p) -> std::vector<std::string> {
    auto& edges = const_cast<pnpbs::Boundary&>(p.level().geometry.boundary()).facets;
    for (pnpbs::BoundaryEdge& e : edges)
      if (e.left_inside && e.right_inside) e.left_inside = false;  // edges of the slit
    return {"a triangle outside the domain"};
  });
}
END_TEST

START_TEST(finds_a_boundary_edge_that_is_no_edge) {
  expect_complaint([](Placement& p) -> std::vector<std::string> {
    auto& boundary = const_cast<pnpbs::Boundary&>(p.level().geometry.boundary());
    const std::int64_t i = node_near(p, {0.2, 0.2}), j = node_near(p, {0.8, 0.2});
    for (const std::int64_t node : {i, j}) {
      nodes_of(p).boundary_node(node) = static_cast<std::int32_t>(boundary.nodes.size());
      boundary.nodes.push_back({nodes_of(p).position(node), 1});
    }
    boundary.facets.push_back(
        {nodes_of(p).boundary_node(i), nodes_of(p).boundary_node(j), 1, true, true});
    return {"is no edge of the triangulation", id_text(p, i)};
  });
}
END_TEST

TEST_SUITE(test_result_check) {
  return run_kernel_suite(
      "result_check",
      {finds_an_id_that_comes_twice, finds_two_nodes_in_one_place, finds_nodes_that_are_not_inside,
       finds_a_boundary_node_moved_or_missing, finds_a_node_of_a_patch_missing,
       finds_a_list_that_lacks_a_neighbour, finds_stars_that_do_not_agree,
       finds_a_triangle_turned_round, finds_triangles_on_the_wrong_side_of_the_boundary,
       finds_a_boundary_edge_that_is_no_edge});
}
