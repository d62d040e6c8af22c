// SPDX-License-Identifier: BSD-3-Clause
// Queries of a surface about its points: sides, visibility, and distances to features.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <set>
#include <vector>

#include "core/quick_assert.hpp"
#include "core/random.hpp"
#include "domain/volume/feature_nodes.hpp"
#include "geometry/volume/triangles.hpp"
#include "run_suite.hpp"
#include "surface_case.hpp"

using pnpbs::FeatureNode;
using pnpbs::FeatureNodes;
using pnpbs::Surface;
using pnpbs::SurfaceSide;
using pnpbs::SurfaceSupport;
using space_shapes::Mesh;
using space_shapes::P;
using space_shapes::SurfaceCase;
using On = pnpbs::SurfaceSupport::On;

namespace {

std::size_t index(std::int32_t i) { return static_cast<std::size_t>(i); }

SurfaceSupport place_of(const FeatureNode& node) {
  return node.corner >= 0 ? SurfaceSupport{On::corner, node.corner}
                          : SurfaceSupport{On::edge, node.edge};
}

std::vector<SurfaceSide> sides_of(const Surface& surface, const SurfaceSupport& place) {
  std::vector<SurfaceSide> sides;
  surface.for_sides(place, [&](const SurfaceSide& side) { sides.push_back(side); });
  return sides;
}

bool is_on_patch(const SurfaceCase& c, std::int32_t patch, const P& x) {
  for (std::int32_t f = 0; f < c.facet_count(); ++f)
    if (c.surface.patch(f) == patch &&
        pnpbs::distance<3>(pnpbs::nearest_on(c.surface.corners(f), x), x) < 1e-9)
      return true;
  return false;
}

// Expects that around the node, the patch lies between the begin and the end of the side and not
// beyond.
void check_sides(const SurfaceCase& c, const FeatureNodes& laid) {
  for (std::size_t n = 0; n < laid.nodes.size(); ++n) {
    const P x = laid.nodes[n].position;
    for (const SurfaceSide& side : sides_of(c.surface, place_of(laid.nodes[n]))) {
      const auto node = static_cast<std::int32_t>(n);
      P ways[2];
      const pnpbs::CurveDirection ends[2] = {side.begin, side.end};
      for (const int k : {0, 1})
        ways[k] = pnpbs::unit_vector(
            pnpbs::difference(laid.nodes[index(laid.next(node, ends[k]))].position, x));
      quick_assert(std::fabs(pnpbs::dot(ways[0], side.normal)) < 1e-12);
      const P left = pnpbs::cross(side.normal, ways[0]);
      double opening = std::atan2(pnpbs::dot(ways[1], left), pnpbs::dot(ways[1], ways[0]));
      if (opening < 1e-9) opening += 2 * space_shapes::pi;
      for (double angle = space_shapes::pi / 8; angle < 2 * space_shapes::pi;
           angle += space_shapes::pi / 4) {
        const P way =
            pnpbs::shifted(pnpbs::shifted({}, std::cos(angle), ways[0]), std::sin(angle), left);
        quick_assert(is_on_patch(c, side.patch, pnpbs::shifted(x, 0.3, way)) == (angle < opening));
      }
    }
  }
}

START_TEST(test_sides_of_features) {
  const surfaces::Surface stairs = surfaces::cubes(
      3, [](std::int64_t i, std::int64_t j, std::int64_t k) { return i + j + k < 3; });
  const SurfaceCase c(space_shapes::turned(space_shapes::shape_of(stairs), 0.8).mesh());
  const FeatureNodes laid = place_feature_nodes(c.mesh, c.features, space_shapes::constant(2.5));
  check_sides(c, laid);
  std::size_t reentrant = 0;
  for (const FeatureNode& node : laid.nodes) {
    const std::vector<SurfaceSide> sides = sides_of(c.surface, place_of(node));
    ck_assert_uint_eq(sides.size(), node.corner >= 0 ? sides.size() : 2);
    std::set<std::int32_t> patches;
    for (const SurfaceSide& side : sides) patches.insert(side.patch);
    if (node.corner < 0) continue;
    const std::int32_t at = c.features.corners[index(node.corner)];
    const std::vector<std::int32_t>& expected = c.features.patches_at[index(at)];
    quick_assert(std::equal(patches.begin(), patches.end(), expected.begin(), expected.end()));
    reentrant += sides.size() > 3;
  }
  ck_assert_uint_gt(reentrant, 0);
}
END_TEST

START_TEST(test_flat_patches_have_one_normal) {
  const SurfaceCase c(space_shapes::turned(space_shapes::cube(4), 1.1).mesh());
  for (std::int32_t f = 0; f < c.facet_count(); ++f) {
    quick_assert(c.surface.is_flat(c.surface.patch(f)));
    quick_assert(c.surface.normal(f) == c.surface.normal(static_cast<std::int32_t>(
                                            std::find(c.features.patch.begin(),
                                                      c.features.patch.end(), c.surface.patch(f)) -
                                            c.features.patch.begin())));
    quick_assert(pnpbs::distance<3>(c.surface.normal(f),
                                    facet_normal(c.mesh, c.mesh.facets[index(f)])) < 1e-12);
  }
  const SurfaceCase ball(space_shapes::ball(3).mesh());
  ck_assert(!ball.surface.is_flat(0));
}
END_TEST

// The unit cube, and points on it with the sides that contain them.
struct PlacesOnCube {
  SurfaceCase c{space_shapes::cube(2).mesh()};
  std::vector<std::pair<SurfaceSupport, std::set<int>>> places;

  PlacesOnCube() {
    const FeatureNodes laid = place_feature_nodes(c.mesh, c.features, space_shapes::constant(0.5));
    for (std::int32_t f = 0; f < c.facet_count(); ++f)
      places.push_back({{On::facet, f}, sides(c.centre(f).position)});
    for (const FeatureNode& node : laid.nodes)
      places.push_back({place_of(node), sides(node.position)});
  }
  static std::set<int> sides(const P& x) {
    std::set<int> on;
    for (int k = 0; k < 3; ++k)
      for (const int side : {0, 1})
        if (std::fabs(x[static_cast<std::size_t>(k)] - side) < 1e-12) on.insert(2 * k + side);
    return on;
  }
};

START_TEST(test_sees_on_a_cube) {
  const PlacesOnCube cube;
  for (const auto& [a, on_a] : cube.places)
    for (const auto& [b, on_b] : cube.places) {
      const bool share = std::any_of(
          on_a.begin(), on_a.end(), [&b_sides = on_b](int side) { return b_sides.contains(side); });
      quick_assert(cube.c.surface.sees(a, b) == share);
    }
}
END_TEST

// At a corner, any two of four nodes can share a side although no side contains all of them.
START_TEST(test_shares_a_patch_on_a_cube) {
  const PlacesOnCube cube;
  const Surface& surface = cube.c.surface;
  Random random(1);
  int shared = 0, only_in_pairs = 0;
  for (int trial = 0; trial < 400000; ++trial) {
    std::array<SurfaceSupport, 4> places;
    std::set<int> common{0, 1, 2, 3, 4, 5};
    for (SurfaceSupport& place : places) {
      const auto& [at, on] =
          cube.places[static_cast<std::size_t>(random.below(std::ssize(cube.places)))];
      place = at;
      std::erase_if(common, [&sides = on](int side) { return !sides.contains(side); });
    }
    quick_assert(surface.share_patch(places) == !common.empty());
    shared += !common.empty();
    const bool in_pairs = std::all_of(places.begin(), places.end(), [&](const SurfaceSupport& a) {
      return std::all_of(places.begin(), places.end(),
                         [&](const SurfaceSupport& b) { return surface.sees(a, b); });
    });
    only_in_pairs += in_pairs && common.empty();
  }
  ck_assert_int_gt(shared, 100);
  ck_assert_int_gt(only_in_pairs, 100);
}
END_TEST

// An ellipsoid with two halves close to each other: visible points are on the same half.
START_TEST(test_sees_around_a_thin_body) {
  space_shapes::Shape shape = space_shapes::ball(4);
  for (P& x : shape.nodes) x[2] *= 0.3;
  const SurfaceCase c(shape.mesh());
  ck_assert_int_eq(c.features.patches, 1);
  int apart = 0;
  for (std::int32_t f = 0; f < c.facet_count(); f += 7)
    for (std::int32_t g = 0; g < c.facet_count(); g += 5) {
      const P x = c.centre(f).position, y = c.centre(g).position;
      const P p{x[0], x[1], x[2] / 0.09}, q{y[0], y[1], y[2] / 0.09};  // along the normals
      const double cosine = pnpbs::dot(pnpbs::unit_vector(p), pnpbs::unit_vector(q));
      if (std::fabs(cosine) < 0.1) continue;
      quick_assert(c.surface.sees({On::facet, f}, {On::facet, g}) == (cosine > 0));
      apart += cosine < 0 && pnpbs::distance<3>(x, y) < 0.5;
    }
  ck_assert_int_gt(apart, 100);
}
END_TEST

START_TEST(test_feature_clearance) {
  Mesh mesh = space_shapes::turned(space_shapes::cylinder(30, 5, 0.3), 0.7).mesh();
  const std::int32_t fixed = mesh.facets[40].nodes[0];
  mesh.facets.push_back({{fixed, fixed, fixed}, 2, true, true});
  const SurfaceCase c(mesh);
  int near = 0, far = 0;
  for (std::int32_t f = 0; f + 1 < c.facet_count(); ++f) {
    const pnpbs::SurfacePoint at = c.centre(f);
    double min = 0.1;
    const auto include = [&](const P& a, const P& b) {
      for (int k = 0; k <= 1000; ++k) {
        const P x = pnpbs::shifted(a, k / 1000.0, pnpbs::difference(b, a));
        min = std::min(min, pnpbs::distance<3>(x, at.position));
      }
    };
    for (const pnpbs::FeatureCurve& curve : c.features.curves)
      for (std::size_t e = 0; e < curve.edge_count(); ++e) {
        const bool own =
            std::any_of(curve.facets[e].begin(), curve.facets[e].end(),
                        [&](std::int32_t g) { return c.surface.patch(g) == c.surface.patch(f); });
        if (own)
          include(c.mesh.nodes[index(curve.nodes[e])].position,
                  c.mesh.nodes[index(curve.nodes[e + 1])].position);
      }
    const std::vector<std::int32_t>& patches = c.features.patches_at[index(fixed)];
    if (std::find(patches.begin(), patches.end(), c.surface.patch(f)) != patches.end()) {
      const P& x = c.mesh.nodes[index(fixed)].position;
      include(x, x);
    }
    const double gap = c.surface.feature_clearance(at, 0.1);
    ck_assert_double_le(gap, min + 1e-14);
    ck_assert_double_gt(gap, min - 1e-4);
    ++(min < 0.1 ? near : far);
  }
  ck_assert_int_gt(near, 20);
  ck_assert_int_gt(far, 20);
}
END_TEST

}  // namespace

TEST_SUITE(test_surface) {
  return run_suite("surface", {test_sides_of_features, test_flat_patches_have_one_normal,
                               test_sees_on_a_cube, test_shares_a_patch_on_a_cube,
                               test_sees_around_a_thin_body, test_feature_clearance});
}
