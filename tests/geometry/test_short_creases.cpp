// SPDX-License-Identifier: BSD-3-Clause
// Tests of which sharp edges count as roughness: graphs of creases, and ridges on sheets against a
// search for sharp edges.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <map>
#include <utility>
#include <vector>

#include "domain/volume/features.hpp"
#include "domain/volume/short_creases.hpp"
#include "run_suite.hpp"
#include "space_shapes.hpp"

using pnpbs::FeatureEdgeCandidate;
using space_shapes::Mesh;
using space_shapes::P;

namespace {

// Edges between nodes on a circle of radius 1. All creases are short compared with the mesh; two
// distant nodes define its extent.
struct Creases {
  std::vector<FeatureEdgeCandidate> edges;

  void path(std::vector<std::int32_t> nodes, bool crease = true) {
    for (std::size_t k = 1; k < nodes.size(); ++k)
      edges.push_back({{nodes[k - 1], nodes[k]}, crease});
  }
  std::vector<char> dropped(double extent = 100) const {
    Mesh mesh;
    for (int k = 0; k < 40; ++k) {
      const double angle = 2 * space_shapes::pi * k / 40;
      mesh.nodes.push_back({{std::cos(angle), std::sin(angle), 0}, 0});
    }
    mesh.nodes.push_back({{0, 0, -extent}, 0});
    mesh.nodes.push_back({{0, 0, extent}, 0});
    return pnpbs::short_creases(mesh, edges);
  }
  std::int64_t count_dropped(double extent = 100) const {
    const std::vector<char> found = dropped(extent);
    return std::count(found.begin(), found.end(), 1);
  }
};

// Returns a sheet of n by 8 unit squares with a ridge along its middle line. Its height over the
// lines beside it is w(x).
template <class Height>
Mesh ridge(int n, const Height& w) {
  space_shapes::Shape sheet = space_shapes::sheet(n, 8, n, 8);
  for (P& x : sheet.nodes) x[2] = -std::fabs(x[1] - 4) * w(x[0]);
  return sheet.mesh();
}

std::int64_t edges_turned_by_more(const Mesh& mesh, double degrees) {
  std::map<std::pair<std::int32_t, std::int32_t>, std::vector<P>> normals;
  for (const pnpbs::BoundaryTriangle& facet : mesh.facets)
    for (std::size_t k = 0; k < 3; ++k)
      normals[std::minmax(facet.nodes[k], facet.nodes[(k + 1) % 3])].push_back(
          pnpbs::facet_normal(mesh, facet));
  return std::count_if(normals.begin(), normals.end(), [&](const auto& edge) {
    const std::vector<P>& sides = edge.second;
    return sides.size() == 2 &&
           pnpbs::dot(sides[0], sides[1]) < std::cos(degrees * space_shapes::pi / 180);
  });
}

std::size_t joined_sides(const pnpbs::Features& features) {
  std::size_t sides = 0;
  for (const auto& across : features.across)
    for (const std::int32_t other : across) sides += other >= 0;
  return sides;
}

// --------------------------------------------------------------------------------- tests -------

START_TEST(test_free_ends) {
  Creases five, six;
  five.path({0, 1, 2, 3, 4, 5});
  ck_assert_int_eq(five.count_dropped(), 5);
  ck_assert_int_eq(five.count_dropped(0.1), 0);  // as long as a good part of the mesh
  six.path({0, 1, 2, 3, 4, 5, 6});
  ck_assert_int_eq(six.count_dropped(), 0);
}
END_TEST

START_TEST(test_rings) {
  Creases five, six, two_facets;
  five.path({0, 1, 2, 3, 4, 0});
  ck_assert_int_eq(five.count_dropped(), 5);
  ck_assert_int_eq(five.count_dropped(0.1), 0);
  six.path({0, 1, 2, 3, 4, 5, 0});
  ck_assert_int_eq(six.count_dropped(), 0);
  two_facets.path({0, 1, 2, 3, 0, 2});
  ck_assert_int_eq(two_facets.count_dropped(), 5);
}
END_TEST

// Spurs do not shorten a long crease. A tree without a long path is dropped completely.
START_TEST(test_branches) {
  Creases comb;
  comb.path({0, 1, 2, 3, 4, 5, 6, 7, 8, 9});
  comb.path({3, 20});
  comb.path({6, 21, 22});
  const std::vector<char> dropped = comb.dropped();
  quick_assert(std::count(dropped.begin(), dropped.begin() + 9, 1) == 0);
  quick_assert(std::count(dropped.begin() + 9, dropped.end(), 1) == 3);

  Creases tree;
  tree.path({0, 1, 2, 3});
  tree.path({5, 6, 1});
  tree.path({7, 2, 8});
  ck_assert_int_eq(tree.count_dropped(), static_cast<std::int64_t>(tree.edges.size()));
}
END_TEST

// Edges due to a tag or a border are never dropped, nor are creases between such edges.
START_TEST(test_other_features) {
  Creases border;
  border.path({0, 1, 2, 3, 4, 0}, false);
  border.path({10, 11}, false);
  border.path({11, 12});  // continues and ends freely
  border.path({0, 20, 2});
  std::vector<char> dropped = border.dropped();
  const std::vector<char> spur{0, 0, 0, 0, 0, 0, 1, 0, 0};
  quick_assert(dropped == spur);
}
END_TEST

// A long ridge that fades out is kept as far as it is sharp; a bump is dropped.
START_TEST(test_ridges) {
  const auto fades = [](double x) { return 0.8 * std::max(0.0, 1 - x / 60); };
  const Mesh dart = ridge(60, fades);
  const pnpbs::Features kept = pnpbs::find_features(dart, 40);
  const std::int64_t sharp = edges_turned_by_more(dart, 40);
  ck_assert_int_gt(sharp, 20);
  ck_assert_int_lt(sharp, 50);
  ck_assert_uint_eq(kept.short_creases.size(), 0);
  std::size_t free_end = 0;
  for (const pnpbs::FeatureCurve& curve : kept.curves)
    if (curve.edge_count() == static_cast<std::size_t>(sharp)) ++free_end;
  ck_assert_uint_eq(free_end, 1);

  const auto bump = [](double x) { return 0.5 * std::max(0.0, 1 - std::fabs(x - 30) / 8); };
  const Mesh bumpy = ridge(60, bump);
  const std::int64_t few = edges_turned_by_more(bumpy, 40);
  ck_assert_int_gt(few, 1);
  ck_assert_int_lt(few, 6);
  const pnpbs::Features rough = pnpbs::find_features(bumpy, 40);
  ck_assert_int_eq(static_cast<std::int64_t>(rough.short_creases.size()), few);
  // Only the border of the sheet is left; all other facet sides are joined.
  const std::size_t border = 2 * (60 + 8);
  std::size_t edges = 0;
  for (const pnpbs::FeatureCurve& curve : rough.curves) edges += curve.edge_count();
  ck_assert_uint_eq(edges, border);
  ck_assert_uint_eq(joined_sides(rough), 3 * bumpy.facets.size() - border);
  for (const auto& [a, b] : rough.short_creases)
    for (const std::int32_t node : {a, b})
      ck_assert(bumpy.nodes[static_cast<std::size_t>(node)].position[1] == 4);

  // The same bump on a coarse mesh is a large part of the whole.
  const Mesh coarse = ridge(12, [](double x) { return 0.5 * (1 - std::fabs(x - 6) / 8); });
  ck_assert_int_gt(edges_turned_by_more(coarse, 40), 1);
  ck_assert_uint_eq(pnpbs::find_features(coarse, 40).short_creases.size(), 0);
}
END_TEST

}  // namespace

TEST_SUITE(test_short_creases) {
  return run_suite("short_creases",
                   {test_free_ends, test_rings, test_branches, test_other_features, test_ridges});
}
