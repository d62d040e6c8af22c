/* SPDX-License-Identifier: BSD-3-Clause
 *
 * Tests adjacency lists against all pairs, stars against their invariants, and statistics of nodes
 * against brute force.
 */
#include "api_support.h"

typedef struct {
  int64_t entries;
  int64_t* offsets;
  int64_t* neighbours;
} lists;

static lists lists_of(pnpbs_placement placement, int64_t n) {
  lists it;
  MUST(pnpbs_placement_adjacency_size(placement, &it.entries));
  it.offsets = malloc((size_t)(n + 1) * sizeof *it.offsets);
  it.neighbours = malloc((size_t)(it.entries + 1) * sizeof *it.neighbours);
  MUST(pnpbs_placement_get_adjacency(placement, it.entries, it.offsets, it.neighbours));
  return it;
}

static void lists_free(lists* it) {
  free(it->offsets);
  free(it->neighbours);
}

static double cross(const double* o, const double* a, const double* b) {
  return (a[0] - o[0]) * (b[1] - o[1]) - (a[1] - o[1]) * (b[0] - o[0]);
}

/* Returns whether the segments ab and pq cross at a point inside both. */
static int cross_inside(const double* a, const double* b, const double* p, const double* q) {
  return cross(a, b, p) * cross(a, b, q) < 0 && cross(p, q, a) * cross(p, q, b) < 0;
}

/* Returns whether the point is inside, by the edges that bound the domain. Inner curves do not
 * count, as they have triangles on both sides. */
static int is_inside(const result* r, const char* bounds, double x, double y) {
  int inside = 0;
  int64_t e;
  for (e = 0; e < r->edges; ++e) {
    const double *a = r->xy + 2 * r->ends[2 * e], *b = r->xy + 2 * r->ends[2 * e + 1];
    if (!bounds[e] || (a[1] > y) == (b[1] > y)) continue;
    if (a[0] + (y - a[1]) / (b[1] - a[1]) * (b[0] - a[0]) > x) inside = !inside;
  }
  return inside;
}

/* Returns for each boundary edge whether the star has a gap beside it. */
static char* bounding_edges(const result* r) {
  char* bounds = calloc((size_t)r->edges + 1, 1);
  int64_t e, k;
  for (e = 0; e < r->edges; ++e) {
    const int64_t a = r->ends[2 * e], b = r->ends[2 * e + 1];
    for (k = r->offsets[a]; k < r->offsets[a + 1]; ++k) {
      const int64_t before = k > r->offsets[a] ? k - 1 : r->offsets[a + 1] - 1;
      if (r->neighbours[k] == b) bounds[e] = !r->is_triangle[k] || !r->is_triangle[before];
    }
  }
  return bounds;
}

/* Returns whether the boundary separates i and j: an edge crosses the segment between them, or the
 * segment lies outside. */
static int is_separated(const result* r, const char* bounds, int64_t i, int64_t j) {
  const double *x = r->xy + 2 * i, *y = r->xy + 2 * j;
  int64_t e;
  if (edge_between(r, i, j) != 0) return 0;
  for (e = 0; e < r->edges; ++e) {
    const int64_t a = r->ends[2 * e], b = r->ends[2 * e + 1];
    if (a == i || a == j || b == i || b == j) continue;
    if (cross_inside(x, y, r->xy + 2 * a, r->xy + 2 * b)) return 1;
  }
  return !is_inside(r, bounds, 0.5 * (x[0] + y[0]), 0.5 * (x[1] + y[1]));
}

/* Returns whether the segment from i to j passes through another boundary node up to rounding. Such
 * a pair may be listed or not. */
static int grazes(const result* r, int64_t i, int64_t j) {
  const double *x = r->xy + 2 * i, *y = r->xy + 2 * j;
  const double length = hypot(y[0] - x[0], y[1] - x[1]);
  int64_t k;
  for (k = 0; k < r->n; ++k) {
    const double* z = r->xy + 2 * k;
    const double along = (z[0] - x[0]) * (y[0] - x[0]) + (z[1] - x[1]) * (y[1] - x[1]);
    if (!r->on_boundary[k] || k == i || k == j || along < 0 || along > length * length) continue;
    if (fabs(cross(x, y, z)) < 1e-9 * length) return 1;
  }
  return 0;
}

static void check_lists(const result* r, const lists* l, double radius) {
  char* bounds = bounding_edges(r);
  char* listed = calloc((size_t)r->n + 1, 1);
  int64_t i, j, k;
  ck_assert_int_eq(l->offsets[0], 0);
  ck_assert_int_eq(l->offsets[r->n], l->entries);
  for (i = 0; i < r->n; ++i) {
    memset(listed, 0, (size_t)r->n);
    for (k = l->offsets[i]; k < l->offsets[i + 1]; ++k) {
      j = l->neighbours[k];
      ck_assert(j >= 0 && j < r->n && j != i);
      ck_assert_msg(k == l->offsets[i] || r->ids[l->neighbours[k - 1]] < r->ids[j],
                    "the neighbours of %d are not in the order of ids", (int)i);
      listed[j] = 1;
    }
    for (j = 0; j < r->n; ++j) {
      const double gap = hypot(r->xy[2 * i] - r->xy[2 * j], r->xy[2 * i + 1] - r->xy[2 * j + 1]);
      const double reach = 0.5 * radius * (r->d[i] + r->d[j]);
      if (i == j || fabs(gap - reach) < 1e-12 * reach) continue; /* both are right */
      if (gap < reach && grazes(r, i, j)) continue;
      ck_assert_msg(listed[j] == (gap < reach && !is_separated(r, bounds, i, j)),
                    "nodes (%.17g, %.17g) and (%.17g, %.17g), %g of the radius apart, are %s",
                    r->xy[2 * i], r->xy[2 * i + 1], r->xy[2 * j], r->xy[2 * j + 1], gap / reach,
                    listed[j] ? "listed" : "not listed");
    }
  }
  free(bounds);
  free(listed);
}

/* ---------------------------------------------------------------- domains --------------- */

/* A square with a slit from its middle to the right side, narrower than d. The sides of the slit
 * are boundary if is_inner is 0; if it is 1, the slit is an inner curve. */
static job slit_square(int is_inner) {
  const double outline[14] = {0, 0, 1, 0, 1, 0.499, 0.5, 0.5, 1, 0.501, 1, 1, 0, 1};
  const double curve[4] = {0.3, 0.5, 0.7, 0.5};
  const int32_t tag = 5;
  job it = job_begin();
  if (is_inner) {
    add_rectangle(it.domain, PNPBS_BOUNDARY, 0, 0, 1, 1, 1);
    MUST(pnpbs_domain_add_polyline(it.domain, PNPBS_INNER, 0, 2, curve, &tag, 0));
  } else {
    MUST(pnpbs_domain_add_polyline(it.domain, PNPBS_BOUNDARY, 1, 7, outline, NULL, 0));
  }
  job_place(&it);
  return it;
}

static job ring(void) {
  job it = job_begin();
  add_circle(it.domain, PNPBS_BOUNDARY, 0, 0, 1, 1);
  add_circle(it.domain, PNPBS_BOUNDARY, 0.1, 0, 0.4, 2);
  job_place(&it);
  return it;
}

static job star_shape(void) {
  double xy[20];
  int k;
  job it = job_begin();
  for (k = 0; k < 10; ++k) {
    const double r = k % 2 ? 0.4 : 1;
    xy[2 * k] = r * cos(PI * k / 5);
    xy[2 * k + 1] = r * sin(PI * k / 5);
  }
  MUST(pnpbs_domain_add_polyline(it.domain, PNPBS_BOUNDARY, 1, 10, xy, NULL, 0));
  job_place(&it);
  return it;
}

static job two_close_squares(void) {
  job it = job_begin();
  add_rectangle(it.domain, PNPBS_BOUNDARY, 0, 0, 1, 1, 1);
  add_rectangle(it.domain, PNPBS_BOUNDARY, 1.01, 0, 2, 1, 1);
  job_place(&it);
  return it;
}

typedef struct {
  const char* name;
  int euler;
  double a, b; /* parameters of the cone */
} scene;

static const scene scenes[] = {
    {"square", 1, 0.06, 0},      {"graded square", 1, 0.02, 0.1},
    {"slit square", 1, 0.06, 0}, {"inner slit", 1, 0.06, 0},
    {"ring", 0, 0.08, 0},        {"graded star", 1, 0.03, 0.05},
    {"two squares", 2, 0.07, 0}, {"coarse ring", 0, 0.3, 0},
    {"coarse star", 1, 0.25, 0}, {"coarse slit", 1, 0.25, 0},
};

static job run_scene(int which, cone* slope) {
  job it;
  switch (which) {
    case 2:
    case 9:
      it = slit_square(0);
      break;
    case 3:
      it = slit_square(1);
      break;
    case 4:
    case 7:
      it = ring();
      break;
    case 5:
    case 8:
      it = star_shape();
      break;
    case 6:
      it = two_close_squares();
      break;
    default:
      it = square_job(1);
      break;
  }
  slope->a = scenes[which].a;
  slope->b = scenes[which].b;
  slope->x0 = slope->y0 = 0;
  MUST(pnpbs_placement_set_spacing_callback(it.placement, cone_spacing, slope));
  return it;
}

/* ---------------------------------------------------------------- tests ----------------- */

START_TEST(lists_against_all_pairs) {
  static const double radii[] = {1.7, 0.5, 4, 1};
  cone slope;
  job it = run_scene(_i, &slope);
  int k;
  for (k = 0; k < COUNT_OF(radii); ++k) {
    result r;
    lists l;
    MUST(pnpbs_placement_set_double(it.placement, "adjacency_radius", radii[k]));
    MUST_COMPUTE(pnpbs_placement_step(it.placement, k == 0 ? 45 : 5));
    r = result_of(it.placement);
    check_result(&r, scenes[_i].euler);
    l = lists_of(it.placement, r.n);
    check_lists(&r, &l, radii[k]);
    lists_free(&l);
    result_free(&r);
  }
  MUST_COMPUTE(pnpbs_placement_run(it.placement));
  check_placement(it.placement, scenes[_i].euler);
  job_end(&it);
}
END_TEST

/* Stars do not depend on the radius of the lists. */
START_TEST(stars_do_not_depend_on_the_radius) {
  cone slope;
  job it = run_scene(_i, &slope), other;
  result wide, narrow;
  MUST_COMPUTE(pnpbs_placement_run(it.placement));
  wide = result_of(it.placement);
  other = run_scene(_i, &slope);
  MUST(pnpbs_placement_set(other.placement, "adjacency_radius", "0.5"));
  MUST_COMPUTE(pnpbs_placement_run(other.placement));
  narrow = result_of(other.placement);
  ck_assert_int_eq(wide.n, narrow.n);
  ck_assert_mem_eq(wide.xy, narrow.xy, 2 * (size_t)wide.n * sizeof *wide.xy);
  ck_assert_int_eq(wide.triangles, narrow.triangles);
  ck_assert_int_eq(wide.entries, narrow.entries);
  result_free(&wide);
  result_free(&narrow);
  job_end(&it);
  job_end(&other);
}
END_TEST

START_TEST(no_pair_across_a_slit) {
  job it = slit_square(0);
  result r;
  lists l;
  int64_t i, k;
  int above = 0, below = 0;
  MUST(pnpbs_placement_set_spacing_constant(it.placement, 0.05));
  MUST_COMPUTE(pnpbs_placement_run(it.placement));
  r = result_of(it.placement);
  check_result(&r, 1);
  ck_assert_double_eq_tol(triangle_area(&r), 1 - 0.0005, 1e-13);
  l = lists_of(it.placement, r.n);
  for (i = 0; i < r.n; ++i) {
    const double* x = r.xy + 2 * i;
    if (x[0] < 0.6) continue;
    above += x[1] > 0.5 && x[1] < 0.6;
    below += x[1] < 0.5 && x[1] > 0.4;
    for (k = l.offsets[i]; k < l.offsets[i + 1]; ++k) {
      const double* y = r.xy + 2 * l.neighbours[k];
      ck_assert_msg(y[0] < 0.6 || (x[1] > 0.5) == (y[1] > 0.5),
                    "(%g, %g) and (%g, %g) see each other across the slit", x[0], x[1], y[0], y[1]);
    }
    for (k = r.offsets[i]; k < r.offsets[i + 1]; ++k) {
      const double* y = r.xy + 2 * r.neighbours[k];
      ck_assert(y[0] < 0.6 || (x[1] > 0.5) == (y[1] > 0.5));
    }
  }
  ck_assert_int_gt(above, 10);
  ck_assert_int_gt(below, 10);
  lists_free(&l);
  result_free(&r);
  job_end(&it);
}
END_TEST

START_TEST(spacing_errors_by_hand) {
  cone slope;
  job it = run_scene(_i, &slope);
  result r;
  double mean = 0, square = 0, least = HUGE_VAL;
  int64_t i, j;
  char* bounds;
  MUST_COMPUTE(pnpbs_placement_run(it.placement));
  r = result_of(it.placement);
  bounds = bounding_edges(&r);
  for (i = 0; i < r.n; ++i) {
    double nearest = 1.7 * r.d[i], error;
    for (j = 0; j < r.n; ++j) {
      const double gap = hypot(r.xy[2 * i] - r.xy[2 * j], r.xy[2 * i + 1] - r.xy[2 * j + 1]);
      if (j == i || gap >= nearest || is_separated(&r, bounds, i, j)) continue;
      nearest = gap;
    }
    error = nearest / r.d[i];
    mean += error / (double)r.n;
    square += error * error / (double)r.n;
    least = fmin(least, error);
  }
  ck_assert_double_eq_tol(real_of(it.placement, "d_error.mean"), mean, 1e-6);
  ck_assert_double_eq_tol(real_of(it.placement, "d_error.deviation"),
                          sqrt(fmax(0, square - mean * mean)), 1e-4);
  ck_assert_double_eq_tol(real_of(it.placement, "d_error.least"), least, 1e-12);
  free(bounds);
  result_free(&r);
  job_end(&it);
}
END_TEST

/* Sets of nodes that differ in one bit of a position, in an id or in a tag have different hashes.
 */
START_TEST(hashes_tell_nodes_apart) {
  const double xy[4] = {0.3, 0.4, 0.7, 0.6}, moved[4] = {0.3, 0.4, 0.7, 0.6000000000000001};
  const int64_t ids[2] = {100, 200}, others[2] = {100, 201};
  hash_text hashes[5];
  int k, j;
  for (k = 0; k < 5; ++k) {
    job it = job_begin();
    add_rectangle(it.domain, PNPBS_BOUNDARY, 0, 0, 1, 1, k == 3 ? 2 : 1);
    job_place(&it);
    MUST(pnpbs_placement_set_spacing_constant(it.placement, 0.3));
    MUST(pnpbs_placement_set_nodes(it.placement, 2, k == 1 ? moved : xy, k == 2 ? others : ids));
    MUST(pnpbs_placement_initialise(it.placement));
    ck_assert_int_eq(integer_of(it.placement, "dropped"), 0);
    hashes[k] = hash_of(it.placement);
    ck_assert_str_eq(hash_of(it.placement).text, hashes[k].text);
    ck_assert_int_eq(strspn(hashes[k].text, "0123456789abcdef"), 16);
    ck_assert_int_eq(strlen(hashes[k].text), 16);
    job_end(&it);
  }
  for (k = 0; k < 4; ++k) {
    for (j = 0; j < k; ++j) ck_assert_str_ne(hashes[k].text, hashes[j].text);
  }
  ck_assert_str_eq(hashes[4].text, hashes[0].text);
}
END_TEST

/* Each optional output is the same if it is the only one. */
START_TEST(outputs_one_by_one) {
  cone slope;
  job it = run_scene(5, &slope);
  result r;
  void* memory;
  size_t n;
  MUST_COMPUTE(pnpbs_placement_step(it.placement, 30));
  r = result_of(it.placement);
  n = (size_t)r.n;
  memory = malloc(64 * n + 64);
  MUST(pnpbs_placement_get_nodes(it.placement, r.n, memory, NULL, NULL, NULL));
  ck_assert_mem_eq(memory, r.xy, 2 * n * sizeof *r.xy);
  MUST(pnpbs_placement_get_nodes(it.placement, r.n, NULL, memory, NULL, NULL));
  ck_assert_mem_eq(memory, r.ids, n * sizeof *r.ids);
  MUST(pnpbs_placement_get_nodes(it.placement, r.n, NULL, NULL, memory, NULL));
  ck_assert_mem_eq(memory, r.tags, n * sizeof *r.tags);
  MUST(pnpbs_placement_get_nodes(it.placement, r.n + 7, NULL, NULL, NULL, memory));
  ck_assert_mem_eq(memory, r.d, n * sizeof *r.d);
  MUST(pnpbs_placement_get_boundary_edges(it.placement, r.edges, &r.edges, memory, NULL));
  ck_assert_mem_eq(memory, r.ends, 2 * (size_t)r.edges * sizeof *r.ends);
  MUST(pnpbs_placement_get_boundary_edges(it.placement, r.edges, &r.edges, NULL, memory));
  ck_assert_mem_eq(memory, r.edge_tags, (size_t)r.edges * sizeof *r.edge_tags);
  free(memory);
  result_free(&r);
  job_end(&it);
}
END_TEST

TEST_SUITE(test_neighbours) {
  Suite* suite = suite_create("neighbours");
  TCase* cases = tcase_create("neighbours");
  tcase_add_loop_test(cases, lists_against_all_pairs, 0, COUNT_OF(scenes));
  tcase_add_loop_test(cases, stars_do_not_depend_on_the_radius, 0, COUNT_OF(scenes));
  tcase_add_test(cases, no_pair_across_a_slit);
  tcase_add_loop_test(cases, spacing_errors_by_hand, 0, COUNT_OF(scenes));
  tcase_add_test(cases, hashes_tell_nodes_apart);
  tcase_add_test(cases, outputs_one_by_one);
  suite_add_tcase(suite, cases);
  return run_suite(suite);
}
