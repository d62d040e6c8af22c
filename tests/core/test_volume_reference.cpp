// SPDX-License-Identifier: BSD-3-Clause
// The stars of 20 000 nodes in space against the Delaunay triangulation of CGAL.
#include <algorithm>
#include <cmath>
#include <vector>

#include "delaunay/volume/element_rule.hpp"
#include "evaluate_volume.hpp"
#include "run_kernel_suite.hpp"
#include "volume_tetrahedra.hpp"

using pnpbs::VolumeStars;
using volume_tetrahedra::Ids;
using P = Point<3>;

namespace {

// A spacing that is finer by a factor of three towards a corner; on average 1.5 nodes per d^3.
double graded(const P& x) { return 0.0222 * (1 + pnpbs::distance<3>(x, {}) / std::sqrt(0.75)); }

std::vector<Bubble<3>> random_nodes(std::uint64_t seed, int n) {
  Random random(seed);
  std::vector<Bubble<3>> nodes;
  while (std::ssize(nodes) < n) {
    const P x = random.point<3>(unit_box<3>());
    const double d = graded(x);
    if (random.between(0, 1) < std::pow(0.0222 / d, 3)) nodes.push_back({x, d, std::ssize(nodes)});
  }
  return nodes;
}

// Expects exactly those tetrahedra of CGAL that are elements.
void expect_reference(double scale) {
  std::vector<Bubble<3>> nodes = random_nodes(31, 20000);
  for (Bubble<3>& b : nodes) b.d *= scale;
  std::vector<P> places;
  for (const Bubble<3>& b : nodes) places.push_back(b.x);
  Bubbles<3> b;
  b.grow_tree([&](const P& x) { return scale * graded(x); });
  b.set(nodes);
  b.list(1.5);
  const pnpbs::KnownRegion<3> everywhere;
  VolumeStars stars;
  stars.build(volume_tetrahedra::input_of(b, everywhere));
  const std::set<Ids> ours = volume_tetrahedra::mesh_of(b.nodes, stars).tetrahedra;
  std::int64_t elements = 0, others = 0;
  for (const Ids& t : pnpbs_bench::reference_tetrahedra(places)) {
    pnpbs::Tetrahedron corners{};
    for (std::size_t k = 0; k < 4; ++k) {
      const Bubble<3>& node = nodes[static_cast<std::size_t>(t[k])];
      corners[k] = {node.x, node.d, node.id};
    }
    if (!pnpbs::is_element(corners)) {
      ++others;
      continue;
    }
    ++elements;
    quick_assert_msg(ours.count(t) == 1, "a tetrahedron is missing");
  }
  ck_assert_int_eq(elements, std::ssize(ours));
  ck_assert_int_gt(elements, 50000);
  ck_assert_int_gt(others, 100);
}

}  // namespace

START_TEST(graded_nodes) {
  for (const double scale : {0.5, 1.0}) expect_reference(scale);
}
END_TEST

TEST_SUITE(test_volume_reference) { return run_kernel_suite("volume_reference", {graded_nodes}); }
