/* SPDX-License-Identifier: BSD-3-Clause
 *
 * Tests placements in space through the C interface: the results are consistent with each other,
 * and requests that are impossible give errors.
 */
#include "volume_support.h"

/* ---------------------------------------------------------------- results -------------- */

START_TEST(a_box) {
  const double d = 0.12;
  job it = box_job(d);
  volume v;
  int64_t i, on_boundary = 0;
  MUST_COMPUTE(pnpbs_placement_run(it.placement));
  check_body(&it, 1e-12);
  v = volume_of(it.placement);
  ck_assert_int_eq(v.n, integer_of(it.placement, "nodes"));
  ck_assert_double_eq_tol((double)v.n, 1.5 / (d * d * d), 0.35 * 1.5 / (d * d * d));
  ck_assert_double_eq_tol(boundary_area(&v, 1, NULL), 6, 1e-12);
  ck_assert_double_gt(nearest_pair(&v), 0.5);
  ck_assert_double_gt(real_of(it.placement, "quality.mean"), 0.85);
  ck_assert_double_gt(real_of(it.placement, "quality.min_angle"), 25);
  for (i = 0; i < v.n; ++i) {
    double side = HUGE_VAL;
    int k;
    for (k = 0; k < 3; ++k) side = fmin(side, fmin(v.xyz[3 * i + k], 1 - v.xyz[3 * i + k]));
    ck_assert_double_eq(v.d[i], d);
    ck_assert_int_eq(v.tags[i], side == 0);
    ck_assert(side == 0 || side > 0.3 * d);
    on_boundary += v.tags[i] != 0;
  }
  ck_assert_int_eq(on_boundary, integer_of(it.placement, "boundary_nodes"));
  volume_free(&v);
  job_end(&it);
}
END_TEST

/* Lists contain exactly the pairs within 1.7 d, in both directions. */
START_TEST(adjacency_by_distance) {
  job it = box_job(0.2);
  volume v;
  int64_t entries, i, j, expected = 0, *offsets, *neighbours;
  MUST_COMPUTE(pnpbs_placement_run(it.placement));
  v = volume_of(it.placement);
  MUST(pnpbs_placement_adjacency_size(it.placement, &entries));
  offsets = malloc((size_t)(v.n + 1) * sizeof *offsets);
  neighbours = malloc((size_t)entries * sizeof *neighbours);
  MUST(pnpbs_placement_get_adjacency(it.placement, entries, offsets, neighbours));
  for (i = 0; i < v.n; ++i)
    for (j = 0; j < v.n; ++j) {
      int64_t k;
      int listed = 0;
      for (k = offsets[i]; k < offsets[i + 1]; ++k) listed += neighbours[k] == j;
      ck_assert_int_eq(listed, i != j && distance(v.xyz + 3 * i, v.xyz + 3 * j) <= 1.7 * 0.2);
      expected += listed;
    }
  ck_assert_int_eq(entries, expected);
  free(offsets), free(neighbours);
  volume_free(&v);
  job_end(&it);
}
END_TEST

START_TEST(bodies) {
  static const struct {
    volume_body body;
    double d, tolerance;
  } cases[] = {{volume_l_block, 0.12, 1e-12},
               {volume_two_halves, 0.15, 1e-12},
               {volume_globe, 0.2, 0.02},
               {volume_cavity, 0.1, 0.01},
               {volume_bracket, 4, 0.01}};
  job it = body_job(cases[_i].body);
  MUST(pnpbs_placement_set_spacing_constant(it.placement, cases[_i].d));
  MUST_COMPUTE(pnpbs_placement_run(it.placement));
  check_body(&it, cases[_i].tolerance);
  job_end(&it);
}
END_TEST

/* ---------------------------------------------------------------- what cannot be -------- */

START_TEST(functions_of_the_other_dimension) {
  const double square[] = {0, 0, 1, 0, 1, 1, 0, 1}, low[] = {0, 0, 0}, high[] = {1, 1, 1};
  job plane = square_job(1), space = box_job(0.5);
  pnpbs_domain domain = NULL;
  int64_t count;
  MUST_BE(PNPBS_ERROR_ARGUMENT, pnpbs_domain_create(plane.context, 4, &domain));
  MUST_FAIL(PNPBS_ERROR_ARGUMENT, pnpbs_domain_add_box(plane.domain, low, high, 1),
            "two dimensions", "space");
  MUST_FAIL(PNPBS_ERROR_ARGUMENT,
            pnpbs_domain_read_surface(plane.domain, PNPBS_BOUNDARY, DATA "/eros.off", 40),
            "two dimensions", "space");
  MUST_BE(PNPBS_ERROR_ARGUMENT,
          pnpbs_domain_add_polyline(space.domain, PNPBS_BOUNDARY, 1, 4, square, NULL, 0));
  MUST_FAIL(PNPBS_ERROR_ARGUMENT, pnpbs_domain_read_poly(space.domain, DATA "/lake_victoria.poly"),
            "three dimensions", "plane");
  MUST(pnpbs_placement_set_spacing_constant(plane.placement, 0.3));
  MUST_COMPUTE(pnpbs_placement_run(plane.placement));
  MUST_COMPUTE(pnpbs_placement_run(space.placement));
  MUST_FAIL(PNPBS_ERROR_ARGUMENT, pnpbs_placement_get_tetrahedra(plane.placement, 0, &count, NULL),
            "dimensions", "3");
  MUST_FAIL(PNPBS_ERROR_ARGUMENT,
            pnpbs_placement_get_boundary_triangles(plane.placement, 0, &count, NULL, NULL),
            "dimensions", "3");
  MUST_FAIL(PNPBS_ERROR_ARGUMENT, pnpbs_placement_get_triangles(space.placement, 0, &count, NULL),
            "dimensions", "2");
  MUST_FAIL(PNPBS_ERROR_ARGUMENT,
            pnpbs_placement_get_boundary_edges(space.placement, 0, &count, NULL, NULL),
            "dimensions", "2");
  job_end(&plane);
  job_end(&space);
}
END_TEST

/* Only corners are nodes, and the tetrahedra between them still fill the body. */
START_TEST(spacings_far_larger_than_the_body) {
  static const double huge[] = {3, 1e6, 1e150, 1e299};
  job it = box_job(huge[_i]);
  MUST_COMPUTE(pnpbs_placement_run(it.placement));
  ck_assert_int_eq(integer_of(it.placement, "nodes"), 8);
  check_body(&it, 1e-12);
  job_end(&it);
}
END_TEST

static int32_t bad_beyond(int64_t n, int32_t dim, const double* x, double* d, void* user) {
  int64_t i;
  for (i = 0; i < n; ++i) d[i] = x[dim * i + 2] > 0.7 ? *(const double*)user : 0.15;
  return 0;
}

static int32_t failing(int64_t n, int32_t dim, const double* x, double* d, void* user) {
  (void)n, (void)dim, (void)x, (void)d, (void)user;
  return 1;
}

START_TEST(bad_spacings) {
  static double bad[] = {0, -1, NAN, HUGE_VAL};
  job it = body_job(volume_unit_box);
  int k;
  for (k = 0; k < COUNT_OF(bad); ++k) {
    MUST_BE(PNPBS_ERROR_SPACING, pnpbs_placement_set_spacing_constant(it.placement, bad[k]));
    MUST(pnpbs_placement_set_spacing_callback(it.placement, bad_beyond, &bad[k]));
    MUST_FAIL(PNPBS_ERROR_SPACING, pnpbs_placement_run(it.placement), "spacing d = ", "(0, 0, 1)");
  }
  MUST(pnpbs_placement_set_spacing_callback(it.placement, failing, NULL));
  MUST_BE(PNPBS_ERROR_CALLBACK, pnpbs_placement_run(it.placement));
  /* The placement can be used afterwards. */
  MUST(pnpbs_placement_set_spacing_constant(it.placement, 0.3));
  MUST_COMPUTE(pnpbs_placement_run(it.placement));
  check_body(&it, 1e-12);
  job_end(&it);
}
END_TEST

START_TEST(too_many_nodes) {
  job it = box_job(0.05);
  MUST(pnpbs_placement_set(it.placement, "max_nodes", "1000"));
  MUST_FAIL(PNPBS_ERROR_SPACING, pnpbs_placement_run(it.placement), "max_nodes", "1000");
  MUST(pnpbs_placement_set_spacing_constant(it.placement, 1e-9));
  MUST_BE(PNPBS_ERROR_SPACING, pnpbs_placement_run(it.placement));
  MUST(pnpbs_placement_set_spacing_constant(it.placement, 0.2));
  MUST_COMPUTE(pnpbs_placement_run(it.placement));
  check_body(&it, 1e-12);
  job_end(&it);
}
END_TEST

/* d is fine within a ball or a layer that samples for the large bubbles around it may miss. */
typedef struct {
  int layer;
  double at[3], half_width, fine;
} fine_place;

static const fine_place fine_places[] = {
    {0, {0.5, 0.5, 0.5}, 0.06, 0.01},
    {0, {1, 0.5, 0.5}, 0.06, 0.01}, /* on a side of the box */
    {1, {0.37, 0, 0}, 0.02, 0.04},
    {1, {0.25, 0, 0}, 0.02, 0.04}, /* on faces of leaves of the tree */
};

static double way_to_fine_place(const fine_place* place, const double* x) {
  const double far = place->layer ? fabs(x[0] - place->at[0]) : distance(x, place->at);
  return fmax(0, far - place->half_width);
}

static int32_t fine_within(int64_t n, int32_t dim, const double* xyz, double* d, void* user) {
  const fine_place* place = user;
  int64_t i;
  (void)dim;
  for (i = 0; i < n; ++i) d[i] = way_to_fine_place(place, xyz + 3 * i) == 0 ? place->fine : 0.2;
  return 0;
}

/* Checks d at the nodes against the exact limit of its growth. */
static void check_growth_from(const fine_place* place, const volume* v) {
  int64_t i, fine = 0;
  for (i = 0; i < v->n; ++i) {
    const double way = way_to_fine_place(place, v->xyz + 3 * i);
    const double limit = fmin(0.2, place->fine + 0.3 * way);
    ck_assert_double_ge(v->d[i], limit * (1 - 1e-12));
    ck_assert_double_le(v->d[i], limit * 1.25);
    fine += way == 0;
  }
  ck_assert_int_gt(fine, place->layer ? 200 : 400);
}

START_TEST(fine_in_a_small_place) {
  fine_place place = fine_places[_i];
  job it = body_job(volume_unit_box);
  volume v;
  pnpbs_status status;
  MUST(pnpbs_placement_set_spacing_callback(it.placement, fine_within, &place));
  status = pnpbs_placement_run(it.placement);
  if (status != PNPBS_SPACING_MISSED) /* it may be, since only some hundred edges are coarse */
    MUST_COMPUTE(status);
  ck_assert_int_eq(warnings_with(it.placement, "its growth is limited to 0.3"), 1);
  check_body(&it, 1e-12);
  ck_assert_double_gt(real_of(it.placement, "quality.min_angle"), 25);
  v = volume_of(it.placement);
  check_growth_from(&place, &v);
  volume_free(&v);
  job_end(&it);
}
END_TEST

/* A spacing for which the tetrahedra and the nodes on the surface may choose different diagonals of
 * four nodes on a flat side. No boundary triangle counts as missing then. */
static int32_t graded_from_a_layer(int64_t n, int32_t dim, const double* xyz, double* d,
                                   void* user) {
  int64_t i;
  (void)dim, (void)user;
  for (i = 0; i < n; ++i) d[i] = fmin(0.1, 0.02 + 0.3 * fmax(0, fabs(xyz[3 * i] - 0.37) - 0.02));
  return 0;
}

/* A ball of radius 0.3: the nodes are valid, but no element lies between them. The run, the warning
 * and the check must report the same. */
START_TEST(bodies_that_the_spacing_does_not_resolve) {
  static const double centre[] = {0, 0, 0};
  static const struct {
    double d;
    int filled;
    const char* words;
  } cases[] = {{5, 1, "no tetrahedron at all"},
               {5, 0, "no triangle at all"},
               {1, 0, "no triangle at all"},
               {0.5, 0, "in no triangle: "},
               {0.2, 1, NULL},
               {0.2, 0, NULL}};
  const int conforms = cases[_i].words == NULL;
  job it = {NULL, NULL, NULL};
  pnpbs_status status;
  MUST(pnpbs_context_create_serial(&it.context));
  MUST(pnpbs_domain_create(it.context, 3, &it.domain));
  MUST(pnpbs_domain_add_ball(it.domain, centre, 0.3, 1));
  if (!cases[_i].filled) MUST(pnpbs_domain_set_filled(it.domain, 0));
  job_place(&it);
  MUST(pnpbs_placement_set_spacing_constant(it.placement, cases[_i].d));
  MUST(pnpbs_placement_set(it.placement, "conforming_rounds", "0"));
  status = pnpbs_placement_run(it.placement);
  if (conforms) {
    ck_assert_int_ge(status, 0);
    ck_assert_int_ne(status, PNPBS_NOT_CONFORMING);
  } else {
    ck_assert_int_eq(status, PNPBS_NOT_CONFORMING);
    ck_assert_int_eq(warnings_with(it.placement, cases[_i].words), 1);
  }
  MUST_BE(conforms ? PNPBS_OK : PNPBS_NOT_CONFORMING, pnpbs_placement_check(it.placement));
  if (!conforms) ck_assert_ptr_nonnull(strstr(MESSAGE(), cases[_i].words));
  job_end(&it);
}
END_TEST

/* Returns, by formulas, whether a point lies in the inner body of the next test. */
static int in_primitive(int kind, const double* x) {
  const double u = x[0] - 0.5, v = x[1] - 0.5, w = x[2] - 0.5;
  if (kind == 0) return fmax(fabs(u), fmax(fabs(v), fabs(w))) < 0.2;
  if (kind == 1) return u * u + v * v + w * w < 0.09;
  return u * u + v * v < 0.04 && w > 0 && w < 0.3;
}

/* An inner box, ball or cylinder divides the cube around it, which has the same tag. */
START_TEST(inner_primitives) {
  static const double low[] = {0, 0, 0}, high[] = {1, 1, 1}, middle[] = {0.5, 0.5, 0.5};
  static const double from[] = {0.3, 0.3, 0.3}, to[] = {0.7, 0.7, 0.7}, end[] = {0.5, 0.5, 0.8};
  static const double inside[] = {0.5, 0.5, 0.6}, outside[] = {0.1, 0.1, 0.1};
  job it = {NULL, NULL, NULL};
  double volume;
  int k, found = 0;
  MUST(pnpbs_context_create_serial(&it.context));
  MUST(pnpbs_domain_create(it.context, 3, &it.domain));
  MUST(pnpbs_domain_add_box_surface(it.domain, PNPBS_BOUNDARY, low, high, 1));
  if (_i == 0) MUST(pnpbs_domain_add_box_surface(it.domain, PNPBS_INNER, from, to, 1));
  if (_i == 1) MUST(pnpbs_domain_add_ball_surface(it.domain, PNPBS_INNER, middle, 0.3, 1));
  if (_i == 2) MUST(pnpbs_domain_add_cylinder_surface(it.domain, PNPBS_INNER, middle, end, 0.2, 1));
  MUST_FAIL(PNPBS_ERROR_ARGUMENT, pnpbs_domain_add_box_surface(it.domain, 2, low, high, 1), "role",
            "2");
  MUST_FAIL(PNPBS_ERROR_ARGUMENT, pnpbs_domain_add_ball_surface(it.domain, -1, low, 1, 1), "role",
            "-1");
  MUST_FAIL(PNPBS_ERROR_ARGUMENT, pnpbs_domain_add_cylinder_surface(it.domain, 3, low, high, 1, 1),
            "role", "3");
  MUST(pnpbs_domain_add_region(it.domain, inside, 7));
  MUST(pnpbs_domain_add_region(it.domain, outside, 8));
  MUST(pnpbs_domain_measure(it.domain, &volume));
  ck_assert_double_eq_tol(volume, 1, 1e-12);
  for (k = 0; k < 1000; ++k) {
    const double x[] = {0.0513 + 0.1 * (k % 10), 0.0527 + 0.1 * (k / 10 % 10),
                        0.0541 + 0.1 * (k / 100)};
    int32_t tag;
    MUST(pnpbs_domain_regions_at(it.domain, 1, x, 1, &tag));
    ck_assert_int_eq(tag, in_primitive(_i, x) ? 7 : 8);
    found += tag == 7;
  }
  ck_assert_int_gt(found, 20);
  job_end(&it);
}
END_TEST

/* Boundary nodes lie on the surface up to rounding, which is 2^-47 of the largest coordinate. */
START_TEST(bodies_far_from_the_origin) {
  static const double offsets[] = {0, 1e5, -1e8, 1e9};
  const double at = offsets[_i], centre[] = {at, 0.3 * at, -at};
  const double begin[] = {at + 0.1, 0.3 * at, -at}, end[] = {at + 0.7, 0.3 * at + 0.4, 0.5 - at};
  int body;
  for (body = 0; body < 2; ++body) {
    job it = {NULL, NULL, NULL};
    volume v;
    int64_t i, on_surface = 0;
    MUST(pnpbs_context_create_serial(&it.context));
    MUST(pnpbs_domain_create(it.context, 3, &it.domain));
    if (body == 0) MUST(pnpbs_domain_add_ball(it.domain, centre, 0.5, 1));
    if (body == 1) MUST(pnpbs_domain_add_cylinder(it.domain, begin, end, 0.4, 1));
    job_place(&it);
    MUST(pnpbs_placement_set_spacing_constant(it.placement, 0.17));
    MUST_COMPUTE(pnpbs_placement_run(it.placement));
    MUST(pnpbs_placement_check(it.placement));
    v = volume_of(it.placement);
    for (i = 0; i < v.n; ++i) {
      double gap;
      if (v.tags[i] == 0) continue;
      MUST(pnpbs_domain_distance(it.domain, 0, 1, v.xyz + 3 * i, &gap));
      ck_assert_double_le(gap, 0x1p-47 * (fabs(at) + 1));
      ++on_surface;
    }
    ck_assert_int_gt(on_surface, 50);
    volume_free(&v);
    job_end(&it);
  }
}
END_TEST

START_TEST(flat_sides_follow_the_surface) {
  job it = body_job(volume_unit_box);
  MUST(pnpbs_placement_set_spacing_callback(it.placement, graded_from_a_layer, NULL));
  MUST_COMPUTE(pnpbs_placement_run(it.placement));
  check_body(&it, 1e-12);
  ck_assert_int_eq(integer_of(it.placement, "missing_faces"), 0);
  ck_assert_int_eq(warnings_with(it.placement, "missing_faces"), 0);
  job_end(&it);
}
END_TEST

/* Adds a box half as high as it is wide, so that its top lies in faces of the tree's cells. */
static pnpbs_status low_box(pnpbs_domain domain, const char* folder) {
  const double low[] = {0, 0, 0}, high[] = {2, 2, 1};
  (void)folder;
  return pnpbs_domain_add_box(domain, low, high, 1);
}

static int32_t fine_at_a_line(int64_t n, int32_t dim, const double* xyz, double* d, void* user) {
  int64_t i;
  (void)dim, (void)user;
  for (i = 0; i < n; ++i) d[i] = fmin(0.02 + 0.3 * hypot(xyz[3 * i] - 1, xyz[3 * i + 1] - 1), 0.3);
  return 0;
}

START_TEST(fine_at_a_line_in_a_low_box) {
  const double g = 0.3, d0 = 0.02, r = (0.3 - d0) / g; /* from this radius on d is 0.3 */
  /* The expected number of nodes is the integral of sqrt(2) / d^3 over the box: of 2 pi r / (d0 + g
   * r)^3 around the line, and of a constant beyond. */
  const double pi = acos(-1), around = pi * r * r / (d0 * pow(d0 + g * r, 2)),
               beyond = (4 - pi * r * r) / pow(0.3, 3), expected = sqrt(2) * (around + beyond);
  job it = body_job(low_box);
  MUST(pnpbs_placement_set_spacing_callback(it.placement, fine_at_a_line, NULL));
  MUST_COMPUTE(pnpbs_placement_run(it.placement));
  check_body(&it, 1e-12);
  ck_assert_double_gt((double)integer_of(it.placement, "nodes"), 0.8 * expected);
  ck_assert_double_lt((double)integer_of(it.placement, "nodes"), 1.5 * expected);
  ck_assert_double_gt(real_of(it.placement, "quality.min_angle"), 25);
  job_end(&it);
}
END_TEST

/* Adds a wall whose nodes are all on its sides, and many opposite to each other. Four of them may
 * lie in a plane across the wall. The region between them must be an element, otherwise the mesh
 * has cracks. */
static pnpbs_status wall(pnpbs_domain domain, const char* folder) {
  const double low[] = {0, 0, 0}, high[] = {40, 40, 1};
  (void)folder;
  return pnpbs_domain_add_box(domain, low, high, 1);
}

START_TEST(walls_as_thick_as_d) {
  volume v;
  job it = body_job(wall);
  MUST(pnpbs_placement_set_spacing_constant(it.placement, 1));
  MUST_COMPUTE(pnpbs_placement_run(it.placement));
  check_body(&it, 1e-12);
  ck_assert_double_gt(real_of(it.placement, "quality.min_angle"), 10);
  ck_assert_int_eq(integer_of(it.placement, "missing_faces"), 0);
  v = volume_of(it.placement);
  ck_assert_double_eq_tol(boundary_area(&v, 0, NULL), 2 * 1600 + 4 * 40, 1e-8);
  volume_free(&v);
  job_end(&it);
}
END_TEST

static pnpbs_status thicker_wall(pnpbs_domain domain, const char* folder) {
  const double low[] = {0, 0, 0}, high[] = {20, 20, 2};
  (void)folder;
  return pnpbs_domain_add_box(domain, low, high, 1);
}

/* Edges through the wall are longer than d, since a second layer of nodes has no room. Nodes that
 * follow d along the wall do not miss d, whereas too few nodes do. */
START_TEST(walls_of_two_d) {
  const double d[] = {1, 1.05};
  int k;
  for (k = 0; k < COUNT_OF(d); ++k) {
    job it = body_job(thicker_wall);
    MUST(pnpbs_placement_set_spacing_constant(it.placement, d[k]));
    MUST_COMPUTE(pnpbs_placement_run(it.placement)); /* not PNPBS_SPACING_MISSED */
    check_body(&it, 1e-12);
    job_end(&it);
  }
}
END_TEST

static pnpbs_status coarse_box_with_cavity(pnpbs_domain domain, const char* folder) {
  const double low[] = {-1, -1, -1}, high[] = {1, 1, 1}, centre[] = {0, 0, 0};
  const pnpbs_status status = pnpbs_domain_add_box(domain, low, high, 1);
  (void)folder;
  return status < 0 ? status : pnpbs_domain_add_ball(domain, centre, 0.4, 2);
}

static int32_t coarse_from_the_centre(int64_t n, int32_t dim, const double* xyz, double* d,
                                      void* user) {
  int64_t i;
  (void)dim, (void)user;
  for (i = 0; i < n; ++i)
    d[i] = 0.15 + 0.1 * sqrt(xyz[3 * i] * xyz[3 * i] + xyz[3 * i + 1] * xyz[3 * i + 1] +
                             xyz[3 * i + 2] * xyz[3 * i + 2]);
  return 0;
}

/* The largest d is at the edges of the box, where the nodes inside are about 1.15 d from those of
 * the edge, as everywhere at a dihedral angle of 90 degrees. Such edges do not miss d. */
START_TEST(coarse_at_the_edges_of_a_box) {
  job it = body_job(coarse_box_with_cavity);
  MUST(pnpbs_placement_set_spacing_callback(it.placement, coarse_from_the_centre, NULL));
  MUST_BE(PNPBS_OK, pnpbs_placement_run(it.placement));
  ck_assert_int_eq(integer_of(it.placement, "nodes"), 1021);
  job_end(&it);
}
END_TEST

START_TEST(too_few_nodes_in_a_wall) {
  job it = body_job(thicker_wall);
  double xyz[3 * 100];
  int k;
  for (k = 0; k < 100; ++k)
    xyz[3 * k] = 1 + 2 * (k % 10), xyz[3 * k + 1] = 1 + 2 * (k / 10), xyz[3 * k + 2] = 1;
  MUST(pnpbs_placement_set_spacing_constant(it.placement, 1));
  MUST(pnpbs_placement_set_nodes(it.placement, 100, xyz, NULL));
  MUST(pnpbs_placement_set_int64(it.placement, "steps", 0));
  MUST_BE(PNPBS_SPACING_MISSED, pnpbs_placement_run(it.placement));
  job_end(&it);
}
END_TEST

static pnpbs_status crossing_boxes(pnpbs_domain domain, const char* folder) {
  const double low[] = {0, 0, 0}, high[] = {1, 1, 1}, other_low[] = {0.5, 0.5, 0.5},
               other_high[] = {1.5, 1.5, 1.5};
  pnpbs_status status = pnpbs_domain_add_box(domain, low, high, 1);
  (void)folder;
  if (status == PNPBS_OK) status = pnpbs_domain_add_box(domain, other_low, other_high, 1);
  if (status == PNPBS_OK) status = pnpbs_domain_set_repair(domain, 0.05);
  return status;
}

START_TEST(distances_of_repairs_are_statistics) {
  job whole = body_job(volume_unit_box), it = body_job(crossing_boxes);
  MUST(pnpbs_placement_set_spacing_constant(it.placement, 0.3));
  MUST_COMPUTE(pnpbs_placement_run(it.placement));
  ck_assert_double_eq(real_of(it.placement, "repaired.resolution"), 0.05);
  ck_assert_double_lt(real_of(it.placement, "repaired.distance"), 1e-3);
  ck_assert_double_eq(real_of(it.placement, "repaired.hole_distance"), 0);
  ck_assert_double_lt(real_of(it.placement, "repaired.mean_distance"), 1e-5);
  /* The removed parts are the corner of each box that lies in the other one, and the squares at it
   * except a rim of 0.05. */
  ck_assert_double_eq_tol(real_of(it.placement, "repaired.given_distance"), 0.5, 0.01);
  ck_assert_double_eq_tol(real_of(it.placement, "repaired.lost_area"), 6 * 0.45 * 0.45 / 12, 0.01);
  MUST(pnpbs_placement_set_spacing_constant(whole.placement, 0.5));
  MUST_COMPUTE(pnpbs_placement_run(whole.placement));
  ck_assert_double_eq(real_of(whole.placement, "repaired.resolution"), 0);
  ck_assert_double_eq(real_of(whole.placement, "repaired.given_distance"), 0);
  job_end(&it);
  job_end(&whole);
}
END_TEST

/* Adds a plate with an upright wall that is thinner than half of d. Bubbles on one side of the
 * wall, and on the plate, may come to rest with single nodes missing. */
static pnpbs_status tee(pnpbs_domain domain, const char* folder) {
  static const double outline[8][2] = {{0, 0},    {12, 0}, {12, 4}, {9.4, 4},
                                       {9.4, 10}, {9, 10}, {9, 4},  {0, 4}};
  static const int sides[14][4] = {
      {0, 3, 2, 1},     {0, 7, 6, 3},   {3, 6, 5, 4},   {8, 9, 10, 11}, {8, 11, 14, 15},
      {11, 12, 13, 14}, {0, 1, 9, 8},   {1, 2, 10, 9},  {2, 3, 11, 10}, {3, 4, 12, 11},
      {4, 5, 13, 12},   {5, 6, 14, 13}, {6, 7, 15, 14}, {7, 0, 8, 15}};
  double vertices[16][3];
  int i;
  (void)folder;
  for (i = 0; i < 16; ++i) {
    vertices[i][0] = i < 8 ? 0 : 16;
    vertices[i][1] = outline[i % 8][0];
    vertices[i][2] = outline[i % 8][1];
  }
  return volume_add_quads(domain, PNPBS_BOUNDARY, 16, vertices[0], 14, sides);
}

/* Returns the largest distance from points of a rectangle, orthogonal to an axis, to the nodes in
 * its plane. */
static double farthest(const volume* v, int axis, double level, const double* low,
                       const double* high) {
  const double step = 0.05;
  const int u = axis == 0 ? 1 : 0, w = axis == 2 ? 1 : 2;
  double far = 0, a, b;
  for (a = low[0]; a < high[0]; a += step)
    for (b = low[1]; b < high[1]; b += step) {
      double near = HUGE_VAL;
      int64_t i;
      for (i = 0; i < v->n; ++i) {
        const double* x = v->xyz + 3 * i;
        if (v->tags[i] == 0 || fabs(x[axis] - level) > 1e-9) continue;
        near = fmin(near, hypot(x[u] - a, x[w] - b));
      }
      far = fmax(far, near);
    }
  return far;
}

START_TEST(no_vacancies_beside_a_wall) {
  static const double spacings[] = {0.8, 0.9};
  const double low[] = {0, 4}, high[] = {16, 10}, d = spacings[_i];
  volume v;
  job it = body_job(tee);
  MUST(pnpbs_placement_set_spacing_constant(it.placement, d));
  MUST_COMPUTE(pnpbs_placement_run(it.placement));
  v = volume_of(it.placement);
  ck_assert_double_lt(farthest(&v, 1, 9, low, high), 0.93 * d);
  ck_assert_double_lt(farthest(&v, 1, 9.4, low, high), 0.93 * d);
  volume_free(&v);
  job_end(&it);
}
END_TEST

/* ---------------------------------------------------------------- ways to drive it ------ */

typedef struct {
  int calls, stop_at;
  double last;
} watch;

static int32_t watching(double fraction, int64_t step, int64_t nodes, double max_speed,
                        void* user) {
  watch* w = user;
  (void)step, (void)nodes, (void)max_speed;
  ck_assert_double_ge(fraction, w->last);
  ck_assert_double_le(fraction, 1);
  w->last = fraction;
  return ++w->calls > w->stop_at;
}

/* The monitor stops on a coarser level, on the surfaces or inside. The nodes must form a
 * triangulation of the body in each case. */
START_TEST(stopped_by_the_monitor) {
  static const int stops[] = {0, 1, 2, 4, 6};
  struct volume_spacing spacing = VOLUME_GRADED(0.05, 0.1, 0, 0, 0);
  job it = body_job(volume_unit_box);
  watch w = {0, 0, 0};
  w.stop_at = stops[_i];
  MUST(pnpbs_placement_set_spacing_callback(it.placement, volume_spacing_at, &spacing));
  MUST(pnpbs_placement_set_monitor(it.placement, watching, &w));
  MUST_BE(PNPBS_STOPPED, pnpbs_placement_run(it.placement));
  ck_assert_int_eq(w.calls, stops[_i] + 1);
  if (integer_of(it.placement, "nodes") > 0) check_stopped_body(&it, 1e-12);
  w.stop_at = 1000000;
  w.last = 0;
  /* The mean may be off for the few edges where d is largest, so the status is not restricted. */
  ck_assert_int_ge(pnpbs_placement_run(it.placement), 0);
  check_body(&it, 1e-12);
  job_end(&it);
}
END_TEST

typedef struct {
  int64_t nodes[64];
  int calls;
} told_nodes;

static int32_t telling_nodes(double fraction, int64_t step, int64_t nodes, double max_speed,
                             void* user) {
  told_nodes* told = user;
  (void)fraction, (void)step, (void)max_speed;
  ck_assert_int_lt(told->calls, 64);
  told->nodes[told->calls++] = nodes;
  return 0;
}

/* Returns the numbers of nodes that the monitor receives while a level follows a coarse one. The
 * coarse level has changed `changes` times before, and its nodes were requested if `ask` is set. */
static told_nodes told_of_the_next_level(int changes, int ask) {
  struct volume_spacing spacing = VOLUME_GRADED(0.1, 0.1, 0, 0, 0);
  job it = body_job(volume_unit_box);
  told_nodes told = {{0}, 0};
  int64_t nodes;
  MUST(pnpbs_placement_set(it.placement, "event_interval", "1"));
  MUST(pnpbs_placement_set_spacing_constant(it.placement, 0.25));
  MUST(pnpbs_placement_initialise(it.placement));
  while (changes-- > 0) MUST_COMPUTE(pnpbs_placement_step(it.placement, 0));
  if (ask) {
    MUST(pnpbs_placement_count(it.placement, &nodes));
    MUST(pnpbs_placement_get_nodes(it.placement, nodes, NULL, NULL, NULL, NULL));
  }
  MUST(pnpbs_placement_set_spacing_callback(it.placement, volume_spacing_at, &spacing));
  MUST(pnpbs_placement_set_monitor(it.placement, telling_nodes, &told));
  MUST(pnpbs_placement_initialise(it.placement));
  job_end(&it);
  return told;
}

/* Cached data of one level must not be used for another level that has changed as many times, while
 * its surfaces settle. */
START_TEST(levels_are_told_apart) {
  int changes, k;
  for (changes = 0; changes < 12; ++changes) {
    const told_nodes expected = told_of_the_next_level(changes, 0),
                     told = told_of_the_next_level(changes, 1);
    ck_assert_int_gt(expected.calls, 3);
    ck_assert_int_eq(told.calls, expected.calls);
    for (k = 0; k < told.calls; ++k) ck_assert_int_eq(told.nodes[k], expected.nodes[k]);
  }
}
END_TEST

START_TEST(by_steps) {
  job it = box_job(0.15);
  int64_t inserted = -1, deleted = -1, before;
  int k;
  MUST(pnpbs_placement_set(it.placement, "tolerance_mean", "0")); /* so that it never rests */
  MUST(pnpbs_placement_initialise(it.placement));
  check_body(&it, 1e-12);
  before = integer_of(it.placement, "steps"); /* steps that settled the surfaces */
  for (k = 0; k < 3; ++k) {
    MUST_COMPUTE(pnpbs_placement_step(it.placement, 7));
    ck_assert_int_eq(integer_of(it.placement, "steps"), before + 7 * (k + 1));
    check_body(&it, 1e-12);
  }
  MUST(pnpbs_placement_adjust_population(it.placement, &inserted, &deleted));
  ck_assert_int_ge(inserted, 0);
  ck_assert_int_ge(deleted, 0);
  MUST(pnpbs_placement_rebalance(it.placement));
  check_body(&it, 1e-12);
  job_end(&it);
}
END_TEST

/* If d becomes so much smaller that nearly all inner nodes are added by filling gaps, these count
 * as inserted. */
START_TEST(fills_count_as_inserted) {
  job it = box_job(0.5);
  int64_t before, after;
  MUST(pnpbs_placement_initialise(it.placement));
  before = integer_of(it.placement, "nodes") - integer_of(it.placement, "boundary_nodes");
  MUST(pnpbs_placement_set_spacing_constant(it.placement, 0.15));
  MUST_COMPUTE(pnpbs_placement_step(it.placement, 1));
  after = integer_of(it.placement, "nodes") - integer_of(it.placement, "boundary_nodes");
  ck_assert_int_gt(after, before + 150);
  /* Further nodes are inserted on the surfaces. */
  ck_assert_int_ge(integer_of(it.placement, "inserted"), after - before);
  ck_assert_int_eq(integer_of(it.placement, "deleted"), 0);
  check_body(&it, 1e-12);
  job_end(&it);
}
END_TEST

/* Given nodes are the points of a cubic lattice, half of which lie outside. Nodes keep their ids.
 */
START_TEST(given_nodes) {
  enum { ROW = 12, ALL = ROW * ROW * ROW };
  double* xyz = malloc(3 * ALL * sizeof *xyz);
  int64_t* ids = malloc(ALL * sizeof *ids);
  job it = box_job(0.16);
  volume v;
  int64_t k, kept = 0;
  for (k = 0; k < ALL; ++k) {
    xyz[3 * k] = 0.16 * (double)(k % ROW) + 0.08;
    xyz[3 * k + 1] = 0.16 * (double)(k / ROW % ROW) + 0.085;
    xyz[3 * k + 2] = 0.16 * (double)(k / (ROW * ROW)) + 0.09;
    ids[k] = 7 * k;
  }
  MUST(pnpbs_placement_set_nodes(it.placement, ALL, xyz, ids));
  MUST(pnpbs_placement_initialise(it.placement));
  check_body(&it, 1e-12);
  ck_assert_int_gt(integer_of(it.placement, "dropped"), ALL / 2);
  v = volume_of(it.placement);
  for (k = 0; k < v.n; ++k)
    if (v.ids[k] % 7 == 0 && v.ids[k] < 7 * ALL && v.tags[k] == 0) {
      ck_assert_double_eq(distance(v.xyz + 3 * k, xyz + 3 * (v.ids[k] / 7)), 0);
      ++kept;
    }
  ck_assert_int_gt(kept, 100);
  volume_free(&v);
  MUST_COMPUTE(pnpbs_placement_run(it.placement));
  check_body(&it, 1e-12);
  free(xyz), free(ids);
  job_end(&it);
}
END_TEST

/* ---------------------------------------------------------------- adapting -------------- */

START_TEST(values_at_nodes) {
  job it = box_job(0.2);
  volume v;
  int64_t i;
  MUST_COMPUTE(pnpbs_placement_run(it.placement));
  v = volume_of(it.placement);
  for (i = 0; i < v.n; ++i) v.d[i] = 0.1;
  MUST_BE(PNPBS_ERROR_ARGUMENT, pnpbs_placement_set_spacing_at_nodes(it.placement, v.n - 1, v.d));
  MUST(pnpbs_placement_set_spacing_at_nodes(it.placement, v.n, v.d));
  MUST_COMPUTE(pnpbs_placement_run(it.placement));
  check_body(&it, 1e-12);
  ck_assert_double_eq_tol(real_of(it.placement, "edge.mean"), 1, 0.06);
  ck_assert_int_gt(integer_of(it.placement, "nodes"), 5 * v.n);
  volume_free(&v);
  job_end(&it);
}
END_TEST

/* Returns the number of nodes with the same id in both. Each of them must have moved by at most
 * `most`. */
static int64_t kept_ids(const volume* before, const volume* after, double most) {
  int64_t i, j = 0, kept = 0;
  for (i = 0; i < before->n; ++i) {
    while (j < after->n && after->ids[j] < before->ids[i]) ++j;
    if (j == after->n || after->ids[j] != before->ids[i]) continue;
    ck_assert_double_le(distance(before->xyz + 3 * i, after->xyz + 3 * j), most);
    ++kept;
  }
  return kept;
}

static int64_t id_at(const volume* v, double x, double y, double z) {
  const double xyz[] = {x, y, z};
  int64_t i;
  for (i = 0; i < v->n; ++i)
    if (distance(v->xyz + 3 * i, xyz) == 0) return v->ids[i];
  return -1;
}

/* d becomes finer by two in a corner and coarser elsewhere. */
START_TEST(another_spacing) {
  struct volume_spacing corner = VOLUME_GRADED(0.07, 0.08, 1, 1, 1);
  job it = box_job(0.1);
  volume before, after;
  int k;
  MUST_COMPUTE(pnpbs_placement_run(it.placement));
  before = volume_of(it.placement);
  MUST(pnpbs_placement_set_spacing_callback(it.placement, volume_spacing_at, &corner));
  ck_assert_int_ge(pnpbs_placement_run(it.placement), 0);
  check_body(&it, 1e-12);
  after = volume_of(it.placement);
  for (k = 0; k < 8; ++k)
    ck_assert_int_eq(id_at(&before, k & 1, k >> 1 & 1, k >> 2),
                     id_at(&after, k & 1, k >> 1 & 1, k >> 2));
  ck_assert_int_gt(kept_ids(&before, &after, 0.5), before.n / 5);
  volume_free(&after);
  volume_free(&before);
  job_end(&it);
}
END_TEST

static void check_as_dense_as_if_new(job* adapted, double d) {
  job fresh = box_job(d);
  MUST_COMPUTE(pnpbs_placement_run(fresh.placement));
  ck_assert_double_eq_tol((double)integer_of(adapted->placement, "nodes"),
                          (double)integer_of(fresh.placement, "nodes"),
                          0.08 * (double)integer_of(fresh.placement, "nodes"));
  ck_assert_double_eq_tol((double)integer_of(adapted->placement, "boundary_nodes"),
                          (double)integer_of(fresh.placement, "boundary_nodes"),
                          0.08 * (double)integer_of(fresh.placement, "boundary_nodes"));
  ck_assert_double_eq_tol(real_of(adapted->placement, "edge.mean"), 1, 0.06);
  ck_assert_double_gt(real_of(adapted->placement, "quality.mean"), 0.88);
  ck_assert_double_gt(real_of(adapted->placement, "quality.min_angle"), 20);
  job_end(&fresh);
}

/* d becomes finer and coarser by more and by less than two. The nodes follow on the surface and
 * inside. */
START_TEST(d_is_followed_up_and_down) {
  const double spacings[] = {0.065, 0.15, 0.1, 0.08};
  job it = box_job(0.15);
  int k;
  MUST_COMPUTE(pnpbs_placement_run(it.placement));
  for (k = 0; k < 4; ++k) {
    MUST(pnpbs_placement_set_spacing_constant(it.placement, spacings[k]));
    MUST_COMPUTE(pnpbs_placement_run(it.placement));
    check_body(&it, 1e-12);
    check_as_dense_as_if_new(&it, spacings[k]);
  }
  job_end(&it);
}
END_TEST

/* Nodes stay if d stays. */
START_TEST(the_same_spacing_again) {
  job it = box_job(0.12);
  volume before, after;
  MUST_COMPUTE(pnpbs_placement_run(it.placement));
  before = volume_of(it.placement);
  MUST(pnpbs_placement_set_spacing_constant(it.placement, 0.12));
  MUST_COMPUTE(pnpbs_placement_run(it.placement));
  check_body(&it, 1e-12);
  after = volume_of(it.placement);
  ck_assert_int_gt(kept_ids(&before, &after, 0.12), before.n * 9 / 10);
  volume_free(&before), volume_free(&after);
  job_end(&it);
}
END_TEST

START_TEST(growth_is_limited) {
  struct volume_spacing jump = {0.3, 0, {0, 0, 0}, 0.5, 0.06};
  job limited = body_job(volume_unit_box), steep = body_job(volume_unit_box);
  MUST(pnpbs_placement_set_spacing_callback(limited.placement, volume_spacing_at, &jump));
  ck_assert_int_ge(pnpbs_placement_run(limited.placement), 0);
  ck_assert_int_ge(warnings_with(limited.placement, "per unit of length"), 1);
  check_body(&limited, 1e-12);
  MUST(pnpbs_placement_set_spacing_callback(steep.placement, volume_spacing_at, &jump));
  MUST(pnpbs_placement_set(steep.placement, "growth_limit", "0"));
  MUST(pnpbs_placement_set(steep.placement, "conforming_rounds", "0"));
  ck_assert_int_ge(pnpbs_placement_run(steep.placement), 0);
  ck_assert_int_gt(integer_of(limited.placement, "nodes"), integer_of(steep.placement, "nodes"));
  job_end(&limited);
  job_end(&steep);
}
END_TEST

TEST_SUITE(test_volumes) {
  Suite* suite = suite_create("volumes");
  TCase* tests = tcase_create("volumes");
  tcase_set_timeout(tests, 0);
  tcase_add_test(tests, a_box);
  tcase_add_test(tests, adjacency_by_distance);
  tcase_add_loop_test(tests, bodies, 0, WHEN_SANITIZED(2, 5));
  tcase_add_test(tests, functions_of_the_other_dimension);
  tcase_add_loop_test(tests, spacings_far_larger_than_the_body, 0, 4);
  tcase_add_test(tests, bad_spacings);
  tcase_add_test(tests, too_many_nodes);
  tcase_add_loop_test(tests, fine_in_a_small_place, 0,
                      WHEN_SANITIZED(2, sizeof fine_places / sizeof *fine_places));
  tcase_add_loop_test(tests, bodies_that_the_spacing_does_not_resolve, 0, 6);
  tcase_add_loop_test(tests, bodies_far_from_the_origin, 0, WHEN_SANITIZED(1, 4));
  if (WHEN_SANITIZED(0, 1)) tcase_add_test(tests, flat_sides_follow_the_surface);
  if (WHEN_SANITIZED(0, 1)) tcase_add_test(tests, fine_at_a_line_in_a_low_box);
  if (WHEN_SANITIZED(0, 1)) tcase_add_test(tests, walls_as_thick_as_d);
  tcase_add_test(tests, walls_of_two_d);
  tcase_add_test(tests, coarse_at_the_edges_of_a_box);
  tcase_add_test(tests, too_few_nodes_in_a_wall);
  if (WHEN_SANITIZED(0, 1)) tcase_add_test(tests, distances_of_repairs_are_statistics);
  tcase_add_loop_test(tests, no_vacancies_beside_a_wall, 0, WHEN_SANITIZED(1, 2));
  tcase_add_loop_test(tests, stopped_by_the_monitor, 0, WHEN_SANITIZED(3, 5));
  tcase_add_loop_test(tests, inner_primitives, 0, 3);
  tcase_add_test(tests, by_steps);
  tcase_add_test(tests, levels_are_told_apart);
  tcase_add_test(tests, fills_count_as_inserted);
  tcase_add_test(tests, given_nodes);
  tcase_add_test(tests, values_at_nodes);
  tcase_add_test(tests, another_spacing);
  if (WHEN_SANITIZED(0, 1)) tcase_add_test(tests, d_is_followed_up_and_down);
  tcase_add_test(tests, the_same_spacing_again);
  if (WHEN_SANITIZED(0, 1)) tcase_add_test(tests, growth_is_limited);
  suite_add_tcase(suite, tests);
  return run_suite(suite);
}
