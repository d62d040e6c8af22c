/* SPDX-License-Identifier: BSD-3-Clause
 *
 * Tests the statistics of the elements against those computed from the triangles that are copied
 * out: quality, angles, and edge length over d, by bands of d.
 */
#include "api_support.h"

#define BANDS 8

/* ---------------------------------------------------------------- by brute force -------- */

static int ascending(const void* a, const void* b) {
  const double x = *(const double*)a, y = *(const double*)b;
  return (x > y) - (x < y);
}

static double least_angle(const double* a, const double* b, const double* c) {
  const double* p[3];
  double least = 180;
  int k;
  p[0] = a, p[1] = b, p[2] = c;
  for (k = 0; k < 3; ++k) {
    const double *x = p[k], *y = p[(k + 1) % 3], *z = p[(k + 2) % 3];
    const double first = atan2(y[1] - x[1], y[0] - x[0]), second = atan2(z[1] - x[1], z[0] - x[0]);
    least = fmin(least, fabs(remainder(second - first, 2 * PI)) * 180 / PI);
  }
  return least;
}

static void check_triangles(pnpbs_placement placement, const result* it) {
  double* qualities = malloc((size_t)it->triangles * sizeof *qualities);
  double sum = 0, angle = 180, told;
  int64_t t;
  for (t = 0; t < it->triangles; ++t) {
    const int64_t* v = it->corners + 3 * t;
    const double *a = it->xy + 2 * v[0], *b = it->xy + 2 * v[1], *c = it->xy + 2 * v[2];
    qualities[t] = quality(a, b, c);
    sum += qualities[t];
    angle = fmin(angle, least_angle(a, b, c));
  }
  qsort(qualities, (size_t)it->triangles, sizeof *qualities, ascending);
  ck_assert_double_eq_tol(real_of(placement, "quality.mean"), sum / (double)it->triangles, 1e-9);
  ck_assert_double_eq_tol(real_of(placement, "quality.min"), qualities[0], 1e-12);
  ck_assert_double_eq_tol(real_of(placement, "quality.min_angle"), angle, 1e-9);
  told = real_of(placement, "quality.one_percent");
  ck_assert_double_le(told, qualities[it->triangles / 100]);
  ck_assert_double_gt(told, qualities[it->triangles / 100] - 1.0 / 65536);
  free(qualities);
}

/* Returns half the cotangent of the angle at c. It is positive if the circumcentre of (a, b, c) is
 * on the side of c of the edge from a to b. */
static double side_of_circumcentre(const double* a, const double* b, const double* c) {
  const double bx = b[0] - a[0], by = b[1] - a[1], cx = c[0] - a[0], cy = c[1] - a[1];
  const double bb = bx * bx + by * by, cc = cx * cx + cy * cy, twice = 2 * (bx * cy - by * cx);
  const double x = (cy * bb - by * cc) / twice, y = (bx * cc - cx * bb) / twice;
  return (bx * y - by * x) / bb;
}

static void check_circumcentres(pnpbs_placement placement, const result* it, int64_t least) {
  int64_t t, obtuse = 0, uncrossed = 0, told;
  int k;
  for (t = 0; t < it->triangles; ++t) {
    for (k = 0; k < 3; ++k) {
      const int64_t i = it->corners[3 * t + k], j = it->corners[3 * t + (k + 1) % 3],
                    apex = it->corners[3 * t + (k + 2) % 3];
      if (side_of_circumcentre(it->xy + 2 * i, it->xy + 2 * j, it->xy + 2 * apex) >= -1e-11)
        continue;
      ++obtuse;
      uncrossed += edge_between(it, i, j) == 0;
    }
  }
  MUST(pnpbs_placement_get_int64(placement, "quality.obtuse", &told));
  ck_assert_int_eq(told, obtuse);
  MUST(pnpbs_placement_get_int64(placement, "edge.uncrossed", &told));
  ck_assert_int_eq(told, uncrossed);
  ck_assert_int_ge(uncrossed, least);
}

/* ---------------------------------------------------------------- Voronoi cells --------- */

/* A corner of a Voronoi cell, which is the circumcentre of a triangle at its node, with its
 * direction from the node. `shared` is the last corner of the triangle, which the next triangle has
 * as well. */
typedef struct {
  double angle, x, y;
  int64_t shared;
} cell_corner;

typedef struct {
  int64_t n;
  double area, ratio;
  cell_corner corners[32];
} cell;

static int by_angle(const void* a, const void* b) {
  return ascending(&((const cell_corner*)a)->angle, &((const cell_corner*)b)->angle);
}

static void add_corner(cell* to, const double* a, const double* b, const double* c,
                       int64_t shared) {
  const double bx = b[0] - a[0], by = b[1] - a[1], cx = c[0] - a[0], cy = c[1] - a[1];
  const double bb = bx * bx + by * by, cc = cx * cx + cy * cy, twice = 2 * (bx * cy - by * cx);
  cell_corner* it = &to->corners[to->n++];
  ck_assert_int_le(to->n, 32);
  it->angle = atan2(by + cy, bx + cx);
  it->x = (cy * bb - by * cc) / twice;
  it->y = (bx * cc - cx * bb) / twice;
  it->shared = shared;
}

/* Returns the cells of all nodes that are not on curves. The others are not used. */
static cell* cells_of(const result* it) {
  cell* cells = calloc((size_t)it->n, sizeof *cells);
  int64_t t, i, k;
  for (t = 0; t < 3 * it->triangles; ++t) {
    const int64_t *v = it->corners + t / 3 * 3, a = v[t % 3], b = v[(t + 1) % 3],
                  c = v[(t + 2) % 3];
    if (it->tags[a] == 0) add_corner(&cells[a], it->xy + 2 * a, it->xy + 2 * b, it->xy + 2 * c, c);
  }
  for (i = 0; i < it->n; ++i) {
    double least = 1e300, most = 0;
    cell* its = &cells[i];
    qsort(its->corners, (size_t)its->n, sizeof *its->corners, by_angle);
    for (k = 0; k < its->n; ++k) {
      const cell_corner *p = &its->corners[k], *q = &its->corners[(k + 1) % its->n];
      const double length = hypot(q->x - p->x, q->y - p->y);
      least = fmin(least, length);
      most = fmax(most, length);
      its->area += 0.5 * (p->x * q->y - p->y * q->x);
    }
    its->ratio = least / most;
  }
  return cells;
}

static void check_irregular(pnpbs_placement placement, const result* it) {
  int64_t i, inner = 0, irregular = 0;
  for (i = 0; i < it->n; ++i) {
    if (it->tags[i] != 0) continue;
    ++inner;
    irregular += it->offsets[i + 1] - it->offsets[i] != 6;
  }
  ck_assert_double_eq_tol(real_of(placement, "quality.irregular"),
                          (double)irregular / (double)inner, 1e-15);
}

typedef struct {
  int64_t count, edges[BANDS];
  double from[BANDS], to[BANDS], mean[BANDS], deviation[BANDS];
} bands;

static bands bands_of(pnpbs_placement placement) {
  bands it;
  MUST(pnpbs_placement_get_edge_bands(placement, BANDS, &it.count, it.from, it.to, it.edges,
                                      it.mean, it.deviation));
  return it;
}

typedef struct {
  double n, sum, squares;
} sums;

static void add(sums* to, double value) {
  to->n += 1;
  to->sum += value;
  to->squares += value * value;
}
static double mean_of(const sums* it) { return it->sum / it->n; }
static double deviation_of(const sums* it) {
  return sqrt(fmax(0, it->squares / it->n - mean_of(it) * mean_of(it)));
}

/* Checks edges of the triangles, each once: inner edges occur in both directions. */
static void check_edges(pnpbs_placement placement, const result* it) {
  const bands told = bands_of(placement);
  sums all = {0, 0, 0}, in_band[BANDS];
  int64_t t, b;
  int k;
  memset(in_band, 0, sizeof in_band);
  for (t = 0; t < 3 * it->triangles; ++t) {
    const int64_t i = it->corners[t], j = it->corners[t % 3 == 2 ? t - 2 : t + 1];
    const double d = 0.5 * (it->d[i] + it->d[j]);
    const double ratio =
        hypot(it->xy[2 * i] - it->xy[2 * j], it->xy[2 * i + 1] - it->xy[2 * j + 1]) / d;
    if (i > j && !edge_between(it, i, j)) continue;
    add(&all, ratio);
    if (it->tags[i] != 0 && it->tags[j] != 0) continue;
    for (b = 0; b < told.count; ++b)
      if (d >= told.from[b] && (d < told.to[b] || b + 1 == told.count)) add(&in_band[b], ratio);
  }
  ck_assert_double_eq_tol(real_of(placement, "edge.mean"), mean_of(&all), 1e-9);
  ck_assert_double_eq_tol(real_of(placement, "edge.deviation"), deviation_of(&all), 1e-7);
  for (k = 0; k < told.count; ++k) {
    ck_assert_int_eq(told.edges[k], (int64_t)in_band[k].n);
    ck_assert_double_eq_tol(told.mean[k], mean_of(&in_band[k]), 1e-9);
    ck_assert_double_eq_tol(told.deviation[k], deviation_of(&in_band[k]), 1e-6);
  }
}

typedef struct {
  sums of;
  double worst;
} measured;

static void add_measured(measured bands[BANDS + 1], int64_t band, double value, int smaller) {
  const int64_t both[2] = {band, BANDS}; /* in its band and in the sum of all */
  int k;
  for (k = 0; k < 2; ++k) {
    measured* it = &bands[both[k]];
    if (it->of.n == 0 || (smaller ? value < it->worst : value > it->worst)) it->worst = value;
    add(&it->of, value);
  }
}

static int64_t band_at(const bands* told, double d) {
  int64_t b = 0;
  while (b + 1 < told->count && d >= told->to[b]) ++b;
  return b;
}

static void check_measure(pnpbs_placement placement, const char* name, const bands* limits,
                          const measured found[BANDS + 1]) {
  int64_t count, number[BANDS], k, edge_band = 0;
  double from[BANDS], to[BANDS], mean[BANDS], worst[BANDS];
  MUST(pnpbs_placement_get_cell_bands(placement, name, BANDS, &count, from, to, number, mean,
                                      worst));
  ck_assert_int_gt(count, 0);
  for (k = 0; k < count; ++k) {
    while (limits->from[edge_band] < from[k]) ++edge_band;
    ck_assert_double_eq(from[k], limits->from[edge_band]);
    ck_assert_double_eq(to[k], limits->to[edge_band]);
    ck_assert_int_eq(number[k], (int64_t)found[edge_band].of.n);
    if (number[k] == 0) continue;
    ck_assert_double_eq_tol(mean[k], mean_of(&found[edge_band].of), 2e-9);
    ck_assert_double_eq_tol(worst[k], found[edge_band].worst, 1e-9);
  }
}

/* Edges occur at both ends and are counted at the end with the smaller index. */
static void check_cells(pnpbs_placement placement, const result* it) {
  const bands limits = bands_of(placement);
  measured ratios[BANDS + 1], areas[BANDS + 1], offsets[BANDS + 1];
  cell* cells = cells_of(it);
  int64_t i, k;
  memset(ratios, 0, sizeof ratios);
  memset(areas, 0, sizeof areas);
  memset(offsets, 0, sizeof offsets);
  for (i = 0; i < it->n; ++i) {
    const cell* its = &cells[i];
    if (it->tags[i] != 0) continue;
    add_measured(ratios, band_at(&limits, it->d[i]), its->ratio, 1);
    for (k = 0; k < its->n; ++k) {
      const cell_corner *p = &its->corners[k], *q = &its->corners[(k + 1) % its->n];
      const int64_t j = p->shared, band = band_at(&limits, 0.5 * (it->d[i] + it->d[j]));
      const double x = it->xy[2 * j] - it->xy[2 * i], y = it->xy[2 * j + 1] - it->xy[2 * i + 1];
      if (j < i || it->tags[j] != 0) continue;
      add_measured(areas, band, fmin(its->area, cells[j].area) / fmax(its->area, cells[j].area), 1);
      add_measured(offsets, band, hypot(p->x + q->x - x, p->y + q->y - y) / 2 / hypot(x, y), 0);
    }
  }
  check_measure(placement, "edge_ratio", &limits, ratios);
  check_measure(placement, "area_ratio", &limits, areas);
  check_measure(placement, "dual_offset", &limits, offsets);
  ck_assert_double_eq_tol(real_of(placement, "cell.mean_edge_ratio"), mean_of(&ratios[BANDS].of),
                          2e-9);
  ck_assert_double_eq_tol(real_of(placement, "cell.min_edge_ratio"), ratios[BANDS].worst, 1e-9);
  ck_assert_double_eq_tol(real_of(placement, "cell.mean_area_ratio"), mean_of(&areas[BANDS].of),
                          2e-9);
  ck_assert_double_eq_tol(real_of(placement, "cell.min_area_ratio"), areas[BANDS].worst, 1e-9);
  ck_assert_double_eq_tol(real_of(placement, "edge.mean_dual_offset"), mean_of(&offsets[BANDS].of),
                          2e-9);
  ck_assert_double_eq_tol(real_of(placement, "edge.max_dual_offset"), offsets[BANDS].worst, 1e-9);
  free(cells);
}

/* ---------------------------------------------------------------- cases ----------------- */

static job graded_job(cone* d) {
  job it = job_begin();
  add_rectangle(it.domain, PNPBS_BOUNDARY, 0, 0, 1, 1, 1);
  add_circle(it.domain, PNPBS_BOUNDARY, 0.6, 0.5, 0.2, 2);
  job_place(&it);
  MUST(pnpbs_placement_set_spacing_callback(it.placement, cone_spacing, d));
  return it;
}

START_TEST(as_by_brute_force) {
  cone d = {0.012, 0.03, 0, 0};
  job it = graded_job(&d);
  result found;
  MUST_COMPUTE(pnpbs_placement_run(it.placement));
  found = result_of(it.placement);
  check_triangles(it.placement, &found);
  check_irregular(it.placement, &found);
  check_edges(it.placement, &found);
  check_cells(it.placement, &found);
  check_circumcentres(it.placement, &found, 0);
  result_free(&found);
  job_end(&it);
}
END_TEST

/* Centroidal sweeps move nodes to the centroids of their cells and leave the topology good. */
START_TEST(centroidal_sweeps) {
  const char* sweeps[3] = {"0", "10", "40"};
  double mean[3], max[3];
  int k;
  for (k = 0; k < 3; ++k) {
    cone d = {0.012, 0.03, 0, 0};
    job it = graded_job(&d);
    result found;
    MUST(pnpbs_placement_set(it.placement, "centroidal_sweeps", sweeps[k]));
    MUST(pnpbs_placement_set(it.placement, "obtuse_rounds", k == 2 ? "20" : "0"));
    MUST_COMPUTE(pnpbs_placement_run(it.placement));
    mean[k] = real_of(it.placement, "cell.mean_offset");
    max[k] = real_of(it.placement, "cell.max_offset");
    found = result_of(it.placement);
    check_triangles(it.placement, &found);
    check_circumcentres(it.placement, &found, 0);
    ck_assert_double_ge(real_of(it.placement, "quality.mean"), 0.98);
    result_free(&found);
    job_end(&it);
  }
  ck_assert_double_gt(mean[0], 0.005);
  ck_assert_double_lt(mean[1], 0.25 * mean[0]);
  ck_assert_double_lt(mean[2], 0.7 * mean[1]);
  for (k = 0; k < 3; ++k) ck_assert_double_gt(max[k], mean[k]);
}
END_TEST

START_TEST(bands_share_out_d) {
  cone d = {0.012, 0.03, 0, 0};
  job graded = graded_job(&d), uniform = square_job(1);
  bands it;
  int64_t k;
  MUST_COMPUTE(pnpbs_placement_run(graded.placement));
  it = bands_of(graded.placement);
  ck_assert_int_eq(it.count, 8);
  ck_assert_double_eq_tol(it.from[0], d.a, 1e-12); /* at a corner, which is a node */
  for (k = 0; k < 8; ++k) {
    ck_assert_double_eq_tol(it.to[k] / it.from[k], it.to[0] / it.from[0], 1e-9);
    if (k > 0) ck_assert_double_eq(it.from[k], it.to[k - 1]);
  }
  MUST(pnpbs_placement_set_spacing_constant(uniform.placement, 0.05));
  MUST_COMPUTE(pnpbs_placement_run(uniform.placement));
  it = bands_of(uniform.placement);
  ck_assert_int_eq(it.count, 1);
  ck_assert_double_eq(it.from[0], 0.05);
  ck_assert_double_eq(it.to[0], 0.05);
  job_end(&graded);
  job_end(&uniform);
}
END_TEST

/* Statistics are those of the current nodes, also after single steps. Before there are nodes they
 * are errors. */
START_TEST(before_a_run) {
  cone d = {0.012, 0.03, 0, 0};
  job it = graded_job(&d);
  result found;
  double value;
  int64_t count;
  MUST_FAIL(PNPBS_ERROR_STATE, pnpbs_placement_get_double(it.placement, "quality.mean", &value),
            "no nodes", "run");
  MUST_FAIL(PNPBS_ERROR_STATE,
            pnpbs_placement_get_edge_bands(it.placement, 0, &count, NULL, NULL, NULL, NULL, NULL),
            "no nodes", "run");
  MUST_COMPUTE(pnpbs_placement_step(it.placement, 7));
  found = result_of(it.placement);
  check_triangles(it.placement, &found);
  check_edges(it.placement, &found);
  check_cells(it.placement, &found);
  check_circumcentres(it.placement, &found, 10);
  result_free(&found);
  MUST_COMPUTE(pnpbs_placement_step(it.placement, 1)); /* the cached statistics are recomputed */
  found = result_of(it.placement);
  check_triangles(it.placement, &found);
  result_free(&found);
  job_end(&it);
}
END_TEST

START_TEST(arrays_too_small) {
  cone d = {0.012, 0.03, 0, 0};
  job it = graded_job(&d);
  double mean[BANDS];
  int64_t count = -1;
  MUST(pnpbs_placement_initialise(it.placement));
  MUST_FAIL(PNPBS_ERROR_ARGUMENT,
            pnpbs_placement_get_edge_bands(it.placement, 0, NULL, NULL, NULL, NULL, NULL, NULL),
            "count", "NULL");
  MUST_FAIL(PNPBS_ERROR_CAPACITY,
            pnpbs_placement_get_edge_bands(it.placement, 7, &count, NULL, NULL, NULL, mean, NULL),
            "capacity = 7", "8 are needed");
  MUST_FAIL(PNPBS_ERROR_ARGUMENT,
            pnpbs_placement_get_edge_bands(it.placement, -1, &count, NULL, NULL, NULL, mean, NULL),
            "capacity", "negative");
  MUST(pnpbs_placement_get_edge_bands(it.placement, 0, &count, NULL, NULL, NULL, NULL, NULL));
  ck_assert_int_eq(count, 8);
  MUST(pnpbs_placement_get_edge_bands(it.placement, 8, &count, NULL, NULL, NULL, mean, NULL));
  MUST_FAIL(
      PNPBS_ERROR_ARGUMENT,
      pnpbs_placement_get_cell_bands(it.placement, NULL, 0, &count, NULL, NULL, NULL, NULL, NULL),
      "measure", "NULL");
  MUST_FAIL(PNPBS_ERROR_KEY,
            pnpbs_placement_get_cell_bands(it.placement, "edge_rato", 0, &count, NULL, NULL, NULL,
                                           NULL, NULL),
            "edge_rato", "edge_ratio");
  MUST_FAIL(PNPBS_ERROR_CAPACITY,
            pnpbs_placement_get_cell_bands(it.placement, "edge_ratio", 7, &count, NULL, NULL, NULL,
                                           mean, NULL),
            "capacity = 7", "8 are needed");
  MUST(pnpbs_placement_get_cell_bands(it.placement, "edge_ratio", 0, &count, NULL, NULL, NULL, NULL,
                                      NULL));
  ck_assert_int_eq(count, 8);
  job_end(&it);
}
END_TEST

/* ---------------------------------------------------------------- d is missed ----------- */

static const char* last_warning(pnpbs_placement placement) {
  const char* text = "";
  int32_t count;
  MUST(pnpbs_placement_warning_count(placement, &count));
  if (count > 0) MUST(pnpbs_placement_get_warning(placement, count - 1, &text));
  return text;
}

/* The run has no steps and far too few nodes for d, and the finish cannot correct that. */
START_TEST(missed_spacing_is_told) {
  job it = square_job(1);
  double xy[2 * 400];
  int32_t count;
  int k;
  for (k = 0; k < 400; ++k) {
    xy[2 * k] = 0.02 + 0.05 * (k % 20);
    xy[2 * k + 1] = 0.02 + 0.05 * (k / 20);
  }
  MUST(pnpbs_placement_set_spacing_constant(it.placement, 0.04));
  MUST(pnpbs_placement_set_nodes(it.placement, 400, xy, NULL));
  MUST(pnpbs_placement_set_int64(it.placement, "steps", 0));
  MUST_BE(PNPBS_SPACING_MISSED, pnpbs_placement_run(it.placement));
  ck_assert_msg(
      strstr(last_warning(it.placement), "0.04") && strstr(last_warning(it.placement), "too few"),
      "%s", last_warning(it.placement));
  ck_assert_str_eq(pnpbs_status_string(PNPBS_SPACING_MISSED),
                   "somewhere the nodes do not follow the spacing");
  MUST(pnpbs_placement_warning_count(it.placement, &count));
  ck_assert_int_eq(count, 1);
  MUST_BE(PNPBS_SPACING_MISSED, pnpbs_placement_run(it.placement));
  MUST(pnpbs_placement_warning_count(it.placement, &count));
  ck_assert_int_eq(count, 1); /* of the last run only */
  MUST(pnpbs_placement_set_int64(it.placement, "steps", 300));
  MUST(pnpbs_placement_run(it.placement));
  MUST(pnpbs_placement_warning_count(it.placement, &count));
  ck_assert_int_eq(count, 0);
  job_end(&it);
}
END_TEST

/* The warning does not depend on sweeps and repairs, for which stars are built anyway. */
START_TEST(missed_without_sweeps) {
  job it = square_job(1);
  const double xy[] = {0.5, 0.5};
  MUST(pnpbs_placement_set_spacing_constant(it.placement, 0.02));
  MUST(pnpbs_placement_set_nodes(it.placement, 1, xy, NULL));
  MUST(pnpbs_placement_set(it.placement, "sweeps", "0"));
  MUST(pnpbs_placement_set(it.placement, "smoothing_rounds", "0"));
  MUST(pnpbs_placement_set(it.placement, "steps", "0"));
  MUST_BE(PNPBS_SPACING_MISSED, pnpbs_placement_run(it.placement));
  job_end(&it);
}
END_TEST

/* A domain with short edges has no room for nodes at d. Deviations that the user's corners cause,
 * or that only few edges show, do not count as a missed d. */
START_TEST(corners_are_no_miss) {
  job it = job_begin();
  add_rectangle(it.domain, PNPBS_BOUNDARY, 0, 0, 10, 0.1, 1);
  job_place(&it);
  MUST(pnpbs_placement_set_spacing_constant(it.placement, 0.2));
  MUST_COMPUTE(pnpbs_placement_run(it.placement));
  job_end(&it);
  it = square_job(0.1);
  MUST(pnpbs_placement_set_spacing_constant(it.placement, 0.09));
  MUST_COMPUTE(pnpbs_placement_run(it.placement));
  job_end(&it);
}
END_TEST

/* Checks that stars restored from those of the run equal stars from lists that are built after
 * them. */
static void check_stars_before_and_after_lists(pnpbs_placement placement) {
  result before = result_of(placement);
  const int64_t rebuilds = integer_of(placement, "rebuilds");
  int64_t entries;
  result after;
  MUST(pnpbs_placement_adjacency_size(placement, &entries));
  ck_assert_int_gt(integer_of(placement, "rebuilds"), rebuilds);
  after = result_of(placement);
  ck_assert_int_eq(before.entries, after.entries);
  ck_assert_int_eq(before.triangles, after.triangles);
  ck_assert_mem_eq(before.neighbours, after.neighbours,
                   (size_t)before.entries * sizeof *before.neighbours);
  ck_assert_mem_eq(before.corners, after.corners,
                   3 * (size_t)before.triangles * sizeof *before.corners);
  result_free(&before);
  result_free(&after);
}

START_TEST(stars_whatever_is_asked_first) {
  cone steep = {0.004, 0.06, 0.5, 0.5};
  job it = square_job(1);
  MUST(pnpbs_placement_set_spacing_callback(it.placement, cone_spacing, &steep));
  MUST_COMPUTE(pnpbs_placement_run(it.placement));
  check_stars_before_and_after_lists(it.placement);
  MUST_COMPUTE(pnpbs_placement_step(it.placement, 3));
  check_placement(it.placement, 1);
  MUST_COMPUTE(pnpbs_placement_run(it.placement));
  check_stars_before_and_after_lists(it.placement);
  job_end(&it);
}
END_TEST

TEST_SUITE(test_quality) {
  Suite* suite = suite_create("quality");
  TCase* tests = tcase_create("quality");
  tcase_add_test(tests, as_by_brute_force);
  tcase_add_test(tests, centroidal_sweeps);
  tcase_add_test(tests, bands_share_out_d);
  tcase_add_test(tests, before_a_run);
  tcase_add_test(tests, arrays_too_small);
  tcase_add_test(tests, missed_spacing_is_told);
  tcase_add_test(tests, missed_without_sweeps);
  tcase_add_test(tests, corners_are_no_miss);
  tcase_add_test(tests, stars_whatever_is_asked_first);
  tcase_set_timeout(tests, 60);
  suite_add_tcase(suite, tests);
  return run_suite(suite);
}
