// SPDX-License-Identifier: BSD-3-Clause
// The small meshes on which repairs are tried, against a lattice, areas and circles.
#include <algorithm>
#include <cmath>
#include <vector>

#include "predicates/plane.hpp"
#include "quality/plane/local_mesh.hpp"
#include "random.hpp"
#include "run_kernel_suite.hpp"

using pnpbs::LocalMesh;
using P = pnpbs::Point<2>;

namespace {

// A rhombic patch of the hexagonal lattice with distances 1. Nodes of its rim do not move.
constexpr int kSide = 9;
std::int32_t place(int column, int row) { return row * kSide + column; }
P lattice_point(int column, int row) { return {column + 0.5 * row, std::sqrt(0.75) * row}; }
bool at_rim(int column, int row) {
  return column == 0 || row == 0 || column == kSide - 1 || row == kSide - 1;
}

LocalMesh rhombus(double noise, std::uint64_t seed) {
  Random random(seed);
  LocalMesh mesh;
  for (int row = 0; row < kSide; ++row)
    for (int column = 0; column < kSide; ++column) {
      P x = lattice_point(column, row);
      for (double& coordinate : x)
        if (!at_rim(column, row)) coordinate += random.between(-noise, noise);
      mesh.add_node(x, !at_rim(column, row));
    }
  for (int row = 0; row + 1 < kSide; ++row)
    for (int column = 0; column + 1 < kSide; ++column) {
      mesh.add_triangle({place(column, row), place(column + 1, row), place(column, row + 1)});
      mesh.add_triangle(
          {place(column + 1, row), place(column + 1, row + 1), place(column, row + 1)});
    }
  mesh.link_triangles();
  return mesh;
}

constexpr int kMiddle = kSide / 2;
const double kArea = (kSide - 1) * (kSide - 1) * std::sqrt(0.75);

double area_of(const LocalMesh& mesh) {
  double twice = 0;
  for (const LocalMesh::Corners& t : mesh.triangles()) {
    const P a = mesh.position(t[0]), b = mesh.position(t[1]), c = mesh.position(t[2]);
    const double area = (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]);
    quick_assert(area > 0);
    twice += area;
  }
  return 0.5 * twice;
}

// Expects that the triangles cover the rhombus once, and that no circumcircle contains another
// node.
void check_delaunay(const LocalMesh& mesh, std::int32_t places, std::int32_t gone) {
  ck_assert_double_eq_tol(area_of(mesh), kArea, 1e-9 * kArea);
  for (const LocalMesh::Corners& t : mesh.triangles()) {
    quick_assert(std::find(t.begin(), t.end(), gone) == t.end());
    for (std::int32_t p = 0; p < places; ++p) {
      if (p == gone || std::find(t.begin(), t.end(), p) != t.end()) continue;
      quick_assert(pnpbs::in_circle(mesh.position(t[0]), mesh.position(t[1]), mesh.position(t[2]),
                                    mesh.position(p)) <= 0);
    }
  }
}

constexpr std::int32_t kPlaces = kSide * kSide;

}  // namespace

START_TEST(disturbed_lattice_relaxes_to_the_lattice) {
  for (std::uint64_t seed = 1; seed <= 10; ++seed) {
    LocalMesh mesh = rhombus(0.1, seed);
    const pnpbs::MeshQuality before = mesh.quality();
    mesh.relax();
    for (int row = 0; row < kSide; ++row)
      for (int column = 0; column < kSide; ++column)
        ck_assert_double_lt(
            pnpbs::distance<2>(mesh.position(place(column, row)), lattice_point(column, row)),
            0.03);
    ck_assert_double_lt(mesh.quality().loss, 0.05 * before.loss);
    ck_assert_double_gt(mesh.quality().min, before.min);
    check_delaunay(mesh, kPlaces, -1);
  }
}
END_TEST

START_TEST(quality_of_the_lattice) {
  const pnpbs::MeshQuality quality = rhombus(0, 1).quality();
  ck_assert_double_eq_tol(quality.loss, 0, 1e-12);
  ck_assert_double_eq_tol(quality.min, 1, 1e-12);
}
END_TEST

// The triangles of the inserted node cover the one it was inserted in, for any position, and all
// are Delaunay again.
START_TEST(a_node_comes) {
  for (std::uint64_t seed = 1; seed <= 10; ++seed) {
    LocalMesh mesh = rhombus(0.2, seed);
    const std::int32_t room = mesh.largest_triangle_at(place(kMiddle, kMiddle));
    const LocalMesh::Corners corners = mesh.triangles()[static_cast<std::size_t>(room)];
    ck_assert_int_eq(std::count(corners.begin(), corners.end(), place(kMiddle, kMiddle)), 1);
    const auto twice_area = [&](const LocalMesh::Corners& t) {
      const P a = mesh.position(t[0]), b = mesh.position(t[1]), c = mesh.position(t[2]);
      return (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]);
    };
    for (const LocalMesh::Corners& t : mesh.triangles())
      if (std::find(t.begin(), t.end(), place(kMiddle, kMiddle)) != t.end())
        ck_assert_double_le(twice_area(t), twice_area(corners));
    const std::size_t triangles = mesh.triangles().size();
    const std::int32_t more = mesh.insert(room);
    ck_assert_int_eq(more, kPlaces);
    ck_assert_uint_eq(mesh.triangles().size(), triangles + 2);
    ck_assert_double_eq_tol(area_of(mesh), kArea, 1e-9 * kArea);
    mesh.relax();
    check_delaunay(mesh, kPlaces + 1, -1);
  }
}
END_TEST

START_TEST(a_node_goes) {
  for (std::uint64_t seed = 1; seed <= 10; ++seed) {
    LocalMesh mesh = rhombus(0.25, seed);
    const std::size_t triangles = mesh.triangles().size();
    ck_assert(mesh.remove(place(kMiddle, kMiddle)));
    ck_assert_uint_eq(mesh.triangles().size(), triangles - 2);
    ck_assert_double_eq_tol(area_of(mesh), kArea, 1e-9 * kArea);
    mesh.relax();
    check_delaunay(mesh, kPlaces, place(kMiddle, kMiddle));
  }
}
END_TEST

// Inserting and removing a node restores the lattice.
START_TEST(a_node_comes_and_goes) {
  LocalMesh mesh = rhombus(0, 1);
  const std::int32_t room =
      mesh.largest_triangle_at(place(kMiddle, kMiddle), place(kMiddle + 1, kMiddle));
  ck_assert(mesh.remove(mesh.insert(room)));
  for (int k = 0; k < 10; ++k) mesh.relax();
  ck_assert_double_gt(mesh.quality().min, 1 - 1e-6);
}
END_TEST

// A node of the rim has no closed ring of triangles.
START_TEST(a_node_at_the_rim_stays) {
  LocalMesh mesh = rhombus(0, 1);
  ck_assert(!mesh.remove(place(0, kMiddle)));
}
END_TEST

TEST_SUITE(test_local_mesh) {
  return run_kernel_suite(
      "local_mesh", {disturbed_lattice_relaxes_to_the_lattice, quality_of_the_lattice, a_node_comes,
                     a_node_goes, a_node_comes_and_goes, a_node_at_the_rim_stays});
}
