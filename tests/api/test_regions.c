/* SPDX-License-Identifier: BSD-3-Clause
 *
 * Tests regions with tags: elements on either side of inner curves and surfaces, which d may not
 * resolve, and invalid input.
 */
#include "volume_support.h"

/* ---------------------------------------------------------------- elements -------------- */

typedef struct {
  int64_t n;
  int corners, dim;
  double* x;     /* [n][corners][dim] */
  int64_t* rows; /* [n][corners] */
  int32_t* tags;
} elements;

static elements elements_of(const job* it, int dim) {
  elements e = {0, dim + 1, dim, NULL, NULL, NULL};
  int64_t nodes, n, k, *rows;
  double* x;
  pnpbs_status (*get)(pnpbs_placement, int64_t, int64_t*, int64_t*) =
      dim == 2 ? pnpbs_placement_get_triangles : pnpbs_placement_get_tetrahedra;
  MUST(pnpbs_placement_count(it->placement, &nodes));
  MUST(get(it->placement, 0, &e.n, NULL));
  MUST(pnpbs_placement_get_element_tags(it->placement, 0, &n, NULL));
  ck_assert_int_eq(n, e.n);
  rows = malloc((size_t)(e.n * e.corners) * sizeof *rows);
  x = malloc((size_t)(nodes * dim) * sizeof *x);
  e.x = malloc((size_t)(e.n * e.corners * dim) * sizeof *e.x);
  e.tags = malloc((size_t)e.n * sizeof *e.tags);
  ck_assert(rows && x && e.x && e.tags);
  MUST(get(it->placement, e.n, &e.n, rows));
  MUST(pnpbs_placement_get_nodes(it->placement, nodes, x, NULL, NULL, NULL));
  MUST(pnpbs_placement_get_element_tags(it->placement, e.n, &e.n, e.tags));
  for (k = 0; k < e.n * e.corners; ++k)
    memcpy(e.x + k * dim, x + rows[k] * dim, (size_t)dim * sizeof *x);
  e.rows = rows;
  free(x);
  return e;
}

static void elements_free(elements* e) {
  free(e->x);
  free(e->rows);
  free(e->tags);
}

static double measure(const elements* e, int64_t k) {
  const double* x = e->x + k * e->corners * e->dim;
  double a[3] = {0, 0, 0}, b[3] = {0, 0, 0}, c[3] = {0, 0, 1};
  int i;
  for (i = 0; i < e->dim; ++i) {
    a[i] = x[e->dim + i] - x[i];
    b[i] = x[2 * e->dim + i] - x[i];
    if (e->dim == 3) c[i] = x[9 + i] - x[i];
  }
  return ((a[1] * b[2] - a[2] * b[1]) * c[0] + (a[2] * b[0] - a[0] * b[2]) * c[1] +
          (a[0] * b[1] - a[1] * b[0]) * c[2]) /
         (e->dim == 2 ? 2 : 6);
}

static double measure_with(const elements* e, int32_t tag) {
  double sum = 0;
  int64_t k;
  for (k = 0; k < e->n; ++k)
    if (e->tags[k] == tag) sum += measure(e, k);
  return sum;
}

static void centre(const elements* e, int64_t k, double* x) {
  int i, c;
  for (i = 0; i < e->dim; ++i) {
    x[i] = 0;
    for (c = 0; c < e->corners; ++c) x[i] += e->x[(k * e->corners + c) * e->dim + i] / e->corners;
  }
}

/* Checks that the elements of the distributed mesh have the same tags, in any order. */
static void check_mesh(const job* it, const elements* e, int32_t tag) {
  pnpbs_mesh mesh;
  int64_t n, k, with_tag = 0, expected = 0;
  int32_t* tags;
  MUST(pnpbs_mesh_create(it->placement, 0, &mesh));
  MUST(pnpbs_mesh_sizes(mesh, NULL, NULL, NULL, NULL, &n, NULL, NULL));
  ck_assert_int_eq(n, e->n);
  tags = malloc((size_t)n * sizeof *tags);
  ck_assert_ptr_nonnull(tags);
  MUST(pnpbs_mesh_get_elements(mesh, n, NULL, NULL, NULL, tags));
  for (k = 0; k < n; ++k) {
    with_tag += tags[k] == tag;
    expected += e->tags[k] == tag;
  }
  ck_assert_int_eq(with_tag, expected);
  free(tags);
  MUST(pnpbs_mesh_destroy(&mesh));
}

static int64_t nodes_with(const elements* e, int32_t tag) {
  int64_t k, most = 0, count = 0;
  char* seen;
  for (k = 0; k < e->n * e->corners; ++k) most = e->rows[k] > most ? e->rows[k] : most;
  seen = calloc((size_t)most + 1, 1);
  ck_assert_ptr_nonnull(seen);
  for (k = 0; k < e->n * e->corners; ++k)
    if (e->tags[k / e->corners] == tag && !seen[e->rows[k]]) {
      seen[e->rows[k]] = 1;
      ++count;
    }
  free(seen);
  return count;
}

/* Checks the figures of all regions against their elements. There are at most eight. */
static void check_figures(const job* it, const elements* e) {
  int32_t tags[8];
  int64_t regions, nodes[8], counts[8], all = 0, k, r;
  double measures[8];
  MUST(pnpbs_placement_get_regions(it->placement, 0, &regions, NULL, NULL, NULL, NULL));
  ck_assert_int_le(regions, 8);
  MUST(pnpbs_placement_get_regions(it->placement, 8, &regions, tags, nodes, counts, measures));
  for (r = 0; r < regions; ++r) {
    int64_t with_tag = 0;
    if (r > 0) ck_assert_int_lt(tags[r - 1], tags[r]);
    for (k = 0; k < e->n; ++k) with_tag += e->tags[k] == tags[r];
    ck_assert_int_gt(with_tag, 0);
    ck_assert_int_eq(counts[r], with_tag);
    ck_assert_int_eq(nodes[r], nodes_with(e, tags[r]));
    ck_assert_double_eq_tol(measures[r], measure_with(e, tags[r]), 1e-12);
    all += with_tag;
  }
  ck_assert_int_eq(all, e->n);
  MUST_FAIL(PNPBS_ERROR_CAPACITY,
            pnpbs_placement_get_regions(it->placement, regions - 1, &k, tags, NULL, NULL, NULL),
            "capacity", "are needed");
}

static job placed(job it, double d) {
  job_place(&it);
  MUST(pnpbs_placement_set(it.placement, "steps", "60"));
  MUST(pnpbs_placement_set_spacing_constant(it.placement, d));
  MUST_COMPUTE(pnpbs_placement_run(it.placement));
  return it;
}

/* ---------------------------------------------------------------- in the plane ---------- */

/* The domain has three strips, one of them without a tag, and a disc in the middle. */
START_TEST(strips_and_a_disc) {
  const double left[4] = {1, 0, 1, 1}, right[4] = {2, 0, 2, 1},
               in[3][2] = {{0.1, 0.5}, {2.9, 0.9}, {1.5, 0.5}};
  const double d = _i == 0 ? 0.03 : 0.3, r = 0.3;
  job it = job_begin();
  elements e;
  int64_t k;
  add_rectangle(it.domain, PNPBS_BOUNDARY, 0, 0, 3, 1, 1);
  MUST(pnpbs_domain_add_polyline(it.domain, PNPBS_INNER, 0, 2, left, NULL, 0));
  MUST(pnpbs_domain_add_polyline(it.domain, PNPBS_INNER, 0, 2, right, NULL, 0));
  add_circle(it.domain, PNPBS_INNER, 1.5, 0.5, r, 4);
  MUST(pnpbs_domain_add_region(it.domain, in[0], 30));
  MUST(pnpbs_domain_add_region(it.domain, in[1], -70));
  MUST(pnpbs_domain_add_region(it.domain, in[2], 5));
  MUST(pnpbs_domain_add_region(it.domain, in[2], 5)); /* repeats the same tag for the same region */
  it = placed(it, d);
  e = elements_of(&it, 2);
  ck_assert_double_eq_tol(measure_with(&e, 30), 1, 1e-12);
  ck_assert_double_eq_tol(measure_with(&e, -70), 1, 1e-12);
  ck_assert_double_eq_tol(measure_with(&e, 0) + measure_with(&e, 5), 1, 1e-12);
  ck_assert_double_eq_tol(measure_with(&e, 5), PI * r * r, 0.6 * d * d);
  for (k = 0; k < e.n; ++k) {
    double x[2], from;
    centre(&e, k, x);
    from = hypot(x[0] - 1.5, x[1] - 0.5);
    ck_assert_int_eq(e.tags[k], x[0] < 1 ? 30 : x[0] > 2 ? -70 : from < r ? 5 : 0);
  }
  check_figures(&it, &e);
  check_mesh(&it, &e, 5);
  check_mesh(&it, &e, -70);
  elements_free(&e);
  job_end(&it);
}
END_TEST

/* Points in and beside the domain, on both sides of interfaces, and the errors. */
START_TEST(regions_at_points) {
  const double wall[4] = {1, 0, 1, 1}, in[2] = {0.1, 0.5};
  const double x[10] = {0.2, 0.2, 1.8, 0.9, 0.999, 0.5, 1.001, 0.5, -3, 0.5};
  int32_t tags[5];
  int k;
  job it = job_begin();
  add_rectangle(it.domain, PNPBS_BOUNDARY, 0, 0, 2, 1, 1);
  MUST(pnpbs_domain_add_polyline(it.domain, PNPBS_INNER, 0, 2, wall, NULL, 0));
  MUST_FAIL(PNPBS_ERROR_ARGUMENT, pnpbs_domain_regions_at(it.domain, 5, x, 1, tags), "no region",
            "pnpbs_domain_add_region");
  MUST(pnpbs_domain_add_region(it.domain, in, 3));
  MUST(pnpbs_domain_regions_at(it.domain, 5, x, 1, tags));
  ck_assert_int_eq(tags[0], 3);
  ck_assert_int_eq(tags[1], 0);
  ck_assert_int_eq(tags[2], 3);
  ck_assert_int_eq(tags[3], 0);
  ck_assert_int_eq(tags[4], 3);
  for (k = 0; k < 3; ++k) { /* beside and on the interface, and away from it */
    const double at[2] = {k == 0 ? 1 - 1e-6 : k == 1 ? 1 : 0.9, 0.5};
    MUST(pnpbs_domain_regions_at(it.domain, 1, at, 3, tags));
    ck_assert_int_eq(tags[0] + tags[1], k < 2 ? 3 : 6);
    ck_assert_int_eq(tags[2], tags[0]);
  }
  MUST(pnpbs_domain_regions_at(it.domain, 0, NULL, 1, NULL));
  MUST_FAIL(PNPBS_ERROR_ARGUMENT, pnpbs_domain_regions_at(it.domain, -1, x, 1, tags), "n = -1",
            "negative");
  MUST_FAIL(PNPBS_ERROR_ARGUMENT, pnpbs_domain_regions_at(it.domain, 1, x, 0, tags), "columns",
            "0");
  MUST_FAIL(PNPBS_ERROR_ARGUMENT, pnpbs_domain_regions_at(it.domain, 1, NULL, 1, tags),
            "coordinates", "NULL");
  MUST_FAIL(PNPBS_ERROR_ARGUMENT, pnpbs_domain_regions_at(it.domain, 1, x, 1, NULL), "tags",
            "NULL");
  job_end(&it);
}
END_TEST

/* A callback gets d from the region of a point. */
static int32_t d_by_region(int64_t n, int32_t dim, const double* x, double* d, void* user) {
  int64_t i;
  for (i = 0; i < n; ++i) {
    int32_t tags[2];
    if (pnpbs_domain_regions_at(*(pnpbs_domain*)user, 1, x + dim * i, 2, tags) < 0) return 1;
    d[i] = tags[0] == 2 || tags[1] == 2 ? 0.1 : 0.16;
  }
  return 0;
}

START_TEST(spacing_by_region) {
  const double low[2][3] = {{0, 0, 0}, {1, 0, 0}}, high[2][3] = {{1, 1, 1}, {2, 1, 1}};
  int64_t regions, counts[2];
  int32_t tags[2];
  double measures[2];
  job it = {NULL, NULL, NULL};
  MUST(pnpbs_context_create_serial(&it.context));
  MUST(pnpbs_domain_create(it.context, 3, &it.domain));
  MUST(pnpbs_domain_add_box(it.domain, low[0], high[0], 1));
  MUST(pnpbs_domain_add_box(it.domain, low[1], high[1], 1));
  MUST(pnpbs_domain_regions_at(it.domain, 0, NULL, 1, NULL));
  job_place(&it);
  MUST(pnpbs_placement_set_spacing_callback(it.placement, d_by_region, &it.domain));
  ck_assert_int_ge(pnpbs_placement_run(it.placement), 0); /* d jumps, which nodes may not follow */
  MUST(pnpbs_placement_get_regions(it.placement, 2, &regions, tags, NULL, counts, measures));
  ck_assert_int_eq(regions, 2);
  ck_assert_double_eq_tol(measures[0], 1, 1e-12);
  ck_assert_double_eq_tol(measures[1], 1, 1e-12);
  ck_assert_int_gt(counts[1],
                   2 * counts[0]); /* (0.16 / 0.1)^3 is 4; beside the interface d grows */
  job_end(&it);
}
END_TEST

/* Only three nodes lie on the circle. */
START_TEST(disc_that_d_does_not_resolve) {
  const double middle[2] = {0, 0}, r = 0.3;
  job it = job_begin();
  elements e;
  int64_t k;
  int c;
  add_rectangle(it.domain, PNPBS_BOUNDARY, -4, -4, 4, 4, 1);
  add_circle(it.domain, PNPBS_INNER, 0, 0, r, 4);
  MUST(pnpbs_domain_add_region(it.domain, middle, 5));
  it = placed(it, 0.63);
  e = elements_of(&it, 2);
  for (k = 0; k < e.n; ++k) {
    int in_disc = 1;
    for (c = 0; c < 3; ++c) {
      const double* x = e.x + 6 * k + 2 * c;
      in_disc = in_disc && hypot(x[0], x[1]) < r + 1e-9;
    }
    ck_assert_int_eq(e.tags[k], in_disc ? 5 : 0);
  }
  ck_assert_double_gt(measure_with(&e, 5), 0);
  elements_free(&e);
  job_end(&it);
}
END_TEST

/* The ring is so narrow that centroids of elements lie in the hole. */
START_TEST(ring_that_d_does_not_resolve) {
  const double in[2] = {1.1, 0};
  job it = job_begin();
  elements e;
  int64_t k, beside = 0;
  add_circle(it.domain, PNPBS_BOUNDARY, 0, 0, 1, 1);
  add_circle(it.domain, PNPBS_BOUNDARY, 0, 0, 1.2, 2);
  MUST(pnpbs_domain_add_region(it.domain, in, 3));
  it = placed(it, 1);
  e = elements_of(&it, 2);
  for (k = 0; k < e.n; ++k) {
    double x[2];
    centre(&e, k, x);
    beside += hypot(x[0], x[1]) < 1;
    ck_assert_int_eq(e.tags[k], 3);
  }
  ck_assert_int_gt(beside, 0);
  elements_free(&e);
  job_end(&it);
}
END_TEST

/* If the domain changes after a run, the elements keep their tags until the next initialise. */
START_TEST(tags_stay_with_the_elements) {
  const double in[2] = {0.5, 0.5};
  job it = square_job(1);
  elements e;
  MUST(pnpbs_domain_add_region(it.domain, in, 3));
  MUST(pnpbs_placement_set_spacing_constant(it.placement, 0.2));
  MUST_COMPUTE(pnpbs_placement_run(it.placement));
  e = elements_of(&it, 2);
  ck_assert_double_eq_tol(measure_with(&e, 3), 1, 1e-12);
  elements_free(&e);
  MUST(pnpbs_domain_add_region(it.domain, in, 4));
  e = elements_of(&it, 2);
  ck_assert_double_eq_tol(measure_with(&e, 3), 1, 1e-12);
  elements_free(&e);
  job_end(&it);
}
END_TEST

/* ---------------------------------------------------------------- in space -------------- */

static void add_inner_ball(pnpbs_domain domain, const double* middle, double radius) {
  MUST(pnpbs_domain_add_ball(domain, middle, radius, 9));
  MUST(pnpbs_domain_set_role(domain, 9, PNPBS_INNER));
}

static void add_quad(int64_t* corners, int64_t* count, int64_t a, int64_t b, int64_t c, int64_t d) {
  const int64_t quad[6] = {a, b, c, a, c, d};
  memcpy(corners + 3 * *count, quad, sizeof quad);
  *count += 2;
}

/* Adds the box [0, 2] x [0, 1]^2, divided by a wall at x = 1. Vertex i + 3 j + 6 k is at (i, j, k).
 */
static void add_divided_box(pnpbs_domain domain) {
  double x[36];
  int64_t corners[66], count = 0, v, i;
  int32_t tags[22];
  for (v = 0; v < 12; ++v) {
    x[3 * v] = (double)(v % 3);
    x[3 * v + 1] = (double)(v / 3 % 2);
    x[3 * v + 2] = (double)(v / 6);
  }
  for (i = 0; i < 3; ++i) add_quad(corners, &count, i, i + 3, i + 9, i + 6);
  for (i = 0; i < 2; ++i) {
    add_quad(corners, &count, i, i + 1, i + 7, i + 6);
    add_quad(corners, &count, i + 3, i + 4, i + 10, i + 9);
    add_quad(corners, &count, i, i + 1, i + 4, i + 3);
    add_quad(corners, &count, i + 6, i + 7, i + 10, i + 9);
  }
  for (i = 0; i < count; ++i) tags[i] = i == 2 || i == 3 ? 40 : 1;
  MUST(pnpbs_domain_add_surface(domain, PNPBS_BOUNDARY, 12, x, count, corners, tags, 40));
  MUST(pnpbs_domain_set_role(domain, 40, PNPBS_INNER));
}

/* A wall divides a box, and each half contains a ball, one of which d hardly resolves. */
START_TEST(box_with_wall_and_balls) {
  const double middles[2][3] = {{0.5, 0.5, 0.5}, {1.5, 0.5, 0.5}}, outside[3] = {0.05, 0.05, 0.05};
  const double radii[2] = {0.3, 0.15};
  job it = {NULL, NULL, NULL};
  elements e;
  int64_t k;
  int b;
  MUST(pnpbs_context_create_serial(&it.context));
  MUST(pnpbs_domain_create(it.context, 3, &it.domain));
  add_divided_box(it.domain);
  for (b = 0; b < 2; ++b) {
    add_inner_ball(it.domain, middles[b], radii[b]);
    MUST(pnpbs_domain_add_region(it.domain, middles[b], 10 + b));
  }
  MUST(pnpbs_domain_add_region(it.domain, outside, 20));
  it = placed(it, 0.13);
  e = elements_of(&it, 3);
  ck_assert_double_eq_tol(measure_with(&e, 20) + measure_with(&e, 10), 1, 1e-12);
  ck_assert_double_eq_tol(measure_with(&e, 0) + measure_with(&e, 11), 1, 1e-12);
  ck_assert_double_eq_tol(measure_with(&e, 10), 4 * PI / 3 * 0.027, 0.012);
  ck_assert_double_eq_tol(measure_with(&e, 11), 4 * PI / 3 * 0.003375, 0.006);
  for (k = 0; k < e.n; ++k) {
    double x[3];
    centre(&e, k, x);
    ck_assert_int_eq(e.tags[k] == 20 || e.tags[k] == 10, x[0] < 1);
    for (b = 0; b < 2; ++b) {
      const double r = distance(x, middles[b]);
      if (r < 0.6 * radii[b]) ck_assert_int_eq(e.tags[k], 10 + b);
      if (r > radii[b]) ck_assert_int_ne(e.tags[k], 10 + b);
    }
  }
  check_mesh(&it, &e, 10);
  check_mesh(&it, &e, 0);
  elements_free(&e);
  job_end(&it);
}
END_TEST

/* A hole point removes an inner ball. Its triangles are then reversed, and so are the tags of their
 * sides. */
START_TEST(box_without_a_ball) {
  const double low[3] = {0, 0, 0}, high[3] = {1, 1, 1}, middle[3] = {0.5, 0.5, 0.5},
               in[3] = {0.05, 0.05, 0.05};
  job it = {NULL, NULL, NULL};
  elements e;
  int64_t k;
  MUST(pnpbs_context_create_serial(&it.context));
  MUST(pnpbs_domain_create(it.context, 3, &it.domain));
  MUST(pnpbs_domain_add_box(it.domain, low, high, 1));
  add_inner_ball(it.domain, middle, 0.3);
  MUST(pnpbs_domain_add_hole(it.domain, middle));
  MUST(pnpbs_domain_add_region(it.domain, in, 20));
  it = placed(it, 0.15);
  e = elements_of(&it, 3);
  ck_assert_int_gt(e.n, 100);
  for (k = 0; k < e.n; ++k) ck_assert_int_eq(e.tags[k], 20);
  elements_free(&e);
  job_end(&it);
}
END_TEST

/* ---------------------------------------------------------------- solids ---------------- */

static job solids_job(void) {
  job it = {NULL, NULL, NULL};
  MUST(pnpbs_context_create_serial(&it.context));
  MUST(pnpbs_domain_create(it.context, 3, &it.domain));
  return it;
}

/* A box of 1 x .7 x .5 stands on one of 2 x 2 x 1, with its own triangles. Another one touches the
 * sides of both. */
START_TEST(boxes_that_touch) {
  const double low[3][3] = {{0, 0, 0}, {0.3, 0.3, 1}, {2, 0.3, 0.2}},
               high[3][3] = {{2, 2, 1}, {1.3, 1, 1.5}, {2.5, 0.9, 0.8}};
  job it = solids_job();
  elements e;
  int b;
  for (b = 0; b < 3; ++b) MUST(pnpbs_domain_add_box(it.domain, low[b], high[b], 10 + b));
  it = placed(it, 0.2);
  e = elements_of(&it, 3);
  ck_assert_double_eq_tol(measure_with(&e, 1), 4, 1e-12);
  ck_assert_double_eq_tol(measure_with(&e, 2), 0.35, 1e-12);
  ck_assert_double_eq_tol(measure_with(&e, 3), 0.18, 1e-12);
  check_mesh(&it, &e, 2);
  MUST(pnpbs_placement_check(it.placement));
  elements_free(&e);
  job_end(&it);
}
END_TEST

/* A box of side 1, one of side 1 shifted by half, and a small one within the overlap. The volumes
 * with the tags of each rule follow from inclusion and exclusion. */
START_TEST(boxes_that_overlap) {
  const double low[3][3] = {{0, 0, 0}, {0.5, 0.5, 0.5}, {0.6, 0.6, 0.6}},
               high[3][3] = {{1, 1, 1}, {1.5, 1.5, 1.5}, {0.9, 0.9, 0.9}};
  const double overlap = 0.125, small = 0.027;
  const struct {
    int32_t rule;
    double volumes[5]; /* with the tags 1 to 5 */
  } cases[] = {{PNPBS_OVERLAP_LAST, {1 - overlap, 1 - small, small, 0, 0}},
               {PNPBS_OVERLAP_FIRST, {1, 1 - overlap, 0, 0, 0}},
               {PNPBS_OVERLAP_OWN, {1 - overlap, 1 - overlap, 0, overlap - small, small}}};
  int c, b;
  for (c = 0; c < COUNT_OF(cases); ++c) {
    job it = solids_job();
    elements e;
    double others = 0;
    for (b = 0; b < 3; ++b) MUST(pnpbs_domain_add_box(it.domain, low[b], high[b], 10 + b));
    MUST_FAIL(PNPBS_ERROR_DOMAIN, pnpbs_domain_check(it.domain), "cross at",
              "pnpbs_domain_set_fragment");
    MUST(pnpbs_domain_set_fragment(it.domain, cases[c].rule));
    it = placed(it, 0.1);
    e = elements_of(&it, 3);
    for (b = 0; b < 5; ++b) {
      if (c == 2 && b >= 3) {
        others += measure_with(&e, b + 1);
        continue;
      }
      ck_assert_double_eq_tol(measure_with(&e, b + 1), cases[c].volumes[b], 1e-12);
    }
    if (c == 2) ck_assert_double_eq_tol(others, overlap, 1e-12);
    MUST(pnpbs_placement_check(it.placement));
    elements_free(&e);
    job_end(&it);
  }
}
END_TEST

/* A sheet that leaves a box on two sides divides it; what is outside is left out. Without a
 * fragmentation it is rejected, because it could be a body with a hole. */
START_TEST(box_with_a_sheet_across) {
  const double low[3] = {0, 0, 0}, high[3] = {1, 1, 1}, in[3] = {0.1, 0.5, 0.5};
  const double sheet[12] = {0.3, -1, -1, 0.3, 2, -1, 0.3, 2, 2, 0.3, -1, 2};
  const int64_t corners[6] = {0, 1, 2, 0, 2, 3};
  const int32_t tags[2] = {7, 7};
  job it = solids_job();
  elements e;
  MUST(pnpbs_domain_add_surface(it.domain, PNPBS_BOUNDARY, 4, sheet, 2, corners, tags, 40));
  MUST(pnpbs_domain_add_box(it.domain, low, high, 1));
  MUST_FAIL(PNPBS_ERROR_DOMAIN, pnpbs_domain_check(it.domain), "not closed",
            "pnpbs_domain_set_fragment");
  MUST(pnpbs_domain_set_fragment(it.domain, PNPBS_OVERLAP_LAST));
  MUST(pnpbs_domain_add_region(it.domain, in, 5));
  it = placed(it, 0.15);
  e = elements_of(&it, 3);
  ck_assert_double_eq_tol(measure_with(&e, 5), 0.3, 1e-12);
  ck_assert_double_eq_tol(measure_with(&e, 1), 0.7, 1e-12);
  elements_free(&e);
  job_end(&it);
}
END_TEST

/* The solids are as wide as d, so that nodes on their edges alone do not keep tetrahedra from
 * crossing their sides. */
static void add_bars(pnpbs_domain domain) {
  const double low[2][3] = {{0, 0.4, 0.4}, {0.4, 0, 0.5}},
               high[2][3] = {{1, 0.6, 0.6}, {0.6, 1, 0.7}};
  int b;
  for (b = 0; b < 2; ++b) MUST(pnpbs_domain_add_box(domain, low[b], high[b], 1));
  MUST(pnpbs_domain_set_fragment(domain, PNPBS_OVERLAP_OWN));
}

START_TEST(bars_as_wide_as_d) {
  job it = solids_job();
  elements e;
  add_bars(it.domain);
  it = placed(it, 0.2);
  e = elements_of(&it, 3);
  ck_assert_double_eq_tol(measure_with(&e, 1), 0.036, 1e-12);
  ck_assert_double_eq_tol(measure_with(&e, 2), 0.036, 1e-12);
  ck_assert_double_eq_tol(measure_with(&e, 3), 0.004, 1e-12);
  MUST(pnpbs_placement_check(it.placement));
  ck_assert_int_eq(warnings_with(it.placement, "inner surfaces"), 0);
  elements_free(&e);
  job_end(&it);
}
END_TEST

/* The nodes on a ball of radius d/2 are corners of a polyhedron, and its elements fill that. */
START_TEST(ball_as_wide_as_d) {
  const double low[3] = {0, 0, 0}, high[3] = {1, 1, 1}, middle[3] = {0.5, 0.5, 0.5};
  job it = solids_job();
  elements e;
  int64_t k;
  MUST(pnpbs_domain_add_box(it.domain, low, high, 1));
  MUST(pnpbs_domain_add_ball(it.domain, middle, 0.15, 2));
  MUST(pnpbs_domain_set_fragment(it.domain, PNPBS_OVERLAP_LAST));
  it = placed(it, 0.3);
  e = elements_of(&it, 3);
  ck_assert_double_gt(measure_with(&e, 2), 0.5 * 4 * PI / 3 * 0.003375);
  for (k = 0; k < e.n; ++k) {
    int c, on = 0;
    for (c = 0; c < 4; ++c) on += distance(e.x + 12 * k + 3 * c, middle) < 0.1501;
    ck_assert_int_eq(e.tags[k], on == 4 ? 2 : 1);
  }
  elements_free(&e);
  job_end(&it);
}
END_TEST

/* Without rounds that reduce d, regions do not have their volumes. */
START_TEST(regions_without_their_volumes) {
  job it = solids_job();
  add_bars(it.domain);
  job_place(&it);
  MUST(pnpbs_placement_set(it.placement, "conforming_rounds", "0"));
  MUST(pnpbs_placement_set_spacing_constant(it.placement, 0.7));
  ck_assert_int_eq(pnpbs_placement_run(it.placement), PNPBS_NOT_CONFORMING);
  ck_assert_int_eq(pnpbs_placement_check(it.placement), PNPBS_NOT_CONFORMING);
  ck_assert_int_eq(warnings_with(it.placement, "region"), 1);
  job_end(&it);
}
END_TEST

/* A ball that crosses a side of a box. A hole point removes the part outside of the box. Without
 * the part inside, the others would meet in a circle only. */
START_TEST(ball_across_a_side) {
  const double low[3] = {0, 0, 0}, high[3] = {1, 1, 1}, middle[3] = {0.5, 0.5, 1},
               holes[2][3] = {{0.5, 0.5, 1.1}, {0.5, 0.5, 0.9}};
  const double half = 2 * PI / 3 * 0.027;
  int with_hole;
  for (with_hole = 0; with_hole < 3; ++with_hole) {
    job it = solids_job();
    elements e;
    MUST(pnpbs_domain_add_box(it.domain, low, high, 1));
    MUST(pnpbs_domain_add_ball(it.domain, middle, 0.3, 2));
    MUST(pnpbs_domain_set_fragment(it.domain, PNPBS_OVERLAP_OWN));
    if (with_hole) MUST(pnpbs_domain_add_hole(it.domain, holes[with_hole - 1]));
    if (with_hole == 2) {
      MUST_FAIL(PNPBS_ERROR_DOMAIN, pnpbs_domain_check(it.domain),
                "4 boundary triangles meet in the edge", "moved apart");
      job_end(&it);
      continue;
    }
    job_place(&it);
    MUST(pnpbs_placement_set_spacing_constant(it.placement, 0.1));
    MUST_COMPUTE(pnpbs_placement_run(it.placement));
    e = elements_of(&it, 3);
    ck_assert_double_eq_tol(measure_with(&e, 1), 1 - half, 0.005);
    ck_assert_double_eq_tol(measure_with(&e, 2), with_hole ? 0 : half, 0.005);
    ck_assert_double_eq_tol(measure_with(&e, 3), half, 0.005);
    elements_free(&e);
    job_end(&it);
  }
}
END_TEST

/* Adds the triangles of the cube [low, high]^3 to a surface. Vertex i + 2 j + 4 k of the cube is at
 * (i, j, k). */
static void add_cube(double low, double high, int inwards, double* x, int64_t* vertices,
                     int64_t* corners, int64_t* count) {
  static const int quads[6][4] = {{0, 4, 6, 2}, {1, 3, 7, 5}, {0, 1, 5, 4},
                                  {2, 6, 7, 3}, {0, 2, 3, 1}, {4, 5, 7, 6}};
  const int64_t first = *vertices;
  int64_t v;
  int q;
  for (v = 0; v < 8; ++v, ++*vertices) {
    x[3 * *vertices] = v % 2 ? high : low;
    x[3 * *vertices + 1] = v / 2 % 2 ? high : low;
    x[3 * *vertices + 2] = v / 4 ? high : low;
  }
  for (q = 0; q < 6; ++q)
    add_quad(corners, count, first + quads[q][0], first + quads[q][inwards ? 3 : 1],
             first + quads[q][2], first + quads[q][inwards ? 1 : 3]);
}

/* Within one group, a cube in a cube is a cavity if its triangles are oriented into it. */
START_TEST(cube_in_a_cube) {
  int inwards;
  for (inwards = 0; inwards < 2; ++inwards) {
    double x[48], volume;
    int64_t corners[81], vertices = 0, count = 0;
    job it = solids_job();
    add_cube(0, 3, 0, x, &vertices, corners, &count);
    add_cube(1, 2, inwards, x, &vertices, corners, &count);
    memcpy(corners + 3 * count, corners, 9 * sizeof *corners); /* Three triangles occur twice. */
    count += 3;
    MUST(
        pnpbs_domain_add_surface(it.domain, PNPBS_BOUNDARY, vertices, x, count, corners, NULL, 40));
    MUST(pnpbs_domain_set_fragment(it.domain, PNPBS_OVERLAP_LAST));
    MUST(pnpbs_domain_measure(it.domain, &volume));
    ck_assert_double_eq_tol(volume, inwards ? 26 : 27, 1e-12);
    job_end(&it);
  }
}
END_TEST

/* A box with a wall, all in one group, whose edges at the wall have three triangles. They
 * enclose one solid. */
START_TEST(box_with_a_wall_in_one_group) {
  job it = solids_job();
  elements e;
  add_divided_box(it.domain);
  MUST(pnpbs_domain_set_role(it.domain, 40, PNPBS_BOUNDARY));
  MUST(pnpbs_domain_set_fragment(it.domain, PNPBS_OVERLAP_LAST));
  it = placed(it, 0.2);
  e = elements_of(&it, 3);
  ck_assert_double_eq_tol(measure_with(&e, 1), 2, 1e-12);
  elements_free(&e);
  job_end(&it);
}
END_TEST

/* A curve goes through stacked boxes and leaves them, another one and a fixed node lie on the
 * common face. */
START_TEST(curves_and_nodes_across_surfaces) {
  const double low[2][3] = {{0, 0, 0}, {0, 0, 1}}, high[2][3] = {{1, 1, 1}, {1, 1, 2}};
  const double through[6] = {0.25, 0.25, -1, 0.75, 0.5, 3},
               on_face[6] = {0.25, 0.5, 1, 0.75, 0.75, 1}, fixed[3] = {0.75, 0.25, 1};
  const double nodes_at[6][3] = {{0.375, 0.3125, 0}, {0.5, 0.375, 1}, {0.625, 0.4375, 2},
                                 {0.25, 0.5, 1},     {0.75, 0.75, 1}, {0.75, 0.25, 1}};
  job it = solids_job();
  double volume, *x;
  int64_t nodes, k, i, found;
  for (k = 0; k < 2; ++k) MUST(pnpbs_domain_add_box(it.domain, low[k], high[k], 1));
  MUST(pnpbs_domain_add_polyline(it.domain, PNPBS_INNER, 0, 2, through, NULL, 0));
  MUST(pnpbs_domain_add_polyline(it.domain, PNPBS_INNER, 0, 2, on_face, NULL, 0));
  MUST(pnpbs_domain_add_fixed_nodes(it.domain, 1, fixed, NULL));
  ck_assert_int_eq(pnpbs_domain_check(it.domain), PNPBS_ERROR_DOMAIN);
  MUST(pnpbs_domain_set_snap(it.domain, 1e-6));
  MUST_FAIL(PNPBS_ERROR_DOMAIN, pnpbs_domain_check(it.domain), "set_snap", "set_fragment");
  MUST(pnpbs_domain_set_fragment(it.domain, PNPBS_OVERLAP_LAST));
  MUST(pnpbs_domain_measure(it.domain, &volume));
  ck_assert_double_eq_tol(volume, 2, 1e-12);
  it = placed(it, 0.2);
  MUST(pnpbs_placement_count(it.placement, &nodes));
  x = malloc((size_t)(3 * nodes) * sizeof *x);
  ck_assert_ptr_nonnull(x);
  MUST(pnpbs_placement_get_nodes(it.placement, nodes, x, NULL, NULL, NULL));
  for (i = 0; i < 6; ++i) {
    found = 0;
    for (k = 0; k < nodes; ++k) found += distance(x + 3 * k, nodes_at[i]) < 1e-9;
    ck_assert_int_eq(found, 1);
  }
  free(x);
  job_end(&it);
}
END_TEST

START_TEST(bad_fragmentation) {
  const double low[3] = {0, 0, 0}, high[3] = {1, 1, 1};
  job it = solids_job();
  MUST(pnpbs_domain_add_box(it.domain, low, high, 1));
  MUST_FAIL(PNPBS_ERROR_ARGUMENT, pnpbs_domain_set_fragment(it.domain, 3), "overlap is 3",
            "PNPBS_OVERLAP_OWN");
  MUST(pnpbs_domain_set_fragment(it.domain, PNPBS_OVERLAP_LAST));
  MUST(pnpbs_domain_set_repair(it.domain, 0));
  MUST_FAIL(PNPBS_ERROR_DOMAIN, pnpbs_domain_check(it.domain), "exclude each other", "");
  job_end(&it);
}
END_TEST

/* ---------------------------------------------------------------- bad ones -------------- */

START_TEST(bad_input) {
  const double hole[2] = {0.5, 0.5}, good[2] = {0.1, 0.1}, again[2] = {0.9, 0.1},
               beyond[2] = {3, 3}, on[2] = {0, 0.5}, nowhere[2] = {NAN, 0};
  int k;
  const struct {
    const double* point;
    const char *first, *second;
  } refused[] = {{hole, "region 0 at (0.5, 0.5) lies outside", ""},
                 {beyond, "region 0 at (3, 3) lies outside", ""},
                 {on, "region 0 at (0, 0.5) lies on", "move it into the region it stands for"}};
  for (k = 0; k < COUNT_OF(refused); ++k) {
    job it = job_begin();
    add_rectangle(it.domain, PNPBS_BOUNDARY, 0, 0, 1, 1, 1);
    add_rectangle(it.domain, PNPBS_INNER, 0.4, 0.4, 0.6, 0.6, 2);
    MUST(pnpbs_domain_add_hole(it.domain, hole));
    MUST(pnpbs_domain_add_region(it.domain, refused[k].point, 1));
    MUST_FAIL(PNPBS_ERROR_DOMAIN, pnpbs_domain_check(it.domain), refused[k].first,
              refused[k].second);
    job_end(&it);
  }
  {
    job it = job_begin();
    add_rectangle(it.domain, PNPBS_BOUNDARY, 0, 0, 1, 1, 1);
    MUST_FAIL(PNPBS_ERROR_ARGUMENT, pnpbs_domain_add_region(it.domain, NULL, 1), "point", "NULL");
    MUST_FAIL(PNPBS_ERROR_ARGUMENT, pnpbs_domain_add_region(it.domain, good, 0), "tag", "0");
    MUST_FAIL(PNPBS_ERROR_ARGUMENT, pnpbs_domain_add_region(it.domain, nowhere, 1), "point[0]",
              "nan");
    MUST(pnpbs_domain_check(it.domain));
    MUST(pnpbs_domain_add_region(it.domain, good, 1));
    MUST(pnpbs_domain_add_region(it.domain, again, 2));
    MUST_FAIL(PNPBS_ERROR_DOMAIN, pnpbs_domain_check(it.domain), "region 1 at (0.9, 0.1)",
              "region 0 at (0.1, 0.1) with the tag 1");
    job_end(&it);
  }
}
END_TEST

START_TEST(surfaces_alone_have_none) {
  const double middle[3] = {0, 0, 0};
  int64_t count;
  job it = body_job(volume_unit_box);
  const double inside[3] = {0.5, 0.5, 0.5};
  MUST(pnpbs_domain_add_region(it.domain, inside, 1));
  MUST(pnpbs_domain_check(it.domain));
  MUST(pnpbs_domain_set_filled(it.domain, 0));
  MUST_FAIL(PNPBS_ERROR_DOMAIN, pnpbs_domain_check(it.domain), "region 0", "surfaces alone");
  job_end(&it);
  MUST(pnpbs_context_create_serial(&it.context));
  MUST(pnpbs_domain_create(it.context, 3, &it.domain));
  MUST(pnpbs_domain_add_ball(it.domain, middle, 1, 1));
  MUST(pnpbs_domain_set_filled(it.domain, 0));
  it = placed(it, 0.4);
  MUST_FAIL(PNPBS_ERROR_ARGUMENT, pnpbs_placement_get_element_tags(it.placement, 0, &count, NULL),
            "surfaces alone", "boundary_triangles");
  MUST_FAIL(PNPBS_ERROR_ARGUMENT,
            pnpbs_placement_get_regions(it.placement, 0, &count, NULL, NULL, NULL, NULL),
            "surfaces alone", "boundary_triangles");
  job_end(&it);
}
END_TEST

TEST_SUITE(test_regions) {
  Suite* suite = suite_create("regions");
  TCase* good = tcase_create("good");
  TCase* bad = tcase_create("bad");
  tcase_add_loop_test(good, strips_and_a_disc, 0, 2);
  tcase_add_test(good, regions_at_points);
  tcase_add_test(good, spacing_by_region);
  tcase_add_test(good, disc_that_d_does_not_resolve);
  tcase_add_test(good, ring_that_d_does_not_resolve);
  tcase_add_test(good, tags_stay_with_the_elements);
  tcase_add_test(good, box_with_wall_and_balls);
  tcase_add_test(good, box_without_a_ball);
  tcase_add_test(good, boxes_that_touch);
  tcase_add_test(good, boxes_that_overlap);
  tcase_add_test(good, box_with_a_sheet_across);
  tcase_add_test(good, bars_as_wide_as_d);
  tcase_add_test(good, ball_as_wide_as_d);
  tcase_add_test(good, regions_without_their_volumes);
  tcase_add_test(good, ball_across_a_side);
  tcase_add_test(good, cube_in_a_cube);
  tcase_add_test(good, box_with_a_wall_in_one_group);
  tcase_add_test(good, curves_and_nodes_across_surfaces);
  tcase_add_test(bad, bad_fragmentation);
  tcase_add_test(bad, bad_input);
  tcase_add_test(bad, surfaces_alone_have_none);
  tcase_set_timeout(good, 0);
  tcase_set_timeout(bad, 0);
  suite_add_tcase(suite, good);
  suite_add_tcase(suite, bad);
  return run_suite(suite);
}
