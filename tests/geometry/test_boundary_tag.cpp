// SPDX-License-Identifier: BSD-3-Clause
// Tests of the surface that a triangle between nodes on features is assigned to.
#include "domain/volume/boundary_tag.hpp"
#include "run_suite.hpp"
#include "triangle_soup.hpp"

using namespace soups;
using pnpbs::boundary_tag;

namespace {

using Triangle = pnpbs::FacetCorners<3>;

// Returns a small triangle at x whose normal is along axis k, upwards if `up`.
Triangle facing(int k, bool up, const P& x, double size) {
  Triangle triangle{x, x, x};
  triangle[up ? 1 : 2][(k + 1) % 3] += size;
  triangle[up ? 2 : 1][(k + 2) % 3] += size;
  return triangle;
}

VolumeDomain box(const P& high) {
  VolumeDomain domain;
  domain.add_box({0, 0, 0}, high, {1, 2, 3, 4, 5, 6});
  domain.check();
  return domain;
}

// Returns the patch with this tag.
std::int32_t patch_of(const VolumeDomain& domain, std::int32_t tag) {
  for (std::size_t f = 0; f < domain.mesh().facets.size(); ++f)
    if (domain.mesh().facets[f].tag == tag) return domain.features().patch[f];
  return -1;
}

}  // namespace

START_TEST(each_side_of_a_box_has_its_tag) {
  const VolumeDomain domain = box({1, 1, 1});
  for (int k = 0; k < 3; ++k)
    for (const bool up : {false, true})
      // Points from one corner of the side to the other, including points next to its edges.
      for (const double at : {0.0, 0.3, 0.9}) {
        P x{at, at, at};
        x[k] = up ? 1 : 0;
        ck_assert_int_eq(boundary_tag(domain, facing(k, up, x, 0.1), {}), 2 * k + (up ? 2 : 1));
      }
}
END_TEST

// A triangle over an edge that d does not resolve: common patches of its nodes take precedence over
// nearer ones. Among several common patches, the nearer one is used.
START_TEST(common_patches_count) {
  const VolumeDomain domain = box({1, 1, 1});
  const Triangle oblique{P{1, 0.2, 1}, P{1, 0.6, 0.9}, P{0.95, 0.4, 1}};  // nearer to x = 1
  const std::int32_t top = patch_of(domain, 6), side = patch_of(domain, 2);
  const std::int32_t only_top[] = {top}, only_side[] = {side}, both[] = {top, side};
  ck_assert_int_eq(boundary_tag(domain, oblique, only_top), 6);
  ck_assert_int_eq(boundary_tag(domain, oblique, only_side), 2);
  ck_assert_int_eq(boundary_tag(domain, oblique, both), 2);
  ck_assert_int_eq(boundary_tag(domain, oblique, {}), 2);
  const std::int32_t far[] = {patch_of(domain, 1)};  // on the opposite side of the box
  ck_assert_int_eq(boundary_tag(domain, oblique, far), 1);
}
END_TEST

START_TEST(the_other_side_of_a_thin_plate_is_not_meant) {
  const VolumeDomain domain = box({1, 1, 0.01});
  // Triangles as they arise if chords of a curved surface pass nearly through the plate.
  const Triangle above = facing(2, true, {0.4, 0.5, 0.001}, 0.1);
  const Triangle below = facing(2, false, {0.4, 0.5, 0.009}, 0.1);
  const std::int32_t both[] = {patch_of(domain, 5), patch_of(domain, 6)};
  ck_assert_int_eq(boundary_tag(domain, above, {}), 6);
  ck_assert_int_eq(boundary_tag(domain, below, {}), 5);
  ck_assert_int_eq(boundary_tag(domain, above, both), 6);
  ck_assert_int_eq(boundary_tag(domain, below, both), 5);
}
END_TEST

START_TEST(a_cavity_faces_its_inside) {
  VolumeDomain domain;
  domain.add_box({0, 0, 0}, {1, 1, 1}, 1);
  domain.add_box({0.4, 0.4, 0.4}, {0.6, 0.6, 0.6}, {11, 12, 13, 14, 15, 16});
  domain.check();
  // The region outside the domain lies above the cavity's floor and below its ceiling.
  ck_assert_int_eq(boundary_tag(domain, facing(2, true, {0.5, 0.5, 0.4}, 0.05), {}), 15);
  ck_assert_int_eq(boundary_tag(domain, facing(2, false, {0.5, 0.5, 0.6}, 0.05), {}), 16);
  ck_assert_int_eq(boundary_tag(domain, facing(2, true, {0.5, 0.5, 1}, 0.05), {}), 1);
}
END_TEST

START_TEST(what_bounds_nothing_does_not_count) {
  VolumeDomain domain;
  domain.add_box({0, 0, 0}, {1, 1, 0.01}, {1, 2, 3, 4, 5, 6});
  Soup sheet;
  sheet.triangle(sheet.vertex(0.1, 0.1, 0.009), sheet.vertex(0.9, 0.1, 0.009),
                 sheet.vertex(0.1, 0.9, 0.009), 9);
  sheet.add_to(domain, SurfaceRole::inner);
  const P a{0.2, 0.2, 0.0099}, b{0.4, 0.2, 0.0099};
  const std::vector<double> line{a[0], a[1], a[2], b[0], b[1], b[2]};
  domain.add_polyline(false, 2, line.data(), nullptr);
  domain.check();
  ck_assert_int_eq(boundary_tag(domain, facing(2, true, {0.2, 0.2, 0.0095}, 0.1), {}), 6);
  const std::int32_t inner[] = {patch_of(domain, 9)};
  ck_assert_int_eq(boundary_tag(domain, facing(2, true, {0.2, 0.2, 0.0095}, 0.1), inner), 6);
}
END_TEST

TEST_SUITE(test_boundary_tag) {
  return run_suite("boundary_tag", {each_side_of_a_box_has_its_tag, common_patches_count,
                                    the_other_side_of_a_thin_plate_is_not_meant,
                                    a_cavity_faces_its_inside, what_bounds_nothing_does_not_count});
}
