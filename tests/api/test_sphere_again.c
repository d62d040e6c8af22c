/* SPDX-License-Identifier: BSD-3-Clause
 *
 * Tests repeated runs on a whole sphere: the nodes of the closing patch around the centre of
 * projection do not move in steps, and the nodes come to rest.
 */
#include "api_support.h"

static const double R = 6371.22;
static const double point_degrees[2] = {20, -30};

static job globe_job(double d) {
  job it = {0};
  double point[3];
  MUST(pnpbs_context_create_serial(&it.context));
  MUST(pnpbs_sphere_points(1, 1, point_degrees, point));
  MUST(pnpbs_domain_create_sphere(it.context, R, point, &it.domain));
  job_place(&it);
  MUST(pnpbs_placement_set_spacing_constant(it.placement, d));
  return it;
}

/* Nodes by id, with their distances from the centre of projection along the sphere. */
typedef struct {
  int64_t n;
  double *x, *away;
} nodes_by_id;

static nodes_by_id nodes_of(pnpbs_placement placement, int64_t ids_end) {
  nodes_by_id nodes = {ids_end, calloc((size_t)ids_end * 3, sizeof(double)),
                       malloc((size_t)ids_end * sizeof(double))};
  double point[3], *x;
  int64_t n, i, *ids;
  int k;
  MUST(pnpbs_sphere_points(1, 1, point_degrees, point));
  MUST(pnpbs_placement_count(placement, &n));
  x = malloc((size_t)n * 3 * sizeof *x);
  ids = malloc((size_t)n * sizeof *ids);
  ck_assert(nodes.x && nodes.away && x && ids);
  MUST(pnpbs_placement_get_nodes(placement, n, x, ids, NULL, NULL));
  for (i = 0; i < ids_end; ++i) nodes.away[i] = INFINITY;
  for (i = 0; i < n; ++i) {
    double cosine = 0;
    if (ids[i] >= ids_end) continue;
    for (k = 0; k < 3; ++k) {
      nodes.x[3 * ids[i] + k] = x[3 * i + k];
      cosine += x[3 * i + k] * point[k] / R;
    }
    nodes.away[ids[i]] = R * acos(fmin(1, cosine));
  }
  free(x);
  free(ids);
  return nodes;
}

static void nodes_free(nodes_by_id* nodes) {
  free(nodes->x);
  free(nodes->away);
}

/* The closing patch of some 500 nodes reaches up to 12 d. The last finish has moved those beyond 6
 * d. */
START_TEST(steps_move_none_of_those_laid_first) {
  const double d = 300;
  job it = globe_job(d);
  nodes_by_id before, after;
  int64_t ids_end = 1 << 16, i, edges, near = 0, far_moved = 0;
  MUST(pnpbs_placement_run(it.placement));
  before = nodes_of(it.placement, ids_end);
  MUST_COMPUTE(pnpbs_placement_step(it.placement, 40));
  MUST(pnpbs_placement_check(it.placement));
  MUST(pnpbs_placement_get_boundary_edges(it.placement, 0, &edges, NULL, NULL));
  ck_assert_int_eq(edges, 0);
  after = nodes_of(it.placement, ids_end);
  for (i = 0; i < ids_end; ++i) {
    const int stays = memcmp(before.x + 3 * i, after.x + 3 * i, 3 * sizeof(double)) == 0;
    if (before.away[i] < 11.9 * d) {
      ck_assert_msg(stays, "node %lld, %g d away, moved", (long long)i, before.away[i] / d);
      ++near;
    }
    if (before.away[i] > 12.5 * d) far_moved += !stays;
  }
  ck_assert_int_gt(near, 450);
  ck_assert_int_gt(far_moved, 3000);
  MUST(pnpbs_placement_run(it.placement));
  MUST(pnpbs_placement_check(it.placement));
  nodes_free(&before);
  nodes_free(&after);
  job_end(&it);
}
END_TEST

/* The first further run settles the population. If bubbles drifted to the centre of projection,
 * each run would delete some of them there. */
START_TEST(runs_again_delete_hardly_any) {
  job it = globe_job(300);
  int64_t before, after;
  int k;
  MUST(pnpbs_placement_run(it.placement));
  MUST(pnpbs_placement_run(it.placement));
  before = integer_of(it.placement, "deleted");
  for (k = 0; k < 8; ++k) MUST(pnpbs_placement_run(it.placement));
  after = integer_of(it.placement, "deleted");
  ck_assert_int_le(after - before, 18);
  MUST(pnpbs_placement_check(it.placement));
  ck_assert_double_gt(real_of(it.placement, "quality.min"), 0.85);
  job_end(&it);
}
END_TEST

TEST_SUITE(test_sphere_again) {
  Suite* suite = suite_create("sphere_again");
  TCase* tests = tcase_create("sphere_again");
  tcase_add_test(tests, steps_move_none_of_those_laid_first);
  tcase_add_test(tests, runs_again_delete_hardly_any);
  suite_add_tcase(suite, tests);
  return run_suite(suite);
}
