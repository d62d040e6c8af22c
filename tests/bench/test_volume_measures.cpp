// SPDX-License-Identifier: BSD-3-Clause
// Tests the evaluation of nodes in space, on lattices and tetrahedra with known measures.
#include <cmath>
#include <random>

#include "geometry/run_suite.hpp"
#include "volume_bodies.h"
#include "volume_measures.hpp"

using pnpbs_bench::BodyMesh;
using pnpbs_bench::Place;
using pnpbs_bench::VolumeVerdict;

namespace {

constexpr double kDegrees = 180 / 3.14159265358979323846;
// Quality of the tetrahedra of the body-centred cubic lattice.
const double kCubicQuality = 3 / std::sqrt(10.0);

// Returns corners and centres of unit cells from 0 to `cells`.
std::vector<Place> body_centred(int cells, double size = 1) {
  std::vector<Place> nodes;
  for (int half : {0, 1})
    for (int i = 0; i <= cells - half; ++i)
      for (int j = 0; j <= cells - half; ++j)
        for (int k = 0; k <= cells - half; ++k)
          nodes.push_back(
              {size * (i + 0.5 * half), size * (j + 0.5 * half), size * (k + 0.5 * half)});
  return nodes;
}

pnpbs_bench::Inside box_between(double low, double high) {
  return [low, high](const Place& x) {
    for (const double along : x)
      if (along < low || along > high) return false;
    return true;
  };
}

// Rotates about two axes by angles unrelated to lattices.
Place turned(const Place& x) {
  const Place y{std::cos(0.7) * x[0] - std::sin(0.7) * x[1],
                std::sin(0.7) * x[0] + std::cos(0.7) * x[1], x[2]};
  return {y[0], std::cos(0.4) * y[1] - std::sin(0.4) * y[2],
          std::sin(0.4) * y[1] + std::cos(0.4) * y[2]};
}
Place turned_back(const Place& x) {
  const Place y{x[0], std::cos(0.4) * x[1] + std::sin(0.4) * x[2],
                std::cos(0.4) * x[2] - std::sin(0.4) * x[1]};
  return {std::cos(0.7) * y[0] + std::sin(0.7) * y[1], std::cos(0.7) * y[1] - std::sin(0.7) * y[0],
          y[2]};
}

}  // namespace

START_TEST(regular_tetrahedron) {
  const auto shape = pnpbs_bench::shape_of({{{1, 1, 1}, {-1, -1, 1}, {1, -1, -1}, {-1, 1, -1}}});
  ck_assert_double_eq_tol(shape.quality, 1, 1e-14);
  ck_assert_double_eq_tol(shape.angle, std::acos(1.0 / 3) * kDegrees, 1e-12);
}
END_TEST

// A square whose corners are alternately raised and lowered by h. The faces at its sides meet at an
// angle with the cosine 1 / (1 + 4 h^2).
START_TEST(sliver) {
  for (const double angle : {0.1, 5.0, 15.0, 25.0}) {
    const double h = 0.5 * std::sqrt(1 / std::cos(angle / kDegrees) - 1);
    const std::vector<Place> x{{1, 0, h}, {-1, 0, h}, {0, 1, -h}, {0, -1, -h}};
    const auto shape = pnpbs_bench::shape_of({x[0], x[1], x[2], x[3]});
    ck_assert_double_eq_tol(shape.angle, angle, 1e-9);
    const double volume = 4 * h / 3, surface = 4 * std::sqrt(1 + 4 * h * h);
    ck_assert_double_eq_tol(shape.quality, 9 * volume / (surface * std::sqrt(1 + h * h)), 1e-9);
    const VolumeVerdict v =
        pnpbs_bench::evaluate(x, {1, 1, 1, 1}, {0, 0, 0, 0}, {{{0, 1, 2, 3}}, {}});
    ck_assert_int_eq(v.all.below_10, angle < 10);
    ck_assert_int_eq(v.all.below_20, angle < 20);
    ck_assert_double_eq_tol(v.all.angle_min, angle, 1e-9);
    ck_assert_double_eq_tol(v.volume, volume, 1e-14);
    for (const double along : v.all.angle_min_at) ck_assert_double_eq_tol(along, 0, 1e-15);
  }
}
END_TEST

START_TEST(flat_tetrahedron) {
  const auto shape = pnpbs_bench::shape_of({{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}}});
  ck_assert_double_eq(shape.quality, 0);
  ck_assert_double_eq(shape.angle, 0);
}
END_TEST

START_TEST(body_centred_lattice) {
  const std::vector<Place> x = body_centred(8);
  const std::vector<char> on_boundary(x.size(), 0);
  // The bounding planes contain no centroid, as those lie at multiples of 1/8.
  const BodyMesh mesh = pnpbs_bench::reference_mesh(x, on_boundary, box_between(2.01, 6.01));
  const VolumeVerdict v =
      pnpbs_bench::evaluate(x, std::vector<double>(x.size(), 0.5), on_boundary, mesh);
  ck_assert_int_eq(v.all.tetrahedra, 12 * 4 * 4 * 4);
  ck_assert_double_eq_tol(v.volume, 4 * 4 * 4, 1e-9);
  ck_assert_double_eq_tol(v.all.quality_mean, kCubicQuality, 1e-12);
  ck_assert_double_eq_tol(v.all.quality_one_percent, kCubicQuality, 1e-12);
  ck_assert_double_eq_tol(v.all.quality_min, kCubicQuality, 1e-12);
  ck_assert_double_eq_tol(v.all.angle_min, 60, 1e-12);
  ck_assert_int_eq(v.all.below_20, 0);
  ck_assert_int_eq(v.inside.tetrahedra, v.all.tetrahedra);
  ck_assert_int_eq(v.at_boundary.tetrahedra, 0);
  // All edges have length 1 or sqrt(3) / 2; d is 1/2.
  const double n = static_cast<double>(v.edges.edges),
               share = (v.edges.mean - std::sqrt(3.0)) / (2 - std::sqrt(3.0));
  ck_assert_double_eq_tol(share * n, std::round(share * n), 1e-6);
  ck_assert_double_eq_tol(v.edges.deviation, std::sqrt(share * (1 - share)) * (2 - std::sqrt(3.0)),
                          1e-9);
  ck_assert_int_eq(std::ssize(v.octaves), 1);
}
END_TEST

// Every face of a cell is cut into two triangles with corners on the boundary, and the pyramids
// above it in two. With exact nodes of the box nothing is flat, so nothing is peeled off.
START_TEST(box) {
  const std::vector<Place> x = body_centred(4);
  std::vector<char> on_boundary;
  for (const Place& p : x) on_boundary.push_back(!box_between(0.1, 3.9)(p));
  const BodyMesh mesh = pnpbs_bench::reference_mesh(x, on_boundary, box_between(0, 4));
  const VolumeVerdict v =
      pnpbs_bench::evaluate(x, std::vector<double>(x.size(), 1), on_boundary, mesh);
  ck_assert_double_eq_tol(v.volume, 64, 1e-12);
  ck_assert_int_eq(v.surface.triangles, 6 * 16 * 2);
  ck_assert_double_eq_tol(v.surface.quality_mean, 2 * std::sqrt(2.0) - 2, 1e-12);
  ck_assert_double_eq_tol(v.surface.angle_mean, 45, 1e-12);
  ck_assert_double_eq_tol(v.surface.angle_min, 45, 1e-12);
  ck_assert_int_eq(v.boundary_edges.edges, 6 * 16 * 3);
  ck_assert_int_eq(v.all.tetrahedra, v.inside.tetrahedra + v.at_boundary.tetrahedra);
  ck_assert_int_gt(v.at_boundary.tetrahedra, v.surface.triangles);
}
END_TEST

// The nodes of the faces of a rotated box lie in them up to rounding. So there are tetrahedra
// between them that are not part of the box.
START_TEST(flat_ones_at_the_boundary_are_peeled_off) {
  std::vector<Place> x = body_centred(4);
  std::vector<char> on_boundary;
  for (Place& p : x) {
    on_boundary.push_back(!box_between(0.1, 3.9)(p));
    p = turned(p);
  }
  const auto inside = [](const Place& p) { return box_between(-1e-9, 4 + 1e-9)(turned_back(p)); };
  const std::vector<double> d(x.size(), 1);
  const BodyMesh whole = pnpbs_bench::reference_mesh(x, std::vector<char>(x.size(), 0), inside);
  ck_assert_double_lt(pnpbs_bench::evaluate(x, d, on_boundary, whole).all.angle_min, 1e-3);
  const BodyMesh mesh = pnpbs_bench::reference_mesh(x, on_boundary, inside);
  const VolumeVerdict v = pnpbs_bench::evaluate(x, d, on_boundary, mesh);
  ck_assert_double_eq_tol(v.all.angle_min, 45, 1e-9);
  ck_assert_double_eq_tol(v.volume, 64, 1e-9);
  ck_assert_int_eq(v.surface.triangles, 6 * 16 * 2);
}
END_TEST

// d is an eighth in one half of a lattice: octaves and worst locations show what the mean hides.
START_TEST(edges_by_place) {
  const std::vector<Place> x = body_centred(10);
  const std::vector<char> on_boundary(x.size(), 0);
  std::vector<double> d;
  for (const Place& p : x) d.push_back(p[0] < 5.2 ? 0.125 : 1);
  const BodyMesh mesh = pnpbs_bench::reference_mesh(x, on_boundary, box_between(0, 10));
  const VolumeVerdict v = pnpbs_bench::evaluate(x, d, on_boundary, mesh);
  ck_assert_int_eq(std::ssize(v.octaves), 2);  // edges between the halves are in the last octave
  const double mean = (8 * std::sqrt(0.75) + 6) / 14;
  ck_assert_double_eq_tol(v.octaves[0].mean / (8 * mean), 1, 0.03);
  ck_assert_double_eq_tol(v.octaves[1].mean / mean, 1, 0.1);
  ck_assert_double_eq_tol(v.max_place / (8 * mean), 1, 0.1);
  ck_assert_double_lt(v.max_at[0], 5.2);
  ck_assert_double_eq_tol(v.min_place / mean, 1, 0.03);
  ck_assert_double_gt(v.min_at[0], 5.2);
}
END_TEST

// The fraction of random points in the bounds that are inside equals the volume of the body.
START_TEST(inside_of_files) {
  const std::string data = PNPBS_SOURCE_DIR "/examples/data";
  const std::pair<volume_body, const char*> bodies[] = {{volume_bracket, "/bracket.stl"},
                                                        {volume_kleopatra, "/kleopatra.obj"},
                                                        {volume_eros, "/eros.off"}};
  pnpbs_context context;
  ck_assert_int_eq(pnpbs_context_create_serial(&context), 0);
  for (const auto& [body, file] : bodies) {
    pnpbs_domain domain;
    double volume = 0, low[3], high[3];
    ck_assert_int_eq(pnpbs_domain_create(context, 3, &domain), 0);
    ck_assert_int_ge(body(domain, data.c_str()), 0);
    ck_assert_int_ge(pnpbs_domain_measure(domain, &volume), 0);
    ck_assert_int_ge(pnpbs_domain_bounds(domain, low, high), 0);
    pnpbs_domain_destroy(&domain);
    const pnpbs_bench::Inside inside = pnpbs_bench::inside_of_file(data + file);
    std::mt19937_64 random(4);
    constexpr int kPoints = 20000;
    int found = 0;
    for (int k = 0; k < kPoints; ++k) {
      Place x;
      for (std::size_t axis = 0; axis < 3; ++axis)
        x[axis] = std::uniform_real_distribution<double>(low[axis], high[axis])(random);
      found += inside(x);
    }
    const double all = (high[0] - low[0]) * (high[1] - low[1]) * (high[2] - low[2]);
    ck_assert_double_eq_tol(found / double{kPoints}, volume / all, 4 * 0.5 / std::sqrt(kPoints));
  }
  pnpbs_context_destroy(&context);
}
END_TEST

TEST_SUITE(test_volume_measures) {
  return run_suite("volume_measures",
                   {regular_tetrahedron, sliver, flat_tetrahedron, body_centred_lattice, box,
                    flat_ones_at_the_boundary_are_peeled_off, edges_by_place, inside_of_files});
}
