// SPDX-License-Identifier: BSD-3-Clause
// Nodes on feature curves, against integrals of ds/d in closed form.
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <set>
#include <vector>

#include "core/quick_assert.hpp"
#include "domain/volume/feature_nodes.hpp"
#include "expect_error.hpp"
#include "run_suite.hpp"
#include "space_shapes.hpp"

using pnpbs::FeatureCurve;
using pnpbs::FeatureNode;
using pnpbs::FeatureNodes;
using pnpbs::Features;
using space_shapes::Mesh;
using space_shapes::P;

namespace {

constexpr double kAngle = 40;
std::size_t index(std::int32_t i) { return static_cast<std::size_t>(i); }

const P& mesh_node(const Mesh& mesh, std::int32_t node) { return mesh.nodes[index(node)].position; }

// Expects nodes at the corners, and every other node on its edge and once in the list of its curve.
void check_places(const Mesh& mesh, const Features& features, const FeatureNodes& laid) {
  ck_assert_uint_eq(laid.along.size(), features.curves.size());
  std::size_t between = features.corners.size();
  for (std::size_t c = 0; c < features.corners.size(); ++c) {
    const FeatureNode& node = laid.nodes[c];
    quick_assert(node.position == mesh_node(mesh, features.corners[c]));
    quick_assert(node.corner == static_cast<std::int32_t>(c) && node.curve < 0 && node.edge < 0);
  }
  for (std::size_t c = 0; c < features.curves.size(); ++c) {
    const FeatureCurve& curve = features.curves[c];
    const std::vector<std::int32_t>& along = laid.along[c];
    ck_assert_uint_ge(along.size(), curve.closed() ? 4 : 2);
    ck_assert((along.front() == along.back()) == curve.closed());
    quick_assert(pnpbs::distance<3>(laid.nodes[index(along.back())].position,
                                    mesh_node(mesh, curve.nodes.back())) < 1e-15);
    std::int32_t edge = curve.first_edge;
    for (std::size_t n = 0; n + 1 < along.size(); ++n) {
      const FeatureNode& node = laid.nodes[index(along[n])];
      if (node.corner >= 0) {
        quick_assert(n == 0);
        continue;
      }
      quick_assert(along[n] == static_cast<std::int32_t>(between++));
      quick_assert(node.curve == static_cast<std::int32_t>(c) && node.tag == curve.tag);
      quick_assert(node.edge >= edge);
      edge = node.edge;
      const std::size_t k = index(edge - curve.first_edge);
      const P &a = mesh_node(mesh, curve.nodes[k]), &b = mesh_node(mesh, curve.nodes[k + 1]);
      const double ways =
          pnpbs::distance<3>(a, node.position) + pnpbs::distance<3>(node.position, b);
      quick_assert(std::fabs(ways - pnpbs::distance<3>(a, b)) < 1e-14);
    }
  }
  ck_assert_uint_eq(between, laid.nodes.size());
}

START_TEST(test_cube_has_equal_steps) {
  const Mesh mesh = space_shapes::cube(3).mesh(4);
  const Features features = pnpbs::find_features(mesh, kAngle);
  const FeatureNodes laid = place_feature_nodes(mesh, features, space_shapes::constant(0.099));
  check_places(mesh, features, laid);
  ck_assert_uint_eq(laid.nodes.size(), 8 + 12 * 9);
  for (const std::vector<std::int32_t>& along : laid.along)
    for (std::size_t n = 0; n + 1 < along.size(); ++n)
      ck_assert_double_eq_tol(pnpbs::distance<3>(laid.nodes[index(along[n])].position,
                                                 laid.nodes[index(along[n + 1])].position),
                              0.1, 1e-13);
  for (const FeatureNode& node : laid.nodes) ck_assert_int_eq(node.tag, 4);
}
END_TEST

// d = 0.02 + 0.1 x along the x axis: the integral from 0 to x is ln(1 + 5 x) / 0.1.
START_TEST(test_varying_spacing) {
  const Mesh mesh = space_shapes::cube(1).mesh();
  const Features features = pnpbs::find_features(mesh, kAngle);
  const FeatureNodes laid = place_feature_nodes(
      mesh, features, space_shapes::evaluator_of([](const P& x) { return 0.02 + 0.1 * x[0]; }));
  check_places(mesh, features, laid);
  const auto integral = [](double x) { return std::log1p(5 * x) / 0.1; };
  const double whole = integral(1);
  for (std::size_t c = 0; c < features.curves.size(); ++c) {
    const FeatureCurve& curve = features.curves[c];
    const double ends[2] = {mesh_node(mesh, curve.nodes.front())[0],
                            mesh_node(mesh, curve.nodes.back())[0]};
    if (ends[0] == ends[1]) continue;
    const std::vector<std::int32_t>& along = laid.along[c];
    const double steps = static_cast<double>(along.size()) - 1;
    ck_assert_double_eq(steps, std::round(whole));
    for (std::size_t n = 0; n < along.size(); ++n) {
      const double done = static_cast<double>(n) * whole / steps;
      const double x = laid.nodes[index(along[n])].position[0];
      ck_assert_double_eq_tol(integral(x), ends[0] < ends[1] ? done : whole - done, 1e-6);
    }
  }
}
END_TEST

// Closed curves have at least three nodes, with or without a corner.
START_TEST(test_large_spacing) {
  const Mesh mesh = space_shapes::cylinder(24, 4, 2).mesh();
  const Features features = pnpbs::find_features(mesh, kAngle);
  const FeatureNodes laid = place_feature_nodes(mesh, features, space_shapes::constant(50));
  check_places(mesh, features, laid);
  ck_assert_uint_eq(laid.nodes.size(), 6);

  // A drop: an arc that begins and ends at its only corner.
  space_shapes::Shape drop;
  const std::int32_t middle = drop.node({0, 0, 0}), tip = drop.node({2, 0, 0});
  constexpr int kArc = 20;
  for (int i = 0; i <= kArc; ++i) {
    const double angle = space_shapes::pi * (1.0 / 3 + 4.0 / 3 * i / kArc);
    drop.node({std::cos(angle), std::sin(angle), 0});
  }
  for (std::int32_t i = 0; i < kArc; ++i)
    drop.triangles.push_back({middle, tip + 1 + i, tip + 2 + i});
  drop.triangles.push_back({middle, tip, tip + 1});
  drop.triangles.push_back({middle, tip + 1 + kArc, tip});
  const Mesh flat = drop.mesh();
  const Features loop = pnpbs::find_features(flat, kAngle);
  ck_assert_uint_eq(loop.corners.size(), 1);
  ck_assert_uint_eq(loop.curves.size(), 1);
  for (const double d : {50.0, 0.1}) {
    const FeatureNodes around = place_feature_nodes(flat, loop, space_shapes::constant(d));
    check_places(flat, loop, around);
    double length = 0;
    for (std::size_t e = 0; e < loop.curves[0].edge_count(); ++e)
      length += pnpbs::distance<3>(mesh_node(flat, loop.curves[0].nodes[e]),
                                   mesh_node(flat, loop.curves[0].nodes[e + 1]));
    ck_assert_uint_eq(around.nodes.size(),
                      static_cast<std::size_t>(std::max(3.0, std::round(length / d))));
  }
}
END_TEST

START_TEST(test_too_many) {
  const Mesh mesh = space_shapes::cube(1).mesh();
  const Features features = pnpbs::find_features(mesh, kAngle);
  expect_error(pnpbs::ErrorKind::spacing, {"would mean about 68434 nodes", "max_nodes allows 1000"},
               [&] { place_feature_nodes(mesh, features, space_shapes::constant(0.01), 1000); });
}
END_TEST

}  // namespace

TEST_SUITE(test_feature_nodes) {
  return run_suite("feature_nodes", {test_cube_has_equal_steps, test_varying_spacing,
                                     test_large_spacing, test_too_many});
}
