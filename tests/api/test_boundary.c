/* SPDX-License-Identifier: BSD-3-Clause
 *
 * Tests nodes on the curves that the user gives: corners, arcs, curves by callback, fixed nodes,
 * and the regions between curves.
 */
#include "api_support.h"

static void run(job* it, double d) {
  job_place(it);
  MUST(pnpbs_placement_set(it->placement, "steps", "60"));
  MUST(pnpbs_placement_set_spacing_constant(it->placement, d));
  MUST_COMPUTE(pnpbs_placement_run(it->placement));
}

static double edge_length(const result* it, int64_t e) {
  const double *a = it->xy + 2 * it->ends[2 * e], *b = it->xy + 2 * it->ends[2 * e + 1];
  return hypot(a[0] - b[0], a[1] - b[1]);
}

/* Returns the number of boundary edges with this tag, and the sum of their lengths. */
static int edges_tagged(const result* it, int32_t tag, double* length) {
  int64_t e;
  int count = 0;
  *length = 0;
  for (e = 0; e < it->edges; ++e) {
    if (it->edge_tags[e] != tag) continue;
    ++count;
    *length += edge_length(it, e);
  }
  return count;
}

static void check_corner(const result* it, double x, double y, int32_t tag) {
  const int64_t i = node_at(it, x, y);
  ck_assert_msg(i >= 0, "no node at (%.17g, %.17g)", x, y);
  ck_assert_int_eq(it->tags[i], tag);
}

/* ---------------------------------------------------------------- corners and tags ------ */

START_TEST(corners_and_tags_of_a_polyline) {
  /* These coordinates are not results of simple arithmetic. */
  const double xy[10] = {0.1, 0.3, 2.7, 1.0 / 3, 3.3, 1.7, 1.9, 2.9000000000000004, 0.2, 2.3};
  const int32_t tags[5] = {10, 20, -30, 2147483647, 50};
  job it = job_begin();
  result nodes;
  int64_t i;
  int k;
  double area = 0, length;
  MUST(pnpbs_domain_add_polyline(it.domain, PNPBS_BOUNDARY, 1, 5, xy, tags, 0));
  MUST(pnpbs_domain_measure(it.domain, &area));
  run(&it, 0.2);
  nodes = result_of(it.placement);
  check_result(&nodes, 1);
  ck_assert_double_eq_tol(triangle_area(&nodes), area, 1e-12);
  /* A corner has the tag of the segment that ends there, except the first corner, which has that of
   * the first segment. */
  for (k = 0; k < 5; ++k) {
    check_corner(&nodes, xy[2 * k], xy[2 * k + 1], k == 0 ? tags[0] : tags[k - 1]);
  }
  /* Other nodes have the tag of their segment and divide it into equal steps. */
  for (k = 0; k < 5; ++k) {
    const double *a = xy + 2 * k, *b = xy + 2 * ((k + 1) % 5);
    const double whole = hypot(b[0] - a[0], b[1] - a[1]);
    const int count = edges_tagged(&nodes, tags[k], &length);
    ck_assert_int_eq(count, lround(whole / 0.2));
    ck_assert_double_eq_tol(length, whole, 1e-12);
    for (i = 0; i < nodes.edges; ++i) {
      if (nodes.edge_tags[i] != tags[k]) continue;
      ck_assert_double_eq_tol(edge_length(&nodes, i), whole / count, 1e-12);
    }
  }
  for (i = 0; i < nodes.n; ++i) {
    if (!nodes.on_boundary[i]) ck_assert_int_eq(nodes.tags[i], 0);
  }
  result_free(&nodes);
  job_end(&it);
}
END_TEST

/* With a corner angle, only vertices at which the curve turns by more than this angle are nodes. */
START_TEST(a_polyline_that_is_a_circle) {
  double xy[2 * 360 + 4];
  job it = job_begin();
  result nodes;
  int k;
  double length;
  for (k = 0; k <= 180; ++k) {
    xy[2 * k] = cos(PI * k / 180);
    xy[2 * k + 1] = sin(PI * k / 180);
  }
  MUST(pnpbs_domain_add_polyline(it.domain, PNPBS_BOUNDARY, 1, 181, xy, NULL, 30));
  run(&it, 0.1);
  nodes = result_of(it.placement);
  check_result(&nodes, 1);
  check_corner(&nodes, xy[0], xy[1], 1);
  check_corner(&nodes, xy[360], xy[361], 1);
  ck_assert_int_eq(edges_tagged(&nodes, 1, &length), 20 + 31);
  result_free(&nodes);
  job_end(&it);
}
END_TEST

START_TEST(tags_of_a_graph) {
  const double xy[10] = {0, 0, 1, 0, 1, 1, 0, 1, 0.5, 0.5};
  const int32_t vertex_tags[5] = {7, 0, 9, 0, 11};
  const int64_t ends[8] = {0, 1, 1, 2, 2, 3, 3, 0};
  const int32_t segment_tags[4] = {1, 2, 0, 4}; /* the tag 0 means no marker and becomes 1 */
  job it = job_begin();
  result nodes;
  double length;
  MUST(pnpbs_domain_add_pslg(it.domain, 5, xy, vertex_tags, 4, ends, segment_tags, 0, NULL));
  run(&it, 0.1);
  nodes = result_of(it.placement);
  check_result(&nodes, 1);
  check_corner(&nodes, 0, 0, 7);
  check_corner(&nodes, 1, 0, 1);
  check_corner(&nodes, 1, 1, 9);
  check_corner(&nodes, 0, 1, 1);
  check_corner(&nodes, 0.5, 0.5, 11); /* not in a segment, so a fixed node */
  ck_assert_int_eq(edges_tagged(&nodes, 1, &length), 20);
  ck_assert_int_eq(edges_tagged(&nodes, 2, &length), 10);
  ck_assert_int_eq(edges_tagged(&nodes, 4, &length), 10);
  result_free(&nodes);
  job_end(&it);
}
END_TEST

/* ---------------------------------------------------------------- curves ---------------- */

static void check_on_circle(const result* nodes, int32_t tag, double x, double y, double radius) {
  int64_t i;
  int count = 0;
  for (i = 0; i < nodes->n; ++i) {
    if (nodes->tags[i] != tag) continue;
    ++count;
    ck_assert_double_eq_tol(hypot(nodes->xy[2 * i] - x, nodes->xy[2 * i + 1] - y), radius, 1e-12);
  }
  ck_assert_int_gt(count, 5);
}

START_TEST(arcs_are_followed_exactly) {
  job it = job_begin();
  result before, after;
  int64_t i, e;
  double length, area = 0;
  int count;
  add_circle(it.domain, PNPBS_BOUNDARY, 0.25, -0.5, 1.5, 3);
  add_circle(it.domain, PNPBS_BOUNDARY, 0.5, -0.25, 0.5, 4);
  job_place(&it);
  MUST(pnpbs_placement_set_spacing_constant(it.placement, 0.1));
  MUST(pnpbs_placement_initialise(it.placement));
  before = result_of(it.placement);
  check_on_circle(&before, 3, 0.25, -0.5, 1.5);
  check_on_circle(&before, 4, 0.5, -0.25, 0.5);
  MUST_COMPUTE(pnpbs_placement_run(it.placement));
  after = result_of(it.placement);
  check_result(&after, 0);
  check_on_circle(&after, 3, 0.25, -0.5, 1.5);
  check_on_circle(&after, 4, 0.5, -0.25, 0.5);
  /* Boundary nodes must not move. */
  for (i = 0; i < before.n; ++i) {
    int64_t now;
    if (!before.on_boundary[i]) continue;
    now = node_with_id(&after, before.ids[i]);
    ck_assert_int_ge(now, 0);
    ck_assert(after.xy[2 * now] == before.xy[2 * i]);
    ck_assert(after.xy[2 * now + 1] == before.xy[2 * i + 1]);
    ck_assert_int_eq(after.tags[now], before.tags[i]);
  }
  /* Steps on the arc are equal, so edges are equal. */
  count = edges_tagged(&after, 3, &length);
  ck_assert_int_eq(count, lround(2 * PI * 1.5 / 0.1));
  for (e = 0; e < after.edges; ++e) {
    if (after.edge_tags[e] != 3) continue;
    ck_assert_double_eq_tol(edge_length(&after, e), 2 * 1.5 * sin(PI / count), 1e-9);
  }
  /* The triangles fill the difference of the two inscribed polygons. */
  MUST(pnpbs_domain_measure(it.domain, &area));
  ck_assert_double_eq_tol(area, PI * (1.5 * 1.5 - 0.5 * 0.5), 1e-6);
  area = 0.5 * count * 1.5 * 1.5 * sin(2 * PI / count);
  count = edges_tagged(&after, 4, &length);
  area -= 0.5 * count * 0.5 * 0.5 * sin(2 * PI / count);
  ck_assert_double_eq_tol(triangle_area(&after), area, 1e-10);
  result_free(&before);
  result_free(&after);
  job_end(&it);
}
END_TEST

/* Arcs and segments join to a stadium. Their ends need to agree only to 1e-9 of the size. */
START_TEST(arcs_that_join_segments) {
  const double right[2] = {2, 0}, left[2] = {0, 0};
  const double below[4] = {0, -1, 2, -1}, above[4] = {2, 1 + 1e-12, 0, 1};
  const int32_t tag_below = 1, tag_above = 3;
  job it = job_begin();
  result nodes;
  double length;
  MUST(pnpbs_domain_add_polyline(it.domain, PNPBS_BOUNDARY, 0, 2, below, &tag_below, 0));
  MUST(pnpbs_domain_add_arc(it.domain, PNPBS_BOUNDARY, right, 1, -PI / 2, PI / 2, 2));
  MUST(pnpbs_domain_add_polyline(it.domain, PNPBS_BOUNDARY, 0, 2, above, &tag_above, 0));
  MUST(pnpbs_domain_add_arc(it.domain, PNPBS_BOUNDARY, left, 1, 3 * PI / 2, PI / 2, 4));
  run(&it, 0.15);
  nodes = result_of(it.placement);
  check_result(&nodes, 1);
  ck_assert_int_eq(edges_tagged(&nodes, 1, &length), 13);
  ck_assert_int_eq(edges_tagged(&nodes, 2, &length), 21);
  ck_assert_int_eq(edges_tagged(&nodes, 4, &length), 21);
  result_free(&nodes);
  job_end(&it);
}
END_TEST

/* A curve callback: r = 1 + 0.3 cos 5 t. */
static int32_t flower(int64_t n, int32_t dim, const double* t, double* xy, void* user) {
  (void)dim;
  int64_t i;
  (void)user;
  for (i = 0; i < n; ++i) {
    const double r = 1 + 0.3 * cos(5 * t[i]);
    xy[2 * i] = r * cos(t[i]);
    xy[2 * i + 1] = r * sin(t[i]);
  }
  return 0;
}

START_TEST(a_curve_by_callback) {
  job it = job_begin();
  result nodes;
  int64_t i;
  MUST(pnpbs_domain_add_curve(it.domain, PNPBS_BOUNDARY, flower, NULL, 0, 2 * PI, 6));
  run(&it, 0.06);
  nodes = result_of(it.placement);
  check_result(&nodes, 1);
  for (i = 0; i < nodes.n; ++i) {
    const double *x = nodes.xy + 2 * i, t = atan2(x[1], x[0]);
    if (!nodes.on_boundary[i]) continue;
    ck_assert_int_eq(nodes.tags[i], 6);
    ck_assert_double_eq_tol(hypot(x[0], x[1]), 1 + 0.3 * cos(5 * t), 1e-12);
  }
  result_free(&nodes);
  job_end(&it);
}
END_TEST

/* Steps on a curve are equal in length, for any speed of the parameter. */
START_TEST(equal_steps_on_a_curve) {
  job it = job_begin();
  result nodes;
  int64_t e;
  double shortest = 1, longest = 0;
  MUST(pnpbs_domain_add_curve(it.domain, PNPBS_BOUNDARY, flower, NULL, 0, 2 * PI, 6));
  job_place(&it);
  MUST(pnpbs_placement_set_spacing_constant(it.placement, 0.02));
  MUST(pnpbs_placement_initialise(it.placement));
  nodes = result_of(it.placement);
  for (e = 0; e < nodes.edges; ++e) {
    shortest = fmin(shortest, edge_length(&nodes, e) / 0.02);
    longest = fmax(longest, edge_length(&nodes, e) / 0.02);
  }
  ck_assert_msg(shortest > 0.97 && longest < 1.03, "boundary edges from %g d to %g d", shortest,
                longest);
  result_free(&nodes);
  job_end(&it);
}
END_TEST

/* ---------------------------------------------------------------- inner curves ---------- */

/* Checks that the nodes with this tag form a chain of boundary edges from (x0, y0) to (x1, y1), or
 * a ring if both ends are equal. Both stars must have each edge. Returns the number of edges. */
static int follow(const result* it, int32_t tag, double x0, double y0, double x1, double y1) {
  const int64_t first = node_at(it, x0, y0), last = node_at(it, x1, y1);
  int64_t now = first, before = -1;
  int count = 0;
  ck_assert_int_ge(first, 0);
  ck_assert_int_ge(last, 0);
  do {
    int64_t e, next = -1;
    for (e = 0; e < it->edges && next < 0; ++e) {
      const int64_t a = it->ends[2 * e], b = it->ends[2 * e + 1];
      if (it->edge_tags[e] != tag) continue;
      if (a == now && b != before) next = b;
      if (b == now && a != before) next = a;
    }
    ck_assert_msg(next >= 0, "the curve breaks off at (%g, %g)", it->xy[2 * now],
                  it->xy[2 * now + 1]);
    ck_assert(are_star_neighbours(it, now, next));
    before = now;
    now = next;
    ++count;
    ck_assert_int_le(count, it->edges);
  } while (now != last);
  return count;
}

START_TEST(an_open_inner_curve) {
  const double xy[8] = {0.21, 0.27, 0.4, 0.61, 0.55, 0.33, 0.83, 0.71};
  const int32_t tags[3] = {8, 8, 8};
  job it = job_begin();
  result nodes;
  add_rectangle(it.domain, PNPBS_BOUNDARY, 0, 0, 1, 1, 1);
  MUST(pnpbs_domain_add_polyline(it.domain, PNPBS_INNER, 0, 4, xy, tags, 0));
  run(&it, 0.05);
  nodes = result_of(it.placement);
  check_result(&nodes, 1);
  ck_assert_double_eq_tol(triangle_area(&nodes), 1, 1e-12);
  check_corner(&nodes, xy[2], xy[3], 8);
  check_corner(&nodes, xy[4], xy[5], 8);
  ck_assert_int_eq(follow(&nodes, 8, xy[0], xy[1], xy[6], xy[7]),
                   lround(hypot(0.19, 0.34) / 0.05) + lround(hypot(0.15, 0.28) / 0.05) +
                       lround(hypot(0.28, 0.38) / 0.05));
  result_free(&nodes);
  job_end(&it);
}
END_TEST

START_TEST(a_smooth_inner_curve) {
  double xy[2 * 41], length;
  int k;
  job it = job_begin();
  result nodes;
  for (k = 0; k <= 40; ++k) {
    xy[2 * k] = 0.2 + 0.6 * k / 40;
    xy[2 * k + 1] = 0.5 + 0.2 * sin(2 * PI * k / 40);
  }
  add_rectangle(it.domain, PNPBS_BOUNDARY, 0, 0, 1, 1, 1);
  MUST(pnpbs_domain_add_polyline(it.domain, PNPBS_INNER, 0, 41, xy, NULL, 45));
  run(&it, 0.07);
  nodes = result_of(it.placement);
  check_result(&nodes, 1);
  /* Both curves have tag 1: the outline has 4 x 14 edges and the wave 15. */
  ck_assert_int_eq(edges_tagged(&nodes, 1, &length), 56 + 15);
  check_corner(&nodes, xy[0], xy[1], 1);
  check_corner(&nodes, xy[80], xy[81], 1);
  result_free(&nodes);
  job_end(&it);
}
END_TEST

START_TEST(a_closed_inner_curve) {
  job it = job_begin();
  result nodes;
  double length;
  int64_t i;
  int count, inner = 0;
  add_rectangle(it.domain, PNPBS_BOUNDARY, 0, 0, 1, 1, 1);
  add_circle(it.domain, PNPBS_INNER, 0.5, 0.5, 0.3, 2);
  run(&it, 0.06);
  nodes = result_of(it.placement);
  check_result(&nodes, 1);
  ck_assert_double_eq_tol(triangle_area(&nodes), 1, 1e-12);
  check_on_circle(&nodes, 2, 0.5, 0.5, 0.3);
  count = edges_tagged(&nodes, 2, &length);
  ck_assert_int_eq(count, lround(2 * PI * 0.3 / 0.06));
  for (i = 0; i < nodes.n && nodes.tags[i] != 2; ++i) {
  }
  ck_assert_int_eq(
      follow(&nodes, 2, nodes.xy[2 * i], nodes.xy[2 * i + 1], nodes.xy[2 * i], nodes.xy[2 * i + 1]),
      count);
  for (i = 0; i < nodes.n; ++i) {
    inner += nodes.tags[i] == 0 && hypot(nodes.xy[2 * i] - 0.5, nodes.xy[2 * i + 1] - 0.5) < 0.3;
  }
  ck_assert_int_gt(inner, 40); /* an inner curve is not a hole */
  result_free(&nodes);
  job_end(&it);
}
END_TEST

/* Inner curves join at common vertices: one leads from the outline to the outline, the other from
 * the first to the outline. */
START_TEST(inner_curves_that_meet) {
  const double across[6] = {0, 0.4, 0.5, 0.5, 1, 0.4};
  const double upward[4] = {0.5, 0.5, 0.5, 1};
  const double outline[14] = {0, 0, 1, 0, 1, 0.4, 1, 1, 0.5, 1, 0, 1, 0, 0.4};
  const int32_t tags[2] = {5, 5}, tag = 6;
  job it = job_begin();
  result nodes;
  MUST(pnpbs_domain_add_polyline(it.domain, PNPBS_BOUNDARY, 1, 7, outline, NULL, 0));
  MUST(pnpbs_domain_add_polyline(it.domain, PNPBS_INNER, 0, 3, across, tags, 0));
  MUST(pnpbs_domain_add_polyline(it.domain, PNPBS_INNER, 0, 2, upward, &tag, 0));
  run(&it, 0.05);
  nodes = result_of(it.placement);
  check_result(&nodes, 1);
  ck_assert_double_eq_tol(triangle_area(&nodes), 1, 1e-12);
  ck_assert_int_eq(follow(&nodes, 5, 0, 0.4, 1, 0.4), 20);
  ck_assert_int_eq(follow(&nodes, 6, 0.5, 0.5, 0.5, 1), 10);
  ck_assert_double_ge(quality_of(&nodes).least, 0.3);
  result_free(&nodes);
  job_end(&it);
}
END_TEST

/* ---------------------------------------------------------------- fixed nodes ----------- */

START_TEST(fixed_nodes_appear_exactly) {
  const double xy[12] = {0.30000000000000004, 0.7, 1.0 / 3, 0.2, 0.61, 0.62, 0.81,
                         0.1234567890123,     0.7, 0.7,     1,   1}; /* the last one is a corner */
  const int32_t tags[6] = {11, -12, 13, 14, 15, 16};
  job it = job_begin();
  result before, after;
  int k;
  add_rectangle(it.domain, PNPBS_BOUNDARY, 0, 0, 1, 1, 1);
  MUST(pnpbs_domain_add_fixed_nodes(it.domain, 6, xy, tags));
  MUST(pnpbs_domain_add_fixed_nodes(it.domain, 0, NULL, NULL));
  job_place(&it);
  MUST(pnpbs_placement_set_spacing_constant(it.placement, 0.06));
  MUST(pnpbs_placement_initialise(it.placement));
  before = result_of(it.placement);
  MUST_COMPUTE(pnpbs_placement_run(it.placement));
  after = result_of(it.placement);
  check_result(&after, 1);
  for (k = 0; k < 6; ++k) {
    const int64_t i = node_at(&before, xy[2 * k], xy[2 * k + 1]);
    const int64_t j = node_at(&after, xy[2 * k], xy[2 * k + 1]);
    double nearest = 1;
    int64_t other;
    ck_assert_msg(i >= 0 && j >= 0, "fixed node %d is missing", k);
    ck_assert_int_eq(before.ids[i], after.ids[j]);
    ck_assert_int_eq(after.tags[j], tags[k]);
    /* Other nodes keep away from a fixed node. */
    for (other = 0; other < after.n; ++other) {
      if (other == j) continue;
      nearest = fmin(
          nearest, hypot(after.xy[2 * other] - xy[2 * k], after.xy[2 * other + 1] - xy[2 * k + 1]));
    }
    ck_assert_msg(nearest > 0.35 * 0.06, "a node is %g d off fixed node %d", nearest / 0.06, k);
  }
  ck_assert_int_eq(integer_of(it.placement, "boundary_nodes"), 4 * 17 + 5);
  result_free(&before);
  result_free(&after);
  job_end(&it);
}
END_TEST

START_TEST(fixed_nodes_that_do_not_fit) {
  const double outside[2] = {1.5, 0.5}, close[4] = {0.5, 0.5, 0.5 + 1e-3, 0.5};
  job it = job_begin();
  const char* text = NULL;
  int32_t warnings = 0;
  add_rectangle(it.domain, PNPBS_BOUNDARY, 0, 0, 1, 1, 1);
  MUST(pnpbs_domain_add_fixed_nodes(it.domain, 1, outside, NULL));
  MUST_FAIL(PNPBS_ERROR_DOMAIN, pnpbs_domain_check(it.domain), "fixed node 0", "(1.5, 0.5)");
  job_end(&it);
  it = job_begin();
  add_rectangle(it.domain, PNPBS_BOUNDARY, 0, 0, 1, 1, 1);
  MUST(pnpbs_domain_add_fixed_nodes(it.domain, 2, close, NULL));
  run(&it, 0.1);
  MUST(pnpbs_placement_warning_count(it.placement, &warnings));
  ck_assert_int_eq(warnings, 1);
  MUST(pnpbs_placement_get_warning(it.placement, 0, &text));
  ck_assert_ptr_nonnull(strstr(text, "fixed node"));
  MUST_FAIL(PNPBS_ERROR_ARGUMENT, pnpbs_placement_get_warning(it.placement, 1, &text), "1 warnings",
            "");
  check_placement(it.placement, 1);
  job_end(&it);
}
END_TEST

/* ---------------------------------------------------------------- regions --------------- */

START_TEST(disjoint_pieces) {
  job it = job_begin();
  result nodes;
  double area = 0, low[2], high[2];
  int64_t i;
  int in_first = 0, in_second = 0, in_third = 0;
  add_rectangle(it.domain, PNPBS_BOUNDARY, 0, 0, 1, 1, 1);
  add_rectangle(it.domain, PNPBS_BOUNDARY, 1.02, 0, 2, 1, 2); /* at a distance of less than d */
  add_circle(it.domain, PNPBS_BOUNDARY, 10, 10, 0.5, 3);
  MUST(pnpbs_domain_measure(it.domain, &area));
  ck_assert_double_eq_tol(area, 1.98 + PI / 4, 1e-6);
  MUST(pnpbs_domain_bounds(it.domain, low, high));
  ck_assert(low[0] == 0 && low[1] == 0);
  ck_assert_double_eq_tol(high[0], 10.5, 1e-6);
  ck_assert_double_eq_tol(high[1], 10.5, 1e-6);
  run(&it, 0.08);
  nodes = result_of(it.placement);
  check_result(&nodes, 3);
  for (i = 0; i < nodes.n; ++i) {
    const double* x = nodes.xy + 2 * i;
    if (nodes.tags[i] != 0) continue;
    in_first += x[0] > 0 && x[0] < 1 && x[1] > 0 && x[1] < 1;
    in_second += x[0] > 1.02 && x[0] < 2 && x[1] > 0 && x[1] < 1;
    in_third += hypot(x[0] - 10, x[1] - 10) < 0.5;
  }
  ck_assert_int_gt(in_first, 100);
  ck_assert_int_gt(in_second, 100);
  ck_assert_int_gt(in_third, 80);
  ck_assert_int_eq(in_first + in_second + in_third + integer_of(it.placement, "boundary_nodes"),
                   nodes.n);
  result_free(&nodes);
  job_end(&it);
}
END_TEST

/* Five nested squares are a lake with an island with a pond with an islet in turn. */
START_TEST(nested_holes_and_islands) {
  job it = job_begin();
  result nodes;
  double area = 0;
  int64_t i;
  int where[5] = {0, 0, 0, 0, 0};
  int k;
  for (k = 0; k < 5; ++k) {
    const double r = 2.5 - 0.5 * k;
    add_rectangle(it.domain, PNPBS_BOUNDARY, -r, -r, r, r, k + 1);
  }
  MUST(pnpbs_domain_measure(it.domain, &area));
  ck_assert_double_eq_tol(area, 25 - 16 + 9 - 4 + 1, 1e-12);
  run(&it, 0.11);
  nodes = result_of(it.placement);
  /* Two rings and a square have the Euler number 1 = 3 pieces - 2 holes. */
  check_result(&nodes, 1);
  ck_assert_double_eq_tol(triangle_area(&nodes), area, 1e-11);
  for (i = 0; i < nodes.n; ++i) {
    const double far_out = fmax(fabs(nodes.xy[2 * i]), fabs(nodes.xy[2 * i + 1]));
    if (nodes.tags[i] == 0) ++where[(int)((2.5 - far_out) / 0.5)];
  }
  ck_assert_int_gt(where[0], 100);
  ck_assert_int_eq(where[1], 0);
  ck_assert_int_gt(where[2], 50);
  ck_assert_int_eq(where[3], 0);
  ck_assert_int_gt(where[4], 10);
  result_free(&nodes);
  job_end(&it);
}
END_TEST

START_TEST(holes_by_points) {
  const double point[2] = {0.5, 0.5}, beyond[2] = {3, 3};
  job it = job_begin();
  double area = 0;
  add_rectangle(it.domain, PNPBS_BOUNDARY, 0, 0, 1, 1, 1);
  add_circle(it.domain, PNPBS_INNER, 0.5, 0.5, 0.25, 2);
  MUST(pnpbs_domain_measure(it.domain, &area));
  ck_assert_double_eq_tol(area, 1, 1e-12);
  MUST(pnpbs_domain_add_hole(it.domain, point));
  MUST(pnpbs_domain_measure(it.domain, &area));
  ck_assert_double_eq_tol(area, 1 - PI / 16, 1e-6);
  run(&it, 0.07);
  check_placement(it.placement, 0);
  MUST(pnpbs_domain_add_hole(it.domain, beyond));
  MUST_FAIL(PNPBS_ERROR_DOMAIN, pnpbs_domain_check(it.domain), "hole", "(3, 3)");
  job_end(&it);
}
END_TEST

/* The file follows Triangle's rules: it has shared vertices, a T-junction, a loop without a hole
 * point, and a hole. */
START_TEST(a_graph_by_text) {
  static const char text[] =
      "# a box with a hole, a loop and a wall\n"
      "14 2 1 1\n"
      "1  0 0  9.5 0\n2  4 0  9.5 0\n3  4 3  9.5 0\n4  0 3  9.5 0\n"
      "5  0.5 0.5 0 0\n6  1.5 0.5 0 0\n7  1.5 1.5 0 0\n8  0.5 1.5 0 0\n"
      "9  2.5 0.5 0 0\n10 3.5 0.5 0 0\n11 3.5 1.5 0 0\n12 2.5 1.5 0 0\n"
      "13 2 3 0 0 # on the outline\n14 2 2 0 77\n"
      "13 1\n"
      "1 1 2 1\n2 2 3 1\n3 3 4 1\n4 4 1 1\n"
      "5 5 6 2\n6 6 7 2\n7 7 8 2\n8 8 5 2\n"
      "9 9 10 3\n10 10 11 3\n11 11 12 3\n12 12 9 3\n"
      "13 13 14 4\n"
      "1\n1 1 1\n";
  job it = job_begin();
  result nodes;
  double area = 0, length;
  MUST(pnpbs_domain_parse_poly(it.domain, text, (int64_t)strlen(text), "a box"));
  MUST(pnpbs_domain_measure(it.domain, &area));
  ck_assert_double_eq_tol(area, 11, 1e-12);
  run(&it, 0.125);
  nodes = result_of(it.placement);
  check_result(&nodes, 0);
  ck_assert_double_eq_tol(triangle_area(&nodes), 11, 1e-11);
  ck_assert_int_eq(edges_tagged(&nodes, 2, &length), 32);
  ck_assert_int_eq(edges_tagged(&nodes, 3, &length), 32);
  ck_assert_int_eq(follow(&nodes, 4, 2, 3, 2, 2), 8);
  check_corner(&nodes, 2, 2, 77);
  ck_assert_double_ge(quality_of(&nodes).least, 0.4);
  result_free(&nodes);
  job_end(&it);
}
END_TEST

START_TEST(segments_show_the_domain) {
  job it = job_begin();
  int64_t n = 0, again = 0, s;
  double* segments;
  int32_t* tags;
  double around = 0, length = 0;
  add_rectangle(it.domain, PNPBS_BOUNDARY, 0, 0, 4, 4, 1);
  add_circle(it.domain, PNPBS_BOUNDARY, 2, 2, 1, 2);
  MUST(pnpbs_domain_get_segments(it.domain, 0, &n, NULL, NULL));
  ck_assert_int_gt(n, 4 + 16);
  segments = malloc((size_t)n * 4 * sizeof *segments);
  tags = malloc((size_t)n * sizeof *tags);
  MUST(pnpbs_domain_get_segments(it.domain, n, &again, segments, tags));
  ck_assert_int_eq(again, n);
  for (s = 0; s < n; ++s) {
    const double* p = segments + 4 * s;
    const double l = hypot(p[2] - p[0], p[3] - p[1]);
    ck_assert(tags[s] == 1 || tags[s] == 2);
    if (tags[s] == 1) length += l;
    if (tags[s] == 2) {
      around += l;
      ck_assert_double_eq_tol(hypot(p[0] - 2, p[1] - 2), 1, 1e-12);
    }
  }
  ck_assert_double_eq_tol(length, 16, 1e-12);
  ck_assert_double_eq_tol(around, 2 * PI, 0.01);
  MUST(pnpbs_domain_get_segments(it.domain, n + 5, &again, segments, NULL));
  MUST(pnpbs_domain_get_segments(it.domain, n, &again, NULL, tags));
  free(segments);
  free(tags);
  job_end(&it);
}
END_TEST

/* The triangles of a real lake fill it completely and nothing outside. */
START_TEST(a_lake) {
  job it = job_begin();
  cone slope = {8, 0.04, 0, 0};
  result nodes;
  double area = 0;
  MUST(pnpbs_domain_read_poly(it.domain, PNPBS_SOURCE_DIR "/examples/data/lake_victoria.poly"));
  MUST(pnpbs_domain_measure(it.domain, &area));
  job_place(&it);
  MUST(pnpbs_placement_set_spacing_callback(it.placement, cone_spacing, &slope));
  MUST_COMPUTE(pnpbs_placement_run(it.placement));
  nodes = result_of(it.placement);
  check_result(&nodes, 1);
  ck_assert_double_eq_tol(triangle_area(&nodes) / area, 1, 1e-9);
  result_free(&nodes);
  job_end(&it);
}
END_TEST

/* ---------------------------------------------------------------- finer than d ---------- */

/* ---------------------------------------------------------------- tags of the outline --- */

/* Is negative below the line y = *(double*)user. */
static int32_t below_line(int64_t n, int32_t dim, const double* x, double* values, void* user) {
  int64_t i;
  ck_assert_int_eq(dim, 2);
  for (i = 0; i < n; ++i) values[i] = x[2 * i + 1] - *(const double*)user;
  return 0;
}

/* Is negative south of the equator. */
static int32_t in_the_south(int64_t n, int32_t dim, const double* x, double* values, void* user) {
  int64_t i;
  (void)user;
  ck_assert_int_eq(dim, 3);
  for (i = 0; i < n; ++i) values[i] = x[3 * i + 2];
  return 0;
}

static int32_t failing(int64_t n, int32_t dim, const double* x, double* values, void* user) {
  (void)n, (void)dim, (void)x, (void)values, (void)user;
  return 4;
}

/* Returns the length of the segments with this tag. */
static double length_tagged(pnpbs_domain domain, int32_t tag) {
  int64_t n = 0, k;
  double *ends, sum = 0;
  int32_t* tags;
  MUST(pnpbs_domain_get_segments(domain, 0, &n, NULL, NULL));
  ends = malloc((size_t)n * 4 * sizeof *ends);
  tags = malloc((size_t)n * sizeof *tags);
  MUST(pnpbs_domain_get_segments(domain, n, &n, ends, tags));
  for (k = 0; k < n; ++k)
    if (tags[k] == tag)
      sum += hypot(ends[4 * k + 2] - ends[4 * k], ends[4 * k + 3] - ends[4 * k + 1]);
  free(ends);
  free(tags);
  return sum;
}

/* A square with an island, a breakwater, and a notch at the left side. Everything below
 * the line is selected, but only the outline gets the tag, in a curve as in a graph. */
START_TEST(outline_below_a_line) {
  enum { kVertices = 13, kSegments = 12 };
  const double xy[2 * kVertices] = {0,   0,   1,   0,   1,   0.5, 1,   1,   0,
                                    1,   0.2, 0.5, 0,   0.2, 0.4, 0.1, 0.6, 0.1,
                                    0.6, 0.3, 0.4, 0.3, 0.8, 0.1, 0.8, 0.2};
  const int64_t ends[2 * kSegments] = {0, 1, 1, 2, 2, 3, 3, 4,  4,  5, 5,  6,
                                       6, 0, 7, 8, 8, 9, 9, 10, 10, 7, 11, 12};
  const double hole[2] = {0.5, 0.15};
  const int32_t ones[7] = {1, 1, 1, 1, 1, 1, 1};
  double line = 0.4, length;
  int64_t count;
  int kind;
  for (kind = 0; kind < 2; ++kind) {
    job it = job_begin();
    result nodes;
    count = -1;
    if (kind == 0) {
      MUST(pnpbs_domain_add_pslg(it.domain, kVertices, xy, NULL, kSegments, ends, NULL, 0, NULL));
      MUST(pnpbs_domain_add_hole(it.domain, hole));
    } else {
      MUST(pnpbs_domain_add_polyline(it.domain, PNPBS_BOUNDARY, 1, 7, xy, ones, 0));
      MUST(pnpbs_domain_add_polyline(it.domain, PNPBS_BOUNDARY, 1, 4, xy + 14, NULL, 0));
      MUST(pnpbs_domain_add_polyline(it.domain, PNPBS_INNER, 0, 2, xy + 22, NULL, 0));
    }
    MUST_FAIL(PNPBS_ERROR_CALLBACK, pnpbs_domain_tag_outline(it.domain, failing, NULL, 5, &count),
              "4", "");
    MUST_FAIL(PNPBS_ERROR_ARGUMENT, pnpbs_domain_tag_outline(it.domain, NULL, NULL, 5, &count),
              "level_set", "");
    MUST_FAIL(PNPBS_ERROR_ARGUMENT,
              pnpbs_domain_tag_outline(it.domain, below_line, &line, 0, &count), "tag", "");
    ck_assert_int_eq(count, -1);
    MUST(pnpbs_domain_tag_outline(it.domain, below_line, &line, 5, &count));
    /* the bottom, half of the right side, and two segments of the notch */
    ck_assert_int_eq(count, 4);
    length = 1 + 0.5 + hypot(0.2, 0.3) + 0.2;
    ck_assert_double_eq_tol(length_tagged(it.domain, 5), length, 1e-14);
    run(&it, 0.1);
    nodes = result_of(it.placement);
    check_result(&nodes, 0);
    check_corner(&nodes, 1, 0.5, 5);
    ck_assert_int_gt(edges_tagged(&nodes, 5, &length), 15);
    ck_assert_double_eq_tol(length, 1.7 + hypot(0.2, 0.3), 1e-12);
    result_free(&nodes);
    job_end(&it);
  }
}
END_TEST

/* Arcs get the tag as wholes. */
START_TEST(outline_of_arcs) {
  const double centre[2] = {0, 0};
  double line = 0, measure = 0;
  int64_t count = -1;
  job it = job_begin();
  MUST(pnpbs_domain_add_arc(it.domain, PNPBS_BOUNDARY, centre, 1, 0, PI, 1));
  MUST(pnpbs_domain_add_arc(it.domain, PNPBS_BOUNDARY, centre, 1, PI, 2 * PI, 2));
  MUST(pnpbs_domain_add_arc(it.domain, PNPBS_BOUNDARY, centre, 0.5, 0, 2 * PI, 3));
  MUST(pnpbs_domain_tag_outline(it.domain, below_line, &line, 7, &count));
  ck_assert_int_eq(count, 1);
  ck_assert_double_eq_tol(length_tagged(it.domain, 7), PI, 1e-3);
  ck_assert_double_eq_tol(length_tagged(it.domain, 1), PI, 1e-3);
  ck_assert_double_eq_tol(length_tagged(it.domain, 3), PI, 1e-3);
  ck_assert(length_tagged(it.domain, 2) == 0);
  MUST(pnpbs_domain_measure(it.domain, &measure));
  job_end(&it);
}
END_TEST

/* A sea from 30 degrees north to 30 degrees south. */
START_TEST(outline_on_a_sphere) {
  const double degrees[8] = {0, -30, 40, -30, 40, 30, 0, 30}, outside[3] = {0, 0, -1};
  double xyz[12];
  int64_t count = -1;
  job it = job_begin();
  pnpbs_domain sea = NULL, box = NULL;
  MUST(pnpbs_domain_create_sphere(it.context, 2, outside, &sea));
  MUST(pnpbs_sphere_points(2, 4, degrees, xyz));
  MUST(pnpbs_domain_add_polyline(sea, PNPBS_BOUNDARY, 1, 4, xyz, NULL, 0));
  MUST(pnpbs_domain_tag_outline(sea, in_the_south, NULL, 9, &count));
  ck_assert_int_gt(count, 0);
  MUST(pnpbs_domain_tag_outline(sea, in_the_south, NULL, 1, &count));
  MUST(pnpbs_domain_create(it.context, 3, &box));
  MUST_FAIL(PNPBS_ERROR_ARGUMENT, pnpbs_domain_tag_outline(box, in_the_south, NULL, 9, &count),
            "three dimensions", "");
  MUST(pnpbs_domain_destroy(&box));
  MUST(pnpbs_domain_destroy(&sea));
  job_end(&it);
}
END_TEST

static job lake_job(void) {
  job it = job_begin();
  MUST(pnpbs_domain_read_poly(it.domain, PNPBS_SOURCE_DIR "/examples/data/lake_victoria.poly"));
  return it;
}

static int shortest_over_d(const result* nodes) {
  int64_t e;
  int below = 0;
  for (e = 0; e < nodes->edges; ++e)
    below += edge_length(nodes, e) < 0.5 * nodes->d[nodes->ends[2 * e]];
  return below;
}

static int32_t asking(int64_t n, int32_t dim, const double* xyz, double* d, void* user) {
  const job* it = user;
  int64_t i;
  ck_assert_int_eq(dim, 2);
  MUST(pnpbs_domain_distance(it->domain, 0, n, xyz, d));
  MUST_FAIL(PNPBS_ERROR_STATE, pnpbs_domain_add_hole(it->domain, xyz), "callback", "");
  for (i = 0; i < n; ++i) d[i] = 40 + 0.1 * d[i];
  return 0;
}

static int32_t refusing(int64_t n, int32_t dim, const double* xyz, double* d, void* user) {
  (void)n, (void)dim, (void)xyz, (void)d, (void)user;
  return 3;
}

START_TEST(a_shore_finer_than_d) {
  const double origin[2] = {0, 0};
  double distance, area = 0, simpler = 0;
  int64_t vertices = -1, curves = -1;
  int below;
  job it = lake_job();
  result nodes;
  MUST(pnpbs_domain_measure(it.domain, &area));
  run(&it, 40);
  nodes = result_of(it.placement);
  below = shortest_over_d(&nodes);
  result_free(&nodes);
  job_end(&it);

  it = lake_job();
  MUST(pnpbs_domain_distance(it.domain, 0, 1, origin, &distance));
  MUST_FAIL(PNPBS_ERROR_CALLBACK,
            pnpbs_domain_simplify(it.domain, refusing, NULL, 0.25, 0, NULL, NULL), "3", "");
  MUST_FAIL(PNPBS_ERROR_ARGUMENT, pnpbs_domain_simplify(it.domain, NULL, NULL, 0.25, 0, NULL, NULL),
            "spacing", "");
  MUST_FAIL(PNPBS_ERROR_ARGUMENT,
            pnpbs_domain_simplify(it.domain, asking, &it, -0.25, 0, NULL, NULL), "tolerance", "");
  MUST(pnpbs_domain_simplify(it.domain, asking, &it, 0.25, 2, &vertices, &curves));
  ck_assert_int_gt(vertices, 20);
  ck_assert_int_eq(curves, 0);
  MUST(pnpbs_domain_set_corner_angle(it.domain, 45));
  MUST(pnpbs_domain_measure(it.domain, &simpler));
  ck_assert_double_eq_tol(simpler / area, 1, 0.02);
  run(&it, 40);
  nodes = result_of(it.placement);
  check_result(&nodes, 1);
  ck_assert_int_lt(shortest_over_d(&nodes), below / 2);
  result_free(&nodes);
  job_end(&it);
}
END_TEST

/* Ends of curves and fixed nodes are moved onto the boundary over the distance that was set. */
START_TEST(loose_points) {
  const double square[8] = {0, 0, 1, 0, 1, 1, 0, 1}, crack[4] = {0.5, 0.5, 0.5, 0.01},
               fixed[2] = {0.99, 0.99};
  const double lengths[] = {0, 1e-3, 0.02};
  int k;
  for (k = 0; k < 3; ++k) {
    int32_t code = 0, count = 0, w;
    int64_t moved = 0;
    double value = 0, point[3];
    job it = job_begin();
    MUST_FAIL(PNPBS_ERROR_ARGUMENT, pnpbs_domain_set_snap(it.domain, -1), "length", "-1");
    MUST(pnpbs_domain_set_snap(it.domain, lengths[k]));
    MUST(pnpbs_domain_add_polyline(it.domain, PNPBS_BOUNDARY, 1, 4, square, NULL, 0));
    MUST(pnpbs_domain_add_polyline(it.domain, PNPBS_INNER, 0, 2, crack, NULL, 0));
    MUST(pnpbs_domain_add_fixed_nodes(it.domain, 1, fixed, NULL));
    run(&it, 0.1);
    MUST(pnpbs_placement_warning_count(it.placement, &count));
    for (w = 0; w < count && code != PNPBS_WARNING_VERTICES_MERGED; ++w)
      MUST(pnpbs_placement_get_warning_data(it.placement, w, &code, &moved, &value, point));
    ck_assert_int_eq(code == PNPBS_WARNING_VERTICES_MERGED, k == 2);
    if (k == 2) {
      result nodes = result_of(it.placement);
      check_result(&nodes, 1);
      result_free(&nodes);
      ck_assert_int_eq(moved, 2);
      ck_assert_double_eq(value, lengths[k]);
    }
    job_end(&it);
  }
}
END_TEST

/* Between corners, nodes on a graph are spaced by d, however fine the graph is. */
START_TEST(a_graph_that_is_a_circle) {
  double xy[2 * 720];
  int64_t ends[2 * 720];
  double length;
  int i, edges;
  job it = job_begin();
  result nodes;
  for (i = 0; i < 720; ++i) {
    xy[2 * i] = cos(2 * PI * i / 720);
    xy[2 * i + 1] = sin(2 * PI * i / 720);
    ends[2 * i] = i;
    ends[2 * i + 1] = (i + 1) % 720;
  }
  MUST_FAIL(PNPBS_ERROR_ARGUMENT, pnpbs_domain_set_corner_angle(it.domain, -1), "corner_angle", "");
  MUST(pnpbs_domain_set_corner_angle(it.domain, 30));
  MUST(pnpbs_domain_add_pslg(it.domain, 720, xy, NULL, 720, ends, NULL, 0, NULL));
  run(&it, 0.1);
  nodes = result_of(it.placement);
  check_result(&nodes, 1);
  edges = edges_tagged(&nodes, 1, &length);
  ck_assert_int_ge(edges, 61);
  ck_assert_int_le(edges, 65);
  ck_assert_double_eq_tol(length, 2 * PI, 0.01);
  result_free(&nodes);
  job_end(&it);
}
END_TEST

/* ---------------------------------------------------------------- the first row --------- */

/* Returns the quality around a hole from which d grows. There, rows of bubbles slip against the
 * boundary. */
static quality_summary quality_around_a_hole(const char* first_row, const char* sweeps,
                                             hash_text* hash) {
  static cone growing = {-0.02, 0.15, 0.5, 0.5};
  quality_summary quality;
  result nodes;
  job it = job_begin();
  add_circle(it.domain, PNPBS_BOUNDARY, 0.5, 0.5, 0.5, 1);
  add_circle(it.domain, PNPBS_BOUNDARY, 0.5, 0.5, 0.2, 2);
  job_place(&it);
  MUST(pnpbs_placement_set_spacing_callback(it.placement, cone_spacing, &growing));
  if (first_row) MUST(pnpbs_placement_set(it.placement, "first_row", first_row));
  if (sweeps) MUST(pnpbs_placement_set(it.placement, "sweeps", sweeps));
  MUST_COMPUTE(pnpbs_placement_run(it.placement));
  nodes = result_of(it.placement);
  check_result(&nodes, 0);
  quality = quality_of(&nodes);
  *hash = hash_of(it.placement);
  result_free(&nodes);
  job_end(&it);
  return quality;
}

START_TEST(the_first_row_fits) {
  hash_text hash;
  const quality_summary with = quality_around_a_hole(NULL, NULL, &hash),
                        without = quality_around_a_hole("0", NULL, &hash);
  ck_assert_msg(with.least > 0.85 && without.least < 0.83, "least quality %.3f, without it %.3f",
                with.least, without.least);
  ck_assert_msg(with.below_95 < 0.85 * without.below_95,
                "below 0.95 are %.5f of the triangles, without it %.5f", with.below_95,
                without.below_95);
}
END_TEST

START_TEST(no_first_row_without_sweeps) {
  hash_text with, without;
  quality_around_a_hole("1", "0", &with);
  quality_around_a_hole("0", "0", &without);
  ck_assert_str_eq(with.text, without.text);
}
END_TEST

TEST_SUITE(test_boundary) {
  Suite* suite = suite_create("boundary");
  TCase* cases = tcase_create("boundary");
  tcase_add_test(cases, corners_and_tags_of_a_polyline);
  tcase_add_test(cases, a_polyline_that_is_a_circle);
  tcase_add_test(cases, tags_of_a_graph);
  tcase_add_test(cases, arcs_are_followed_exactly);
  tcase_add_test(cases, arcs_that_join_segments);
  tcase_add_test(cases, a_curve_by_callback);
  tcase_add_test(cases, equal_steps_on_a_curve);
  tcase_add_test(cases, an_open_inner_curve);
  tcase_add_test(cases, a_smooth_inner_curve);
  tcase_add_test(cases, a_closed_inner_curve);
  tcase_add_test(cases, inner_curves_that_meet);
  tcase_add_test(cases, fixed_nodes_appear_exactly);
  tcase_add_test(cases, fixed_nodes_that_do_not_fit);
  tcase_add_test(cases, disjoint_pieces);
  tcase_add_test(cases, nested_holes_and_islands);
  tcase_add_test(cases, holes_by_points);
  tcase_add_test(cases, a_graph_by_text);
  tcase_add_test(cases, segments_show_the_domain);
  tcase_add_test(cases, a_lake);
  tcase_add_test(cases, outline_below_a_line);
  tcase_add_test(cases, outline_of_arcs);
  tcase_add_test(cases, outline_on_a_sphere);
  tcase_add_test(cases, a_shore_finer_than_d);
  tcase_add_test(cases, loose_points);
  tcase_add_test(cases, a_graph_that_is_a_circle);
  tcase_add_test(cases, the_first_row_fits);
  tcase_add_test(cases, no_first_row_without_sweeps);
  suite_add_tcase(suite, cases);
  return run_suite(suite);
}
