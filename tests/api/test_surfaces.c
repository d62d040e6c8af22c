/* SPDX-License-Identifier: BSD-3-Clause
 *
 * Tests placements on surfaces alone: nodes and triangles on them, and nothing inside.
 */
#include "volume_support.h"

/* ---------------------------------------------------------------- the triangles --------- */

typedef struct {
  int64_t low, high;
  int turn; /* 1 from low to high, -1 in the other direction */
} edge;

static int by_ends(const void* a, const void* b) {
  const edge *s = a, *t = b;
  if (s->low != t->low) return s->low < t->low ? -1 : 1;
  return s->high < t->high ? -1 : s->high > t->high;
}

/* Checks that every edge has two triangles with opposite orientation, or is on the border. Returns
 * nodes - edges + triangles. */
static int64_t euler_number(const volume* v, int64_t* border) {
  const int64_t n = 3 * v->triangles;
  edge* edges = malloc((size_t)n * sizeof *edges);
  int64_t t, k, different = 0;
  ck_assert_ptr_nonnull(edges);
  for (t = 0; t < v->triangles; ++t)
    for (k = 0; k < 3; ++k) {
      const int64_t a = v->sides[3 * t + k], b = v->sides[3 * t + (k + 1) % 3];
      const edge e = {a < b ? a : b, a < b ? b : a, a < b ? 1 : -1};
      edges[3 * t + k] = e;
    }
  qsort(edges, (size_t)n, sizeof *edges, by_ends);
  *border = 0;
  for (k = 0; k < n; ++different) {
    int64_t next = k + 1;
    while (next < n && by_ends(&edges[k], &edges[next]) == 0) ++next;
    ck_assert_int_le(next - k, 2);
    if (next - k == 2) ck_assert_int_eq(edges[k].turn + edges[k + 1].turn, 0);
    *border += next - k == 1;
    k = next;
  }
  free(edges);
  return v->n - different + v->triangles;
}

static job surfaces_job(volume_body body, double d) {
  job it = body_job(body);
  MUST(pnpbs_placement_set_spacing_constant(it.placement, d));
  return it;
}

static void check_quality(pnpbs_placement p, double mean, double least_angle) {
  ck_assert_double_ge(real_of(p, "quality.mean"), mean);
  ck_assert_double_ge(real_of(p, "quality.min_angle"), least_angle);
  ck_assert_double_eq_tol(real_of(p, "edge.mean"), 1, 0.03);
}

static pnpbs_status ball_alone(pnpbs_domain domain, const char* data) {
  MUST(volume_unit_ball(domain, data));
  return pnpbs_domain_set_filled(domain, 0);
}

START_TEST(a_sphere) {
  const double d = 0.05;
  job it = surfaces_job(ball_alone, d);
  volume v;
  double *normals, measure;
  int64_t border, i, nodes;
  MUST(pnpbs_placement_estimate(it.placement, &nodes, NULL, NULL));
  MUST(pnpbs_placement_run(it.placement));
  MUST(pnpbs_placement_check(it.placement));
  v = volume_of(it.placement);
  ck_assert_double_eq_tol((double)nodes, (double)v.n, 0.05 * (double)v.n);
  ck_assert_double_eq_tol((double)v.n, 4 * PI / (0.866 * d * d), 0.03 * (double)v.n);
  ck_assert_int_eq(v.tetrahedra, 0);
  ck_assert_int_eq(euler_number(&v, &border), 2);
  ck_assert_int_eq(border, 0);
  MUST(pnpbs_domain_measure(it.domain, &measure));
  ck_assert_double_eq_tol(measure, 4 * PI, 1e-3 * measure);
  ck_assert_double_eq_tol(boundary_area(&v, 3, NULL), measure, 1e-3 * measure);
  check_quality(it.placement, 0.985, 35);
  normals = malloc((size_t)(3 * v.n) * sizeof *normals);
  MUST(pnpbs_placement_get_normals(it.placement, v.n, normals));
  for (i = 0; i < v.n; ++i) {
    ck_assert_double_lt(distance(normals + 3 * i, v.xyz + 3 * i), 0.03);
    ck_assert_int_eq(v.tags[i], 3);
    ck_assert_double_eq(v.d[i], d);
  }
  MUST_FAIL(PNPBS_ERROR_CAPACITY, pnpbs_placement_get_normals(it.placement, v.n - 1, normals),
            "capacity", "needed");
  free(normals);
  volume_free(&v);
  job_end(&it);
}
END_TEST

/* The surface has a border, and d is graded. */
START_TEST(a_terrain) {
  struct volume_spacing spacing = VOLUME_GRADED(0.02, 0.03, 0.5, 0, 0);
  job it = body_job(surface_terrain);
  volume v;
  double measure;
  int64_t border, i, at_border = 0;
  MUST(pnpbs_placement_set_spacing_callback(it.placement, volume_spacing_at, &spacing));
  MUST(pnpbs_placement_run(it.placement));
  MUST(pnpbs_placement_check(it.placement));
  v = volume_of(it.placement);
  ck_assert_int_eq(euler_number(&v, &border), 1);
  for (i = 0; i < v.n; ++i) {
    const double *x = v.xyz + 3 * i, side = fmax(fabs(x[0]), fabs(x[1]));
    at_border += side == 1;
    ck_assert(side == 1 || side < 1 - 0.2 * v.d[i]);
    ck_assert_double_eq_tol(x[2], terrain_height(x[0], x[1]), 2e-3);
  }
  ck_assert_int_eq(border, at_border);
  MUST(pnpbs_domain_measure(it.domain, &measure));
  ck_assert_double_eq_tol(boundary_area(&v, 0, NULL), measure, 1e-3 * measure);
  check_quality(it.placement, 0.98, 25); /* at the border; 29 elsewhere */
  volume_free(&v);
  job_end(&it);
}
END_TEST

/* The triangles of each tag cover their half of the sphere, and nodes lie on the equator between
 * them. */
START_TEST(two_tags) {
  job it = surfaces_job(surface_halves, 0.06);
  volume v;
  int64_t border, t, i, on_equator = 0;
  int k;
  MUST(pnpbs_placement_run(it.placement));
  MUST(pnpbs_placement_check(it.placement));
  v = volume_of(it.placement);
  ck_assert_int_eq(euler_number(&v, &border), 2);
  for (t = 0; t < v.triangles; ++t)
    for (k = 0; k < 3; ++k) {
      const double z = v.xyz[3 * v.sides[3 * t + k] + 2];
      ck_assert(v.side_tags[t] == 2 ? z <= 0 : z >= 0);
    }
  for (i = 0; i < v.n; ++i) on_equator += v.xyz[3 * i + 2] == 0;
  ck_assert_double_eq_tol((double)on_equator, 2 * PI / 0.06, 3);
  check_quality(it.placement, 0.98, 30);
  volume_free(&v);
  job_end(&it);
}
END_TEST

/* The surface has creases and corners between coarse flat triangles. */
START_TEST(a_skin_with_creases) {
  job it = surfaces_job(surface_l_block, 0.05);
  volume v;
  int64_t border;
  MUST(pnpbs_placement_run(it.placement));
  MUST(pnpbs_placement_check(it.placement));
  v = volume_of(it.placement);
  ck_assert_int_eq(euler_number(&v, &border), 2);
  ck_assert_double_eq_tol(boundary_area(&v, 0, NULL), 2 * 0.75 + 4, 1e-12);
  check_quality(it.placement, 0.97, 25);
  volume_free(&v);
  job_end(&it);
}
END_TEST

/* On a rough surface and far from rest, not all nodes find the same triangles. The returned
 * triangles must agree nevertheless. */
START_TEST(triangles_agree) {
  const double spacings[] = {4, 12, 20};
  job it = surfaces_job(surface_kleopatra, spacings[_i]);
  volume v;
  int64_t border;
  if (_i == 0) {
    MUST(pnpbs_placement_set(it.placement, "steps", "2"));
    MUST(pnpbs_placement_set(it.placement, "sweeps", "0"));
  }
  MUST_COMPUTE(pnpbs_placement_run(it.placement));
  MUST(pnpbs_placement_check(it.placement));
  v = volume_of(it.placement);
  ck_assert_int_eq(euler_number(&v, &border), 2);
  ck_assert_int_eq(border, 0);
  ck_assert_int_eq(warnings_with(it.placement, "triangles are missing"), 0);
  volume_free(&v);
  job_end(&it);
}
END_TEST

/* ---------------------------------------------------------------- again ----------------- */

static void check_again(const job* it, double d) {
  volume v = volume_of(it->placement);
  int64_t border;
  MUST(pnpbs_placement_check(it->placement));
  ck_assert_int_eq(euler_number(&v, &border), 2);
  ck_assert_double_eq_tol((double)v.n, 4 * PI / (0.866 * d * d), 0.06 * (double)v.n);
  volume_free(&v);
}

/* d becomes finer, then coarser, and then is given by values at nodes. Each run begins from the
 * current nodes. */
START_TEST(another_spacing) {
  job it = surfaces_job(surface_halves, 0.2);
  double* d;
  int64_t n, i;
  MUST(pnpbs_placement_run(it.placement));
  MUST(pnpbs_placement_set_spacing_constant(it.placement, 0.1));
  MUST(pnpbs_placement_run(it.placement));
  check_again(&it, 0.1);
  MUST(pnpbs_placement_set_spacing_constant(it.placement, 0.25));
  MUST(pnpbs_placement_run(it.placement));
  check_again(&it, 0.25);
  MUST(pnpbs_placement_count(it.placement, &n));
  d = malloc((size_t)n * sizeof *d);
  for (i = 0; i < n; ++i) d[i] = 0.2;
  MUST(pnpbs_placement_set_spacing_at_nodes(it.placement, n, d));
  MUST(pnpbs_placement_run(it.placement));
  check_again(&it, 0.2);
  free(d);
  job_end(&it);
}
END_TEST

/* Given nodes are projected to the surface. One that is too far away is dropped. */
START_TEST(given_nodes) {
  job it = surfaces_job(surface_halves, 0.15);
  volume v;
  int64_t i;
  MUST(pnpbs_placement_run(it.placement));
  v = volume_of(it.placement);
  for (i = 0; i < 3 * v.n; ++i) v.xyz[i] *= 1.05;
  v.xyz[0] = 7;
  MUST(pnpbs_placement_set_nodes(it.placement, v.n, v.xyz, NULL));
  MUST(pnpbs_placement_run(it.placement));
  check_again(&it, 0.15);
  ck_assert_int_ge(integer_of(it.placement, "dropped"), 1);
  volume_free(&v);
  job_end(&it);
}
END_TEST

/* ---------------------------------------------------------------- what cannot be done --- */

enum { SQUARE_TAG = 3 };

static job square_alone(void) {
  const double corners[] = {0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0};
  const int64_t triangles[] = {0, 1, 2, 0, 2, 3};
  const int32_t tags[] = {SQUARE_TAG, SQUARE_TAG};
  job it = {NULL, NULL, NULL};
  MUST(pnpbs_context_create_serial(&it.context));
  MUST(pnpbs_domain_create(it.context, 3, &it.domain));
  MUST(pnpbs_domain_set_filled(it.domain, 0));
  MUST(pnpbs_domain_add_surface(it.domain, PNPBS_INNER, 4, corners, 2, triangles, tags, 40));
  return it;
}

START_TEST(bad_domains) {
  const double along[] = {0, 0, 0, 1, 1, 0}, off[] = {0, 0, 0, 0.3, 0.2, 0}, up[] = {0, 0, 1};
  job it = {NULL, NULL, NULL}, plane = square_job(1);
  MUST_FAIL(PNPBS_ERROR_ARGUMENT, pnpbs_domain_set_filled(plane.domain, 0), "domain", "in space");
  job_end(&plane);

  MUST(pnpbs_context_create_serial(&it.context));
  MUST(pnpbs_domain_create(it.context, 3, &it.domain));
  MUST(pnpbs_domain_set_filled(it.domain, 0));
  MUST_FAIL(PNPBS_ERROR_DOMAIN, pnpbs_domain_check(it.domain), "no surfaces", "");
  job_end(&it);

  it = square_alone();
  MUST(pnpbs_domain_check(it.domain));
  MUST(pnpbs_domain_add_polyline(it.domain, PNPBS_INNER, 0, 2, along, NULL, 0));
  MUST(pnpbs_domain_check(it.domain));
  MUST(pnpbs_domain_set_filled(it.domain, 1));
  MUST_FAIL(PNPBS_ERROR_DOMAIN, pnpbs_domain_check(it.domain), "no boundary surface", "");
  MUST(pnpbs_domain_set_filled(it.domain, 0));
  MUST(pnpbs_domain_add_fixed_nodes(it.domain, 1, up, NULL));
  MUST_FAIL(PNPBS_ERROR_DOMAIN, pnpbs_domain_check(it.domain), "fixed node 0", "no vertex");
  job_end(&it);

  it = square_alone();
  MUST(pnpbs_domain_add_polyline(it.domain, PNPBS_INNER, 0, 2, off, NULL, 0));
  MUST_BE(PNPBS_ERROR_DOMAIN, pnpbs_domain_check(it.domain));
  job_end(&it);

  it = square_alone();
  MUST(pnpbs_domain_add_hole(it.domain, up));
  MUST_FAIL(PNPBS_ERROR_DOMAIN, pnpbs_domain_check(it.domain), "hole 0", "surfaces alone");
  job_end(&it);
}
END_TEST

/* With a d larger than the surface, only its corners are nodes. A d that is far too small is an
 * error. */
START_TEST(odd_spacings) {
  job it = square_alone();
  volume v;
  int64_t border, i;
  job_place(&it);
  MUST(pnpbs_placement_set_spacing_constant(it.placement, 5));
  MUST_COMPUTE(pnpbs_placement_run(it.placement));
  MUST(pnpbs_placement_check(it.placement));
  v = volume_of(it.placement);
  ck_assert_int_eq(v.n, 4);
  ck_assert_int_eq(euler_number(&v, &border), 1);
  ck_assert_int_eq(v.triangles, 2); /* between corners, so no node has the tag of the triangles */
  for (i = 0; i < v.triangles; ++i) ck_assert_int_eq(v.side_tags[i], SQUARE_TAG);
  volume_free(&v);
  MUST(pnpbs_placement_set_spacing_constant(it.placement, 1e-10));
  MUST_BE(PNPBS_ERROR_SPACING, pnpbs_placement_run(it.placement));
  MUST_BE(PNPBS_ERROR_SPACING, pnpbs_placement_set_spacing_constant(it.placement, 0));
  job_end(&it);
}
END_TEST

/* A given vertex must be a node, and edges must follow a given diagonal. */
START_TEST(fixed_nodes_and_curves) {
  const double diagonal[] = {0, 0, 0, 1, 1, 0}, corner[] = {1, 1, 0};
  const int32_t tag = 7;
  job it = square_alone();
  volume v;
  int64_t border, i, on_diagonal = 0, tagged = 0;
  MUST(pnpbs_domain_add_polyline(it.domain, PNPBS_INNER, 0, 2, diagonal, NULL, 0));
  MUST(pnpbs_domain_add_fixed_nodes(it.domain, 1, corner, &tag));
  job_place(&it);
  MUST(pnpbs_placement_set_spacing_constant(it.placement, 0.05));
  MUST(pnpbs_placement_run(it.placement));
  MUST(pnpbs_placement_check(it.placement));
  v = volume_of(it.placement);
  ck_assert_int_eq(euler_number(&v, &border), 1);
  for (i = 0; i < v.n; ++i) {
    on_diagonal += v.xyz[3 * i] == v.xyz[3 * i + 1];
    tagged += v.tags[i] == 7;
  }
  ck_assert_double_eq_tol((double)on_diagonal, sqrt(2) / 0.05 + 1, 1);
  ck_assert_int_eq(tagged, 1);
  ck_assert_double_eq_tol(boundary_area(&v, 0, NULL), 1, 1e-12);
  volume_free(&v);
  job_end(&it);
}
END_TEST

/* A placement reads the domain when it is initialised. Until then a change does not affect its
 * elements. */
START_TEST(filled_when_it_is_initialised) {
  job it = box_job(0.4);
  pnpbs_mesh mesh;
  int32_t corners;
  MUST_COMPUTE(pnpbs_placement_run(it.placement));
  MUST(pnpbs_domain_set_filled(it.domain, 0));
  MUST(pnpbs_mesh_create(it.placement, 0, &mesh));
  MUST(pnpbs_mesh_sizes(mesh, NULL, &corners, NULL, NULL, NULL, NULL, NULL));
  MUST(pnpbs_mesh_destroy(&mesh));
  ck_assert_int_eq(corners, 4);
  job_end(&it);
}
END_TEST

TEST_SUITE(test_surfaces) {
  TCase* tests = tcase_create("surfaces alone");
  Suite* suite = suite_create("surfaces alone");
  tcase_set_timeout(tests, 0);
  tcase_add_test(tests, a_sphere);
  tcase_add_test(tests, a_terrain);
  tcase_add_test(tests, two_tags);
  tcase_add_test(tests, a_skin_with_creases);
  tcase_add_loop_test(tests, triangles_agree, 0, 3);
  tcase_add_test(tests, another_spacing);
  tcase_add_test(tests, given_nodes);
  tcase_add_test(tests, bad_domains);
  tcase_add_test(tests, odd_spacings);
  tcase_add_test(tests, fixed_nodes_and_curves);
  tcase_add_test(tests, filled_when_it_is_initialised);
  suite_add_tcase(suite, tests);
  return run_suite(suite);
}
