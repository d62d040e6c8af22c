// SPDX-License-Identifier: BSD-3-Clause
// Features of surfaces: known counts for simple shapes, and a search over all pairs of triangles.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <map>
#include <set>
#include <utility>
#include <vector>

#include "domain/volume/features.hpp"
#include "run_suite.hpp"
#include "space_shapes.hpp"

using pnpbs::FeatureCurve;
using pnpbs::Features;
using space_shapes::Mesh;
using space_shapes::P;

namespace {

constexpr double kAngle = 40;
using Edge = std::pair<std::int32_t, std::int32_t>;

std::size_t index(std::int32_t i) { return static_cast<std::size_t>(i); }

// ------------------------------------------------------------------ a slow reference -----------

std::map<Edge, std::vector<std::size_t>> facets_of_edges(const Mesh& mesh) {
  std::map<Edge, std::vector<std::size_t>> facets;
  for (std::size_t f = 0; f < mesh.facets.size(); ++f)
    for (std::size_t k = 0; k < 3; ++k)
      facets[std::minmax(mesh.facets[f].nodes[k], mesh.facets[f].nodes[(k + 1) % 3])].push_back(f);
  return facets;
}

double angle_between(const Mesh& mesh, std::size_t f, std::size_t g) {
  P normals[2];
  for (const std::size_t side : {0, 1}) {
    const auto [a, b, c] = corners_of(mesh, mesh.facets[side == 0 ? f : g]);
    const double u[3] = {b[0] - a[0], b[1] - a[1], b[2] - a[2]};
    const double v[3] = {c[0] - a[0], c[1] - a[1], c[2] - a[2]};
    normals[side] = {u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2],
                     u[0] * v[1] - u[1] * v[0]};
  }
  const P turn = pnpbs::cross(normals[0], normals[1]);
  return std::atan2(std::hypot(turn[0], turn[1], turn[2]), pnpbs::dot(normals[0], normals[1])) *
         180 / space_shapes::pi;
}

std::set<Edge> feature_edges_by_search(const Mesh& mesh) {
  std::set<Edge> edges;
  for (const auto& [edge, facets] : facets_of_edges(mesh)) {
    const bool smooth = facets.size() == 2 &&
                        mesh.facets[facets[0]].tag == mesh.facets[facets[1]].tag &&
                        angle_between(mesh, facets[0], facets[1]) <= kAngle;
    if (!smooth) edges.insert(edge);
  }
  return edges;
}

// Returns for each facet the facet with the smallest index in its patch.
std::vector<std::size_t> patches_by_search(const Mesh& mesh, const std::set<Edge>& features) {
  std::vector<std::size_t> least(mesh.facets.size());
  for (std::size_t f = 0; f < least.size(); ++f) least[f] = f;
  const auto edges = facets_of_edges(mesh);
  for (bool changed = true; changed;) {
    changed = false;
    for (const auto& [edge, facets] : edges) {
      if (features.contains(edge)) continue;
      const std::size_t both = std::min(least[facets[0]], least[facets[1]]);
      changed = changed || least[facets[0]] != both || least[facets[1]] != both;
      least[facets[0]] = least[facets[1]] = both;
    }
  }
  return least;
}

void check_against_search(const Mesh& mesh, const Features& found) {
  const std::set<Edge> features = feature_edges_by_search(mesh);
  const auto all = facets_of_edges(mesh);
  std::set<Edge> seen;
  std::map<std::int32_t, int> ends;
  std::int32_t edges = 0;
  for (const FeatureCurve& curve : found.curves) {
    ck_assert_int_eq(curve.first_edge, edges);
    edges += static_cast<std::int32_t>(curve.edge_count());
    for (std::size_t e = 0; e < curve.edge_count(); ++e) {
      const Edge edge = std::minmax(curve.nodes[e], curve.nodes[e + 1]);
      quick_assert(features.contains(edge) && seen.insert(edge).second);
      const std::vector<std::size_t>& facets = all.at(edge);
      quick_assert(std::equal(facets.begin(), facets.end(), curve.facets[e].begin(),
                              curve.facets[e].end(),
                              [](std::size_t f, std::int32_t g) { return f == index(g); }));
      if (e > 0) quick_assert(!found.is_corner(curve.nodes[e]));
    }
    quick_assert(curve.closed() || found.is_corner(curve.nodes.front()));
    quick_assert(found.is_corner(curve.nodes.front()) == found.is_corner(curve.nodes.back()));
  }
  ck_assert_uint_eq(seen.size(), features.size());

  const std::vector<std::size_t> least = patches_by_search(mesh, features);
  std::set<std::size_t> patches(least.begin(), least.end());
  ck_assert_int_eq(found.patches, static_cast<std::int32_t>(patches.size()));
  std::map<std::size_t, std::int32_t> number;
  for (std::size_t f = 0; f < least.size(); ++f)
    quick_assert(number.try_emplace(least[f], found.patch[f]).first->second == found.patch[f]);
  for (std::size_t f = 0; f < least.size(); ++f)
    for (std::size_t k = 0; k < 3; ++k) {
      const Edge edge = std::minmax(mesh.facets[f].nodes[k], mesh.facets[f].nodes[(k + 1) % 3]);
      const std::vector<std::size_t>& facets = all.at(edge);
      const std::int32_t across = found.across[f][k];
      quick_assert((across < 0) == features.contains(edge));
      if (across >= 0) quick_assert(facets[facets[0] == f ? 1 : 0] == index(across));
    }
}

Features checked_features(const Mesh& mesh) {
  const Features found = pnpbs::find_features(mesh, kAngle);
  check_against_search(mesh, found);
  return found;
}

// --------------------------------------------------------------------------------- tests -------

START_TEST(test_cube) {
  for (const std::int64_t n : {1, 3}) {
    const Mesh mesh = space_shapes::turned(space_shapes::cube(n), 0.4).mesh();
    const Features found = checked_features(mesh);
    ck_assert_uint_eq(found.curves.size(), 12);
    ck_assert_uint_eq(found.corners.size(), 8);
    ck_assert_int_eq(found.patches, 6);
    for (const FeatureCurve& curve : found.curves) {
      ck_assert_uint_eq(curve.edge_count(), static_cast<std::size_t>(n));
      ck_assert_int_eq(curve.tag, 1);
      ck_assert(!curve.closed());
    }
    for (std::int32_t node = 0; node < static_cast<std::int32_t>(mesh.nodes.size()); ++node) {
      const std::size_t patches = found.patches_at[index(node)].size();
      ck_assert(found.is_corner(node) ? patches == 3 : patches == 0 || patches == 2);
    }
  }
}
END_TEST

START_TEST(test_cylinder) {
  const Features found = checked_features(space_shapes::cylinder(40, 6, 2).mesh());
  ck_assert_uint_eq(found.curves.size(), 2);
  ck_assert_uint_eq(found.corners.size(), 0);
  ck_assert_int_eq(found.patches, 3);
  for (const FeatureCurve& curve : found.curves) {
    ck_assert(curve.closed());
    ck_assert_uint_eq(curve.edge_count(), 40);
  }
}
END_TEST

START_TEST(test_ball_has_none) {
  const Features found = checked_features(space_shapes::ball(2).mesh());
  ck_assert_uint_eq(found.curves.size(), 0);
  ck_assert_uint_eq(found.corners.size(), 0);
  ck_assert_int_eq(found.patches, 1);
}
END_TEST

// A sheet with a border, and a single facet.
START_TEST(test_open_sheets) {
  const Features sheet = checked_features(space_shapes::sheet(5, 4, 1, 1).mesh());
  ck_assert_uint_eq(sheet.curves.size(), 4);
  ck_assert_uint_eq(sheet.corners.size(), 4);
  ck_assert_int_eq(sheet.patches, 1);

  space_shapes::Shape one;
  one.nodes = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
  one.triangles = {{0, 1, 2}};
  const Features triangle = checked_features(one.mesh(7));
  ck_assert_uint_eq(triangle.curves.size(), 3);
  ck_assert_uint_eq(triangle.corners.size(), 3);
  ck_assert_int_eq(triangle.patches, 1);
  ck_assert_int_eq(triangle.curves[0].tag, 7);

  ck_assert_int_eq(pnpbs::find_features(Mesh(), kAngle).patches, 0);
}
END_TEST

// Two tags on a sphere: their border zigzags along triangle edges and has corners. A straight
// border has none.
START_TEST(test_tags) {
  const Mesh oblique =
      space_shapes::ball(3).mesh([](const P& x) { return x[0] + 0.3 * x[1] > 0.2 ? 1 : 2; });
  ck_assert_int_eq(checked_features(oblique).patches, 2);

  const Mesh along =
      space_shapes::cylinder(40, 6, 2).mesh([](const P& x) { return x[2] > 1 ? 5 : 4; });
  const Features found = checked_features(along);
  ck_assert_int_eq(found.patches, 4);
  ck_assert_uint_eq(found.curves.size(), 3);
  ck_assert_uint_eq(found.corners.size(), 0);
}
END_TEST

// Three sheets that meet in a line, and shapes of many cubes that touch along edges.
START_TEST(test_more_than_two_facets_at_an_edge) {
  space_shapes::Shape book;
  book.nodes = {{0, 0, 0}, {0, 0, 1}, {1, 0, 0}, {-1, 1, 0}, {-1, -1, 0}};
  book.triangles = {{0, 2, 1}, {0, 1, 3}, {1, 0, 4}};
  const Features found = checked_features(book.mesh());
  ck_assert_int_eq(found.patches, 3);
  ck_assert_uint_eq(found.curves.size(), 7);
  ck_assert_uint_eq(found.corners.size(), 5);

  check_against_search(
      space_shapes::shape_of(surfaces::sheared(surfaces::pierced_cube())).mesh(),
      pnpbs::find_features(
          space_shapes::shape_of(surfaces::sheared(surfaces::pierced_cube())).mesh(), kAngle));
  const surfaces::Surface checkers = surfaces::cubes(
      4, [](std::int64_t i, std::int64_t j, std::int64_t k) { return (i + j + k) % 2 == 0; });
  checked_features(space_shapes::shape_of(checkers).mesh());
}
END_TEST

// An inner curve on a surface and one that leaves it; a fixed node on a surface and one off it.
START_TEST(test_inner_curves_and_fixed_nodes) {
  Mesh mesh = space_shapes::ball(2).mesh();
  const std::int32_t a = mesh.facets[0].nodes[0], b = mesh.facets[0].nodes[1];
  const auto far = static_cast<std::int32_t>(mesh.nodes.size());
  mesh.nodes.push_back({{3, 3, 3}, 0});
  mesh.nodes.push_back({{4, 4, 4}, 0});
  const std::int32_t fixed = mesh.facets[100].nodes[0];
  mesh.facets.push_back({{a, b, b}, 8, true, true});
  mesh.facets.push_back({{b, far, far}, 8, true, true});
  mesh.facets.push_back({{fixed, fixed, fixed}, 9, true, true});
  mesh.facets.push_back({{far + 1, far + 1, far + 1}, 9, true, true});
  const Features found = pnpbs::find_features(mesh, kAngle);
  ck_assert_int_eq(found.patches, 1);
  ck_assert_uint_eq(found.curves.size(), 2);
  for (const FeatureCurve& curve : found.curves) {
    ck_assert_int_eq(curve.tag, 8);
    ck_assert_uint_eq(curve.edge_count(), 1);
  }
  const std::set<std::int32_t> corners(found.corners.begin(), found.corners.end());
  quick_assert(corners == std::set<std::int32_t>{a, b, far, far + 1, fixed});
  ck_assert_uint_eq(found.patches_at[index(fixed)].size(), 1);
  ck_assert_uint_eq(found.patches_at[index(far)].size(), 0);
  ck_assert_int_eq(found.across[0][0], -1);
  ck_assert_int_ge(found.across[0][1], 0);
}
END_TEST

}  // namespace

TEST_SUITE(test_features) {
  return run_suite("features",
                   {test_cube, test_cylinder, test_ball_has_none, test_open_sheets, test_tags,
                    test_more_than_two_facets_at_an_edge, test_inner_curves_and_fixed_nodes});
}
