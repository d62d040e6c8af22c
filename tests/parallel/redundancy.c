/* SPDX-License-Identifier: BSD-3-Clause
 *
 * Tests how much work ranks do redundantly for nodes of other ranks: none on one rank, none for the
 * stars of bodies, and little if ghosts are updated in each step or the parts have short borders,
 * also on whole spheres. The nodes do not depend on this work. */
#include <math.h>
#include <string.h>

#include "rank_program.h"

static double real(pnpbs_placement placement, const char* name) {
  double value = 0;
  expect(pnpbs_placement_get_double(placement, name, &value) == PNPBS_OK, name);
  return value;
}

static pnpbs_placement placed(int32_t dim, const char* interval) {
  static double finest[] = {0.02, 0.08}; /* static, since later steps use it as well */
  pnpbs_domain domain = unit_domain(dim);
  pnpbs_placement placement;
  expect(pnpbs_placement_create(context, domain, &placement) == PNPBS_OK, "placement");
  expect(pnpbs_placement_set(placement, "exchange_interval", interval) == PNPBS_OK, "interval");
  pnpbs_placement_set_spacing_callback(placement, growing_spacing, &finest[dim - 2]);
  expect(pnpbs_placement_run(placement) >= 0, "run");
  pnpbs_domain_destroy(&domain);
  return placement;
}

static void check_on_ranks(int32_t dim) {
  pnpbs_placement often = placed(dim, "1"), seldom = placed(dim, "4");
  const char* names[] = {"redundancy.lists", "redundancy.motion", "redundancy.stars",
                         "redundancy.sweeps"};
  char hash[32], other[32];
  int k;
  for (k = 0; k < 4; ++k) {
    if (dim == 3 && strcmp(names[k], "redundancy.stars") == 0)
      expect(real(seldom, names[k]) == 1, "the owners send the stars of ghosts");
    else
      expect(real(seldom, names[k]) > 1.001, "ghosts are worked for");
    expect(real(seldom, names[k]) <= size, "a rank holds no node twice");
  }
  expect(real(often, "redundancy.motion") == 1, "ghosts that follow each step take part in none");
  expect(real(often, "redundancy.lists") - 1 < 0.25 * (real(seldom, "redundancy.lists") - 1),
         "few of them have lists");
  hash_of_nodes(often, hash);
  hash_of_nodes(seldom, other);
  expect(strcmp(hash, other) == 0, "the nodes do not depend on the interval");
  pnpbs_placement_destroy(&often);
  pnpbs_placement_destroy(&seldom);
}

/* Checks a change of the exchange interval: lists that an interval of 1 builds for owned nodes only
 * are not sufficient for a longer interval. */
static void check_change_of_interval(void) {
  pnpbs_placement changed = placed(3, "1"), same = placed(3, "1");
  char hash[32], other[32];
  expect(pnpbs_placement_step(changed, 3) >= 0, "steps");
  expect(pnpbs_placement_set(changed, "exchange_interval", "5") == PNPBS_OK, "interval");
  expect(pnpbs_placement_step(changed, 27) >= 0, "steps with another interval");
  expect(pnpbs_placement_step(same, 30) >= 0, "steps");
  hash_of_nodes(changed, hash);
  hash_of_nodes(same, other);
  expect(strcmp(hash, other) == 0, "the nodes do not depend on a change of the interval");
  pnpbs_placement_destroy(&changed);
  pnpbs_placement_destroy(&same);
}

/* A spacing that is finer towards a corner: parts with equal work in the volume have unequal work
 * on the surface. */
static int32_t spacing_from_corner(int64_t n, int32_t dim, const double* x, double* d, void* none) {
  int64_t i;
  (void)none;
  for (i = 0; i < n; ++i) {
    double square = 0;
    int k;
    for (k = 0; k < dim; ++k) square += x[dim * i + k] * x[dim * i + k];
    d[i] = 0.012 + 0.06 * sqrt(square);
  }
  return 0;
}

/* Checks that two parts have the shortest border, and so fewer ghosts than parts with a jagged
 * border. */
static void check_borders_of_two_parts(void) {
  pnpbs_domain domain = unit_domain(3);
  pnpbs_placement placement;
  expect(pnpbs_placement_create(context, domain, &placement) == PNPBS_OK, "placement");
  pnpbs_placement_set_spacing_callback(placement, spacing_from_corner, NULL);
  expect(pnpbs_placement_run(placement) >= 0, "run");
  expect(real(placement, "redundancy.lists") < 1.055, "the border between two parts is short");
  pnpbs_placement_destroy(&placement);
  pnpbs_domain_destroy(&domain);
}

static pnpbs_placement placed_on_whole_sphere(void) {
  const double degrees[] = {20, -30};
  double point[3];
  pnpbs_domain domain;
  pnpbs_placement placement;
  expect(pnpbs_sphere_points(1, 1, degrees, point) == PNPBS_OK, "point");
  expect(pnpbs_domain_create_sphere(context, 6371.22, point, &domain) == PNPBS_OK, "sphere");
  expect(pnpbs_placement_create(context, domain, &placement) == PNPBS_OK, "placement");
  pnpbs_placement_set_spacing_constant(placement, 127.42);
  expect(pnpbs_placement_run(placement) >= 0, "run");
  pnpbs_domain_destroy(&domain);
  return placement;
}

enum { TIMES = 3 };

/* Writes the hashes after the run, after steps without a finish, and after a further run. */
static void hash_each_time(pnpbs_placement placement, char hash[TIMES][32]) {
  hash_of_nodes(placement, hash[0]);
  expect(pnpbs_placement_step(placement, 30) >= 0, "steps after a run");
  hash_of_nodes(placement, hash[1]);
  expect(pnpbs_placement_run(placement) >= 0, "a further run");
  expect(pnpbs_placement_check(placement) == PNPBS_OK, "check after a further run");
  hash_of_nodes(placement, hash[2]);
}

/* Checks a whole sphere. In its chart, points near the centre of projection are as far away as all
 * other points. Still the rank that owns this region must not request more nodes than others, and
 * lists must contain the nodes that are near along the sphere, whenever they are built. */
static void check_whole_sphere(pnpbs_context serial) {
  pnpbs_placement placement = placed_on_whole_sphere(), alone;
  const pnpbs_context all = context;
  char hash[TIMES][32], other[TIMES][32];
  int k;
  expect(real(placement, "redundancy.stars") < (size == 2 ? 1.5 : 2.2), "stars of a sphere");
  expect(pnpbs_placement_check(placement) == PNPBS_OK, "check of a sphere");
  hash_each_time(placement, hash);
  pnpbs_placement_destroy(&placement);
  if (rank > 0) return;
  context = serial;
  alone = placed_on_whole_sphere();
  hash_each_time(alone, other);
  for (k = 0; k < TIMES; ++k)
    expect(strcmp(hash[k], other[k]) == 0, "the nodes of a sphere are those of one rank");
  pnpbs_placement_destroy(&alone);
  context = all;
}

static void check_on_one_rank(int32_t dim) {
  pnpbs_placement alone = placed(dim, "4");
  expect(real(alone, "redundancy.lists") == 1, "lists");
  expect(real(alone, "redundancy.motion") == 1, "motion");
  expect(real(alone, "redundancy.stars") == 1, "stars");
  expect(real(alone, "redundancy.sweeps") == 1, "sweeps");
  pnpbs_placement_destroy(&alone);
}

static void check_all(void) {
  pnpbs_context all, serial;
  check_on_ranks(2);
  check_on_ranks(3);
  check_change_of_interval();
  if (size == 2) check_borders_of_two_parts();
  all = context;
  expect(pnpbs_context_create_serial(&context) == PNPBS_OK, "serial context");
  if (rank == 0) check_on_one_rank(2), check_on_one_rank(3);
  serial = context;
  context = all;
  check_whole_sphere(serial);
  pnpbs_context_destroy(&serial);
}

int main(int argc, char** argv) { return run_in_groups(argc, argv, check_all); }
