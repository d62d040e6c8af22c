/* SPDX-License-Identifier: BSD-3-Clause
 *
 * Tests calls on a live placement: new spacings, given nodes, single steps and further runs.
 */
#include "api_support.h"

/* Returns the number of nodes of `after` whose ids are also in `before`. */
static int64_t kept(const result* before, const result* after) {
  int64_t i = 0, j = 0, count = 0;
  while (i < before->n && j < after->n) {
    if (before->ids[i] == after->ids[j]) ++count;
    if (before->ids[i] < after->ids[j])
      ++i;
    else
      ++j;
  }
  return count;
}

/* Returns whether a warning contains this text. */
static int has_warning(pnpbs_placement placement, const char* part) {
  const char* text = "";
  int32_t count = 0, k;
  MUST(pnpbs_placement_warning_count(placement, &count));
  for (k = 0; k < count; ++k) {
    MUST(pnpbs_placement_get_warning(placement, k, &text));
    if (strstr(text, part)) return 1;
  }
  return 0;
}

static void check_same(const result* a, const result* b) {
  ck_assert_int_eq(a->n, b->n);
  ck_assert_mem_eq(a->ids, b->ids, (size_t)a->n * sizeof *a->ids);
  ck_assert_mem_eq(a->xy, b->xy, 2 * (size_t)a->n * sizeof *a->xy);
  ck_assert_mem_eq(a->tags, b->tags, (size_t)a->n * sizeof *a->tags);
  ck_assert_mem_eq(a->d, b->d, (size_t)a->n * sizeof *a->d);
  ck_assert_int_eq(a->entries, b->entries);
  ck_assert_mem_eq(a->neighbours, b->neighbours, (size_t)a->entries * sizeof *a->neighbours);
}

/* ---------------------------------------------------------------- a new spacing --------- */

static cone slope_times(double factor) {
  cone it = {0.015, 0.015, 0, 0};
  it.a *= factor;
  it.b *= factor;
  return it;
}

static void respace(double factor, double tolerance, double least_kept, double most_kept) {
  job it = square_job(1), fresh = square_job(1);
  cone first = slope_times(1), second = slope_times(factor);
  result before, after, at_once;
  quality_summary now, then;
  int64_t i, stayed;
  MUST(pnpbs_placement_set_spacing_callback(it.placement, cone_spacing, &first));
  MUST_COMPUTE(pnpbs_placement_run(it.placement));
  before = result_of(it.placement);

  MUST(pnpbs_placement_set_spacing_callback(it.placement, cone_spacing, &second));
  /* A new spacing does not change the nodes before the next run. */
  ck_assert_int_eq(integer_of(it.placement, "nodes"), before.n);
  MUST_COMPUTE(pnpbs_placement_run(it.placement));
  after = result_of(it.placement);
  check_result(&after, 1);

  MUST(pnpbs_placement_set_spacing_callback(fresh.placement, cone_spacing, &second));
  MUST_COMPUTE(pnpbs_placement_run(fresh.placement));
  at_once = result_of(fresh.placement);
  ck_assert_msg(fabs((double)after.n / (double)at_once.n - 1) < tolerance,
                "%d nodes, from nothing %d", (int)after.n, (int)at_once.n);
  now = quality_of(&after);
  then = quality_of(&at_once);
  ck_assert_msg(now.mean > then.mean - 0.02 && now.mean > 0.94 && now.least > 0.5,
                "quality %.4f, least %.3f; from nothing %.4f, %.3f", now.mean, now.least, then.mean,
                then.least);

  stayed = kept(&before, &after);
  ck_assert_msg((double)stayed > least_kept * (double)before.n &&
                    (double)stayed < most_kept * (double)before.n,
                "%d nodes of %d kept their ids", (int)stayed, (int)before.n);
  /* The corners keep their ids. New nodes have new ids. */
  for (i = 0; i < 4; ++i) {
    const double x = (double)(i % 2), y = (double)(i / 2);
    ck_assert_int_eq(before.ids[node_at(&before, x, y)], after.ids[node_at(&after, x, y)]);
  }
  for (i = 0; i < after.n; ++i) {
    if (node_with_id(&before, after.ids[i]) < 0) {
      ck_assert_int_gt(after.ids[i], before.ids[before.n - 1]);
    }
  }
  ck_assert_int_eq(integer_of(it.placement, "dropped"), 0);
  result_free(&before);
  result_free(&after);
  result_free(&at_once);
  job_end(&it);
  job_end(&fresh);
}

START_TEST(refined_to_half) { respace(0.5, 0.05, 0.5, 1); }
END_TEST
START_TEST(coarsened_to_double) { respace(2, 0.05, 0.1, 0.5); }
END_TEST
START_TEST(coarsened_by_half) { respace(1.5, 0.05, 0.2, 0.8); }
END_TEST
START_TEST(coarsened_by_a_quarter) { respace(1.25, 0.1, 0.4, 1); }
END_TEST
START_TEST(refined_to_a_fifth) { respace(0.2, 0.1, 0.1, 1); }
END_TEST
START_TEST(a_little_finer) { respace(0.95, 0.1, 0.7, 1); }
END_TEST

/* Setting the same spacing again changes no node. */
START_TEST(the_same_spacing_again) {
  job it = square_job(1);
  result before, after;
  MUST(pnpbs_placement_set_spacing_constant(it.placement, 0.07));
  MUST_COMPUTE(pnpbs_placement_run(it.placement));
  before = result_of(it.placement);
  MUST(pnpbs_placement_set_spacing_constant(it.placement, 0.07));
  MUST_COMPUTE(pnpbs_placement_run(it.placement));
  after = result_of(it.placement);
  check_result(&after, 1);
  ck_assert_int_eq(kept(&before, &after), before.n);
  ck_assert_int_eq(after.n, before.n);
  result_free(&before);
  result_free(&after);
  job_end(&it);
}
END_TEST

/* If d becomes finer in one corner, the opposite corner keeps its nodes. */
static int32_t finer_in_a_corner(int64_t n, int32_t dim, const double* x, double* d, void* user) {
  int64_t i;
  (void)dim, (void)user;
  for (i = 0; i < n; ++i) d[i] = fmin(0.06, 0.005 + 0.1 * hypot(x[2 * i], x[2 * i + 1]));
  return 0;
}

START_TEST(refined_in_one_corner) {
  job it = square_job(1);
  result before, after;
  int64_t i;
  int far_ones = 0, still_there = 0;
  MUST(pnpbs_placement_set_spacing_constant(it.placement, 0.06));
  MUST_COMPUTE(pnpbs_placement_run(it.placement));
  before = result_of(it.placement);
  MUST(pnpbs_placement_set_spacing_callback(it.placement, finer_in_a_corner, NULL));
  MUST_COMPUTE(pnpbs_placement_run(it.placement));
  after = result_of(it.placement);
  check_result(&after, 1);
  ck_assert_int_gt(after.n, before.n + 100);
  for (i = 0; i < before.n; ++i) {
    if (before.xy[2 * i] + before.xy[2 * i + 1] < 1.2) continue;
    ++far_ones;
    still_there += node_with_id(&after, before.ids[i]) >= 0;
  }
  ck_assert_msg(still_there > 0.9 * far_ones, "%d of %d", still_there, far_ones);
  result_free(&before);
  result_free(&after);
  job_end(&it);
}
END_TEST

START_TEST(a_grid_equals_its_function) {
  /* d = 0.04 + 0.03 x + 0.02 y + 0.05 x y is given on a grid of 5 x 9 points. It is bilinear, so
   * interpolation is exact for coordinates that are multiples of a power of two, and elsewhere up
   * to rounding. */
  const int64_t size[2] = {5, 9};
  const double origin[2] = {0, 0}, step[2] = {0.25, 0.125};
  double values[45];
  job it = square_job(1);
  result nodes;
  int64_t i;
  for (i = 0; i < 45; ++i) {
    const double x = 0.25 * (double)(i % 5), y = 0.125 * (double)(i / 5);
    values[i] = 0.04 + 0.03 * x + 0.02 * y + 0.05 * x * y;
  }
  MUST(pnpbs_placement_set_spacing_grid(it.placement, size, origin, step, values));
  memset(values, 0, sizeof values); /* the library has copied the values */
  MUST_COMPUTE(pnpbs_placement_run(it.placement));
  nodes = result_of(it.placement);
  check_result(&nodes, 1);
  for (i = 0; i < nodes.n; ++i) {
    const double x = nodes.xy[2 * i], y = nodes.xy[2 * i + 1];
    ck_assert_double_eq_tol(nodes.d[i], 0.04 + 0.03 * x + 0.02 * y + 0.05 * x * y, 1e-15);
  }
  result_free(&nodes);
  job_end(&it);
}
END_TEST

static int32_t binary_ramp(int64_t n, int32_t dim, const double* x, double* d, void* user) {
  int64_t i;
  (void)dim, (void)user;
  for (i = 0; i < n; ++i) d[i] = 0.0625;
  for (i = 0; i < n; ++i) d[i] += fmin(fmax(x[2 * i], 0.25), 0.75) < 0.5 ? 0 : 0;
  return 0;
}

/* A grid with equal values gives the bits of the callback, since interpolating 0.0625 is exact. */
START_TEST(a_grid_of_one_value) {
  const int64_t size[2] = {2, 1};
  const double origin[2] = {0.25, 0.5}, step[2] = {0.5, 1}, values[2] = {0.0625, 0.0625};
  job it = square_job(1), other = square_job(1);
  MUST(pnpbs_placement_set_spacing_grid(it.placement, size, origin, step, values));
  MUST(pnpbs_placement_set_spacing_callback(other.placement, binary_ramp, NULL));
  MUST_COMPUTE(pnpbs_placement_run(it.placement));
  MUST_COMPUTE(pnpbs_placement_run(other.placement));
  ck_assert_str_eq(hash_of(it.placement).text, hash_of(other.placement).text);
  job_end(&it);
  job_end(&other);
}
END_TEST

START_TEST(a_grid_is_constant_beyond_its_rim) {
  const int64_t size[2] = {2, 2};
  const double origin[2] = {0.4, 0.4}, step[2] = {0.2, 0.2};
  const double values[4] = {0.05, 0.08, 0.05, 0.08}; /* x varies fastest */
  job it = square_job(1);
  result nodes;
  int64_t i;
  MUST(pnpbs_placement_set_spacing_grid(it.placement, size, origin, step, values));
  MUST_COMPUTE(pnpbs_placement_run(it.placement));
  ck_assert(
      has_warning(it.placement, "the grid of the spacing covers only a part of the domain: of "));
  ck_assert(has_warning(it.placement,
                        "The grid reaches from (0.3, 0.3) to (0.7, 0.7), the domain "
                        "from (0, 0) to (1, 1)"));
  nodes = result_of(it.placement);
  check_result(&nodes, 1);
  for (i = 0; i < nodes.n; ++i) {
    const double t = fmin(fmax((nodes.xy[2 * i] - 0.4) / 0.2, 0), 1);
    ck_assert_double_eq_tol(nodes.d[i], 0.05 + 0.03 * t, 1e-15);
  }
  result_free(&nodes);
  job_end(&it);
}
END_TEST

/* Cells reach half a step beyond the grid points, and d may be larger than the part that is not
 * covered. So there is no warning. */
START_TEST(a_grid_that_covers_the_domain) {
  const int64_t size[2] = {2, 2};
  const double origin[2] = {0.25, 0.27}, step[2] = {0.5, 0.46};
  const double values[4] = {0.05, 0.08, 0.05, 0.08};
  job it = square_job(1);
  MUST(pnpbs_placement_set_spacing_grid(it.placement, size, origin, step, values));
  MUST(pnpbs_placement_initialise(it.placement));
  ck_assert(!has_warning(it.placement, "covers only"));
  job_end(&it);
}
END_TEST

/* A grid that lies beside the domain is an error. With a single point in a direction, d is constant
 * in that direction, so there is no error. */
START_TEST(a_grid_beside_the_domain) {
  const int64_t size[2] = {2, 2}, row[2] = {2, 1};
  const double origin[2] = {0, 5}, step[2] = {1, 1}, values[4] = {0.05, 0.08, 0.05, 0.08};
  job it = square_job(1);
  MUST_FAIL(
      PNPBS_ERROR_SPACING,
      pnpbs_placement_set_spacing_grid(it.placement, size, origin, step, values),
      "arguments size, origin and step",
      "from (-0.5, 4.5) to (1.5, 6.5), at least 3.5 from it; the domain reaches from (0, 0) to "
      "(1, 1)");
  MUST(pnpbs_placement_set_spacing_grid(it.placement, row, origin, step, values));
  job_end(&it);
}
END_TEST

/* Values at nodes are interpolated linearly, so a linear function is reproduced. */
START_TEST(values_at_nodes_equal_their_function) {
  job it = square_job(1);
  result before, after;
  double* d;
  int64_t i;
  MUST(pnpbs_placement_set_spacing_constant(it.placement, 0.04));
  MUST_FAIL(PNPBS_ERROR_STATE, pnpbs_placement_set_spacing_at_nodes(it.placement, 0, NULL), "nodes",
            "");
  MUST_COMPUTE(pnpbs_placement_run(it.placement));
  before = result_of(it.placement);
  d = malloc((size_t)before.n * sizeof *d);
  for (i = 0; i < before.n; ++i)
    d[i] = 0.02 + 0.03 * before.xy[2 * i] + 0.01 * before.xy[2 * i + 1];
  MUST_FAIL(PNPBS_ERROR_ARGUMENT,
            pnpbs_placement_set_spacing_at_nodes(it.placement, before.n - 1, d), "n = ", "");
  MUST_FAIL(PNPBS_ERROR_ARGUMENT,
            pnpbs_placement_set_spacing_at_nodes(it.placement, before.n, NULL), "argument d", "");
  MUST(pnpbs_placement_set_spacing_at_nodes(it.placement, before.n, d));
  memset(d, 0, (size_t)before.n * sizeof *d); /* the library has copied them */
  free(d);
  /* The second run evaluates a spacing whose nodes no longer exist. */
  MUST_COMPUTE(pnpbs_placement_run(it.placement));
  MUST_COMPUTE(pnpbs_placement_run(it.placement));
  after = result_of(it.placement);
  check_result(&after, 1);
  for (i = 0; i < after.n; ++i)
    ck_assert_double_eq_tol(after.d[i], 0.02 + 0.03 * after.xy[2 * i] + 0.01 * after.xy[2 * i + 1],
                            1e-14);
  result_free(&before);
  result_free(&after);
  job_end(&it);
}
END_TEST

/* A cone of slope b > g is limited to slope g: d = a + g r everywhere. */
START_TEST(growth_limits) {
  static const struct {
    double a, b, g;
  } cases[] = {{0.02, 0.2, 0.1}, {0.01, 0.5, 0.1}, {0.02, 1, 0.1}, {0.01, 0.1, 0.2}};
  cone steep = {0, 0, 0.5, 0.5};
  job it = square_job(1);
  const double g = fmin(cases[_i].g, cases[_i].b);
  result nodes;
  int64_t i;
  steep.a = cases[_i].a;
  steep.b = cases[_i].b;
  MUST(pnpbs_placement_set_spacing_callback(it.placement, cone_spacing, &steep));
  MUST(pnpbs_placement_set_double(it.placement, "growth_limit", cases[_i].g));
  MUST_COMPUTE(pnpbs_placement_run(it.placement));
  nodes = result_of(it.placement);
  check_result(&nodes, 1);
  for (i = 0; i < nodes.n; ++i) {
    const double r = hypot(nodes.xy[2 * i] - 0.5, nodes.xy[2 * i + 1] - 0.5);
    const double ratio = nodes.d[i] / (steep.a + g * r);
    ck_assert_msg(ratio > 1 - 1e-9 && ratio < 1.3, "at %g from the middle d is %g times the limit",
                  r, ratio);
  }
  result_free(&nodes);
  job_end(&it);
}
END_TEST

/* ---------------------------------------------------------------- given nodes ----------- */

START_TEST(given_nodes_keep_their_ids) {
  enum { MANY = 300 };
  double xy[2 * MANY + 12];
  int64_t ids[MANY + 6];
  job it = square_job(1);
  result start, end;
  int64_t i;
  int k;
  /* The points form a sunflower about the middle: 300 points well inside. Six further points cannot
   * become nodes. */
  for (k = 0; k < MANY; ++k) {
    const double r = 0.44 * sqrt((k + 0.5) / MANY), t = 2.399963229728653 * k;
    xy[2 * k] = 0.5 + r * cos(t);
    xy[2 * k + 1] = 0.5 + r * sin(t);
    ids[k] = 1000000007LL * (MANY - k);
  }
  {
    const double bad[12] = {-0.5, 0.5, 0.5, 1.5, 0.5, 0.001, 1, 1, 0.5, 0, 1e140, -1e140};
    memcpy(xy + 2 * MANY, bad, sizeof bad);
    for (k = MANY; k < MANY + 6; ++k) ids[k] = k;
  }
  MUST(pnpbs_placement_set_spacing_constant(it.placement, 0.05));
  MUST(pnpbs_placement_set_nodes(it.placement, MANY + 6, xy, ids));
  ck_assert_int_eq(integer_of(it.placement, "nodes"), 0);
  MUST(pnpbs_placement_initialise(it.placement));
  start = result_of(it.placement);
  check_result(&start, 1);
  ck_assert_int_eq(start.n, MANY + 80);
  ck_assert_int_eq(integer_of(it.placement, "dropped"), 6);
  for (k = 0; k < MANY; ++k) {
    i = node_with_id(&start, ids[k]);
    ck_assert_int_ge(i, 0);
    ck_assert(start.xy[2 * i] == xy[2 * k] && start.xy[2 * i + 1] == xy[2 * k + 1]);
    ck_assert_int_eq(start.tags[i], 0);
  }
  MUST_COMPUTE(pnpbs_placement_run(it.placement));
  end = result_of(it.placement);
  check_result(&end, 1);
  ck_assert_double_ge(quality_of(&end).mean, 0.94);
  ck_assert_int_gt(kept(&start, &end), 300);
  /* Initialising begins again from the given nodes, whereas a new spacing begins from the current
   * positions. */
  MUST(pnpbs_placement_initialise(it.placement));
  result_free(&end);
  end = result_of(it.placement);
  check_same(&start, &end);
  result_free(&start);
  result_free(&end);
  job_end(&it);
}
END_TEST

START_TEST(given_nodes_without_ids) {
  const double xy[8] = {0.3, 0.3, 0.7, 0.3, 0.5, 0.6, 0.3, 0.7};
  job it = square_job(1);
  result nodes;
  int k;
  MUST(pnpbs_placement_set_nodes(it.placement, 4, xy, NULL));
  MUST(pnpbs_placement_set_spacing_constant(it.placement, 0.25));
  MUST(pnpbs_placement_initialise(it.placement));
  nodes = result_of(it.placement);
  check_result(&nodes, 1);
  ck_assert_int_eq(nodes.n, 20);
  for (k = 0; k < 4; ++k) ck_assert_int_ge(node_at(&nodes, xy[2 * k], xy[2 * k + 1]), 0);
  result_free(&nodes);
  job_end(&it);
}
END_TEST

/* The result of one placement can be the start of another. */
START_TEST(from_one_placement_to_another) {
  job first = square_job(1), second = square_job(1);
  result before, after;
  MUST(pnpbs_placement_set_spacing_constant(first.placement, 0.06));
  MUST_COMPUTE(pnpbs_placement_run(first.placement));
  before = result_of(first.placement);
  MUST(pnpbs_placement_set_nodes(second.placement, before.n, before.xy, before.ids));
  MUST(pnpbs_placement_set_spacing_constant(second.placement, 0.06));
  MUST_COMPUTE(pnpbs_placement_run(second.placement));
  after = result_of(second.placement);
  check_result(&after, 1);
  /* Boundary nodes are given as well. The library drops them, as it places its own. */
  ck_assert_int_eq(integer_of(second.placement, "dropped"),
                   integer_of(first.placement, "boundary_nodes"));
  ck_assert_int_eq(after.n, before.n);
  ck_assert_int_ge(kept(&before, &after), before.n - integer_of(first.placement, "boundary_nodes"));
  result_free(&before);
  result_free(&after);
  job_end(&first);
  job_end(&second);
}
END_TEST

/* Population control corrects any start: too few nodes, too many, or many at one point. */
START_TEST(bad_starts_are_mended) {
  static double xy[2 * 3000];
  job it = square_job(1);
  int64_t n = 0;
  int k;
  result nodes;
  double wanted;
  if (_i == 0) { /* one node */
    xy[0] = xy[1] = 0.5;
    n = 1;
  } else if (_i == 1) { /* ten times too many nodes */
    for (n = 0; n < 3000; ++n) {
      xy[2 * n] = fmod(0.5 + 0.7548776662466927 * (double)n, 1);
      xy[2 * n + 1] = fmod(0.5 + 0.5698402909980532 * (double)n, 1);
    }
  } else if (_i == 2) { /* many nodes at one point */
    for (n = 0; n < 50; ++n) xy[2 * n] = xy[2 * n + 1] = 0.5;
  } else if (_i == 3) { /* all nodes on one side */
    for (n = 0; n < 100; ++n) {
      xy[2 * n] = 0.1 + 0.001 * (double)(n % 10);
      xy[2 * n + 1] = 0.1 + 0.008 * (double)n;
    }
  } /* otherwise no nodes at all */
  for (k = 0; k < 2; ++k) {
    MUST(pnpbs_placement_set_spacing_constant(it.placement, 0.06));
    MUST(pnpbs_placement_set_nodes(it.placement, n, n > 0 ? xy : NULL, NULL));
    MUST_COMPUTE(pnpbs_placement_run(it.placement));
    nodes = result_of(it.placement);
    check_result(&nodes, 1);
    /* Without a start node no node is inserted. 68 nodes are on the boundary, each of which covers
     * half the area of an inner node. */
    wanted = n == 0 ? 68 : 2 / sqrt(3) / (0.06 * 0.06) + 34;
    ck_assert_msg(fabs((double)nodes.n / wanted - 1) < 0.2, "%d nodes, %d wanted", (int)nodes.n,
                  (int)wanted);
    if (n > 0)
      ck_assert_msg(quality_of(&nodes).mean > 0.9, "mean quality %g", quality_of(&nodes).mean);
    result_free(&nodes);
  }
  job_end(&it);
}
END_TEST

/* ---------------------------------------------------------------- steps ----------------- */

static job stepping_job(void) {
  static cone slope = {0.03, 0.12, 0.2, 0.1};
  job it = square_job(1);
  MUST(pnpbs_placement_set(it.placement, "tolerance_mean", "0"));
  MUST(pnpbs_placement_set_spacing_callback(it.placement, cone_spacing, &slope));
  return it;
}

/* Steps have the same result in portions of any size, with queries in between. */
START_TEST(steps_add_up) {
  enum { STEPS = 77 };
  static const int portions[] = {1, 7, 20, 13};
  job whole = stepping_job(), parts = stepping_job();
  result a, b;
  int done = 0;
  MUST_BE(PNPBS_NOT_CONVERGED, pnpbs_placement_step(whole.placement, STEPS));
  if (_i % 2 == 1) MUST(pnpbs_placement_set(parts.placement, "adjacency_radius", "0.5"));
  MUST(pnpbs_placement_initialise(parts.placement));
  while (done < STEPS) {
    const int n = done + portions[_i] < STEPS ? portions[_i] : STEPS - done;
    int64_t entries = 0;
    MUST_BE(PNPBS_NOT_CONVERGED, pnpbs_placement_step(parts.placement, n));
    done += n;
    if (done % 3 == 0) MUST(pnpbs_placement_adjacency_size(parts.placement, &entries));
    if (done % 5 == 0) MUST(pnpbs_placement_star_size(parts.placement, &entries));
    if (done % 4 == 0) real_of(parts.placement, "d_error.least");
    MUST_BE(PNPBS_NOT_CONVERGED, pnpbs_placement_step(parts.placement, 0));
  }
  ck_assert_int_eq(integer_of(whole.placement, "steps"), STEPS);
  ck_assert_int_eq(integer_of(parts.placement, "steps"), STEPS);
  a = result_of(whole.placement);
  b = result_of(parts.placement);
  check_same(&a, &b);
  check_result(&a, 1);
  ck_assert_str_eq(hash_of(whole.placement).text, hash_of(parts.placement).text);
  result_free(&a);
  result_free(&b);
  job_end(&whole);
  job_end(&parts);
}
END_TEST

/* A run equals its steps followed by a finish; here the finish has nothing to do. */
START_TEST(a_run_is_its_steps) {
  job run = stepping_job(), step = stepping_job();
  MUST(pnpbs_placement_set(run.placement, "steps", "60"));
  MUST(pnpbs_placement_set(run.placement, "sweeps", "0"));
  MUST(pnpbs_placement_set(run.placement, "smoothing_rounds", "0"));
  MUST(pnpbs_placement_set(step.placement, "steps", "60"));
  MUST_BE(PNPBS_NOT_CONVERGED, pnpbs_placement_run(run.placement));
  MUST_BE(PNPBS_NOT_CONVERGED, pnpbs_placement_step(step.placement, 60));
  ck_assert_str_eq(hash_of(run.placement).text, hash_of(step.placement).text);
  job_end(&run);
  job_end(&step);
}
END_TEST

/* step() ends when the bubbles rest, and its status says so. */
START_TEST(steps_until_rest) {
  job it = square_job(1);
  int64_t steps = 0;
  MUST(pnpbs_placement_set_spacing_constant(it.placement, 0.1));
  MUST(pnpbs_placement_step(it.placement, 100000));
  steps = integer_of(it.placement, "steps");
  ck_assert_int_lt(steps, 100000);
  ck_assert(real_of(it.placement, "speed.mean") < 0.004);
  ck_assert(real_of(it.placement, "speed.largest") < 0.15);
  check_placement(it.placement, 1);
  job_end(&it);
}
END_TEST

/* The same job twice in one process has the same bits. */
START_TEST(runs_repeat) {
  job first = stepping_job(), second = stepping_job();
  result a, b;
  MUST_COMPUTE(pnpbs_placement_run(first.placement));
  MUST_COMPUTE(pnpbs_placement_run(second.placement));
  a = result_of(first.placement);
  b = result_of(second.placement);
  check_same(&a, &b);
  ck_assert_str_eq(hash_of(first.placement).text, hash_of(second.placement).text);
  /* Initialising starts from the beginning. */
  MUST(pnpbs_placement_initialise(first.placement));
  ck_assert_str_ne(hash_of(first.placement).text, hash_of(second.placement).text);
  MUST_COMPUTE(pnpbs_placement_run(first.placement));
  result_free(&a);
  a = result_of(first.placement);
  check_same(&a, &b);
  result_free(&a);
  result_free(&b);
  job_end(&first);
  job_end(&second);
}
END_TEST

/* A second run continues the first one and does not reduce the quality. */
START_TEST(run_twice) {
  job it = stepping_job();
  result once, twice;
  quality_summary first, second;
  MUST_COMPUTE(pnpbs_placement_run(it.placement));
  once = result_of(it.placement);
  MUST_COMPUTE(pnpbs_placement_run(it.placement));
  twice = result_of(it.placement);
  check_result(&twice, 1);
  first = quality_of(&once);
  second = quality_of(&twice);
  ck_assert_msg(second.mean > first.mean - 0.01, "quality from %g to %g", first.mean, second.mean);
  ck_assert_int_eq(integer_of(it.placement, "steps"), 600);
  ck_assert_int_gt(kept(&once, &twice), (once.n * 8) / 10);
  result_free(&once);
  result_free(&twice);
  job_end(&it);
}
END_TEST

START_TEST(no_steps_at_all) {
  job it = square_job(1);
  const char* text = NULL;
  hash_text before;
  MUST(pnpbs_placement_set(it.placement, "steps", "0"));
  MUST(pnpbs_placement_set(it.placement, "sweeps", "0"));
  MUST(pnpbs_placement_set(it.placement, "smoothing_rounds", "0"));
  MUST(pnpbs_placement_set_spacing_constant(it.placement, 0.1));
  MUST(pnpbs_placement_initialise(it.placement));
  before = hash_of(it.placement);
  MUST_BE(PNPBS_NOT_CONVERGED, pnpbs_placement_run(it.placement));
  ck_assert_str_eq(hash_of(it.placement).text, before.text);
  ck_assert_int_eq(integer_of(it.placement, "steps"), 0);
  MUST(pnpbs_placement_get_string(it.placement, "stop_reason", &text));
  ck_assert_str_eq(text, "step limit");
  MUST_BE(PNPBS_NOT_CONVERGED, pnpbs_placement_step(it.placement, 0));
  ck_assert_str_eq(hash_of(it.placement).text, before.text);
  check_placement(it.placement, 1);
  job_end(&it);
}
END_TEST

/* ---------------------------------------------------------------- population ------------ */

START_TEST(population_by_hand) {
  job it = square_job(1);
  result before = {0}, after;
  int64_t inserted = -1, deleted = -1, sum_in = 0, sum_out = 0;
  int round;
  const double start[2] = {0.5, 0.5};
  /* The start is one node, so many nodes must be inserted and none deleted. */
  MUST(pnpbs_placement_set_spacing_constant(it.placement, 0.05));
  MUST(pnpbs_placement_set_nodes(it.placement, 1, start, NULL));
  for (round = 0; round < 3; ++round) {
    if (round > 0) before = result_of(it.placement);
    MUST(pnpbs_placement_adjust_population(it.placement, &inserted, &deleted));
    after = result_of(it.placement);
    check_result(&after, 1);
    ck_assert_int_gt(inserted, 0);
    ck_assert_int_eq(deleted, 0);
    if (round > 0) ck_assert_int_eq(after.n, before.n + inserted);
    sum_in += inserted;
    sum_out += deleted;
    ck_assert_int_eq(integer_of(it.placement, "inserted"), sum_in);
    ck_assert_int_eq(integer_of(it.placement, "deleted"), sum_out);
    result_free(&before);
    result_free(&after);
  }
  /* The spacing is now far coarser, so many nodes must be deleted. */
  MUST(pnpbs_placement_set_spacing_constant(it.placement, 0.2));
  MUST(pnpbs_placement_adjust_population(it.placement, &inserted, &deleted));
  ck_assert_int_gt(deleted, 0);
  check_placement(it.placement, 1);
  job_end(&it);
}
END_TEST

/* Changing the domain does not affect the nodes of a placement until it is initialised again. */
START_TEST(the_domain_is_taken_at_initialise) {
  job it = stepping_job(), plain = stepping_job();
  double area = 0;
  MUST_COMPUTE(pnpbs_placement_step(it.placement, 50));
  MUST_COMPUTE(pnpbs_placement_step(plain.placement, 50));
  add_rectangle(it.domain, PNPBS_BOUNDARY, 3, 0, 4, 1, 2);
  MUST(pnpbs_domain_measure(it.domain, &area));
  ck_assert_double_eq_tol(area, 2, 1e-12);
  MUST_COMPUTE(pnpbs_placement_run(it.placement));
  MUST_COMPUTE(pnpbs_placement_run(plain.placement));
  ck_assert_str_eq(hash_of(it.placement).text, hash_of(plain.placement).text);
  MUST(pnpbs_placement_initialise(it.placement));
  check_placement(it.placement, 2);
  job_end(&it);
  job_end(&plain);
}
END_TEST

TEST_SUITE(test_adapting) {
  Suite* suite = suite_create("adapting");
  TCase* spacing = tcase_create("spacing");
  TCase* given = tcase_create("given nodes");
  TCase* steps = tcase_create("steps");
  tcase_add_test(spacing, refined_to_half);
  tcase_add_test(spacing, coarsened_to_double);
  tcase_add_test(spacing, coarsened_by_half);
  tcase_add_test(spacing, coarsened_by_a_quarter);
  tcase_add_test(spacing, refined_to_a_fifth);
  tcase_add_test(spacing, a_little_finer);
  tcase_add_test(spacing, the_same_spacing_again);
  tcase_add_test(spacing, refined_in_one_corner);
  tcase_add_test(spacing, a_grid_equals_its_function);
  tcase_add_test(spacing, a_grid_of_one_value);
  tcase_add_test(spacing, a_grid_is_constant_beyond_its_rim);
  tcase_add_test(spacing, a_grid_that_covers_the_domain);
  tcase_add_test(spacing, a_grid_beside_the_domain);
  tcase_add_test(spacing, values_at_nodes_equal_their_function);
  tcase_add_loop_test(spacing, growth_limits, 0, 4);
  suite_add_tcase(suite, spacing);
  tcase_add_test(given, given_nodes_keep_their_ids);
  tcase_add_test(given, given_nodes_without_ids);
  tcase_add_test(given, from_one_placement_to_another);
  tcase_add_loop_test(given, bad_starts_are_mended, 0, 5);
  suite_add_tcase(suite, given);
  tcase_add_loop_test(steps, steps_add_up, 0, 4);
  tcase_add_test(steps, a_run_is_its_steps);
  tcase_add_test(steps, steps_until_rest);
  tcase_add_test(steps, runs_repeat);
  tcase_add_test(steps, run_twice);
  tcase_add_test(steps, no_steps_at_all);
  tcase_add_test(steps, population_by_hand);
  tcase_add_test(steps, the_domain_is_taken_at_initialise);
  suite_add_tcase(suite, steps);
  return run_suite(suite);
}
