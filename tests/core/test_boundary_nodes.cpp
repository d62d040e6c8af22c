// SPDX-License-Identifier: BSD-3-Clause
// Boundary nodes that ranks contribute to a level: the result does not depend on their order.
#include <algorithm>

#include "geometry/run_suite.hpp"
#include "level/boundary_nodes.hpp"
#include "quick_assert.hpp"

namespace {

using pnpbs::Carrier;
using pnpbs::IncomingNode;

// One bubble on a surface has come to rest in a corner, another one on a curve. One node existed
// before, and one is at another point.
pnpbs::IncomingNodes<3> nodes_in_one_place() {
  return {{{1, 2, 3}, -1, Carrier::surface, 17, 1},
          {{1, 2, 3}, -1, Carrier::fixed, 4, 0},
          {{1, 2, 3}, 9, Carrier::fixed, 4, 0},
          {{1, 2, 3}, -1, Carrier::curve, 8, 2},
          {{0, 2, 3}, -1, Carrier::surface, 16, 1}};
}

}  // namespace

START_TEST(least_freedom_counts_in_any_order) {
  pnpbs::IncomingNodes<3> given = nodes_in_one_place();
  std::vector<int> order{0, 1, 2, 3, 4};
  do {
    pnpbs::IncomingNodes<3> named;
    for (const int k : order) named.push_back(given[static_cast<std::size_t>(k)]);
    const pnpbs::BoundaryNodes<3> laid(std::move(named));
    ck_assert_uint_eq(laid.size(), 2);
    ck_assert(laid.position(1) == (pnpbs::Point<3>{1, 2, 3}));
    ck_assert_int_eq(laid.id(1), 9);
    ck_assert(laid.carrier(1) == Carrier::fixed);
  } while (std::next_permutation(order.begin(), order.end()));
}
END_TEST

TEST_SUITE(test_boundary_nodes) {
  return run_suite("laid_nodes", {least_freedom_counts_in_any_order});
}
