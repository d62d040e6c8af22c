/* SPDX-License-Identifier: BSD-3-Clause
 *
 * Tests spacings on spheres from grids, meshes and points over ranks: nodes equal those of one
 * process, warnings have the same words, and different input on ranks is an error. */
#include <math.h>
#include <stdlib.h>

#include "rank_program.h"

static const double R = 6371.22;
enum kind { GRID, MESH, POINTS, PART_OF_GRID, PART_OF_MESH, KINDS };

struct field {
  int64_t n, triangles, *corners;
  double *x, *d;
};

/* Returns a placement in a sea around the pole or on the whole sphere, both within the region of d.
 */
static pnpbs_placement placement_on_sphere(int whole) {
  const double from[2] = {20, whole ? -30 : 90};
  double outside[3];
  pnpbs_domain domain;
  pnpbs_placement placement;
  pnpbs_sphere_points(1, 1, from, outside);
  expect(pnpbs_domain_create_sphere(context, R, outside, &domain) == PNPBS_OK, "domain");
  if (!whole) {
    double degrees[2 * 60], coast[3 * 60];
    int k;
    for (k = 0; k < 60; ++k) degrees[2 * k] = 6 * k, degrees[2 * k + 1] = 40;
    pnpbs_sphere_points(R, 60, degrees, coast);
    expect(pnpbs_domain_add_polyline(domain, PNPBS_BOUNDARY, 1, 60, coast, NULL, 30) == PNPBS_OK,
           "coast");
  }
  expect(pnpbs_placement_create(context, domain, &placement) == PNPBS_OK, "placement");
  pnpbs_domain_destroy(&domain);
  return placement;
}

/* Returns the triangles of a whole sphere, placed by one process, with d by longitude. */
static struct field globe(void) {
  struct field f = {0};
  pnpbs_context all = context;
  pnpbs_placement placement;
  int64_t i;
  expect(pnpbs_context_create_serial(&context) == PNPBS_OK, "serial context");
  placement = placement_on_sphere(1);
  pnpbs_placement_set_spacing_constant(placement, 1200);
  expect(pnpbs_placement_run(placement) >= 0, "globe");
  pnpbs_placement_count(placement, &f.n);
  pnpbs_placement_get_triangles(placement, 0, &f.triangles, NULL);
  f.x = malloc((size_t)f.n * 3 * sizeof *f.x);
  f.d = malloc((size_t)f.n * sizeof *f.d);
  f.corners = malloc((size_t)f.triangles * 3 * sizeof *f.corners);
  pnpbs_placement_get_nodes(placement, f.n, f.x, NULL, NULL, f.d);
  pnpbs_placement_get_triangles(placement, f.triangles, &f.triangles, f.corners);
  for (i = 0; i < f.n; ++i) f.d[i] = 450 + 150 * f.x[3 * i + 1] / R;
  pnpbs_placement_destroy(&placement);
  pnpbs_context_destroy(&context);
  context = all;
  return f;
}

static pnpbs_status give(pnpbs_placement placement, const struct field* f, int kind) {
  const int64_t size[2] = {12, kind == GRID ? 6 : 3};
  const double origin[2] = {-180, -75}, step[2] = {30, 30};
  double values[72];
  int i;
  for (i = 0; i < 72; ++i) values[i] = f->d[0] + 30 * (i % 12 < 6 ? i % 12 : 12 - i % 12);
  switch (kind) {
    case GRID:
    case PART_OF_GRID:
      return pnpbs_placement_set_spacing_grid(placement, size, origin, step, values);
    case MESH:
    case PART_OF_MESH:
      return pnpbs_placement_set_spacing_mesh(placement, f->n, f->x, f->d,
                                              f->triangles / (kind == MESH ? 1 : 2), f->corners);
    default:
      return pnpbs_placement_set_spacing_points(placement, f->n, f->x, f->d);
  }
}

/* Writes the hash of the nodes, and the warning about regions that are not covered. */
static void place(const struct field* f, int kind, int whole, char told[600]) {
  pnpbs_placement placement = placement_on_sphere(whole);
  const char* text = "";
  int32_t count = 0, k;
  pnpbs_placement_set_int64(placement, "steps", 30);
  expect(give(placement, f, kind) == PNPBS_OK, "spacing");
  expect(pnpbs_placement_run(placement) >= 0, "run");
  expect(pnpbs_placement_get_string(placement, "hash", &text) == PNPBS_OK, "hash");
  snprintf(told, 600, "%s", text);
  pnpbs_placement_warning_count(placement, &count);
  for (k = 0; k < count; ++k) {
    expect(pnpbs_placement_get_warning(placement, k, &text) == PNPBS_OK, "warning");
    if (strstr(text, "covers only")) snprintf(told + strlen(told), 600 - strlen(told), " %s", text);
  }
  pnpbs_placement_destroy(&placement);
}

static void check_same_nodes(const struct field* f, int kind, int whole) {
  char together[600], alone[600];
  pnpbs_context all = context;
  place(f, kind, whole, together);
  expect(pnpbs_context_create_serial(&context) == PNPBS_OK, "serial context");
  if (rank == 0) {
    place(f, kind, whole, alone);
    expect(strcmp(together, alone) == 0, "other nodes or warnings than one process has");
    expect((strstr(alone, "covers only") != NULL) == (kind >= PART_OF_GRID), "warning of a part");
  }
  pnpbs_context_destroy(&context);
  context = all;
}

static void check_ranks_that_differ(struct field* f, int kind) {
  pnpbs_placement placement = placement_on_sphere(1);
  const double kept = f->d[3];
  if (size > 1) {
    if (rank == size - 1) f->d[3] *= 1.5;
    expect(give(placement, f, kind) == PNPBS_ERROR_ARGUMENT, "ranks that differ");
    expect(strstr(pnpbs_last_error(context), "all ranks") != NULL, "are told so");
  }
  f->d[3] = rank == size - 1 ? -1 : kept;
  expect(give(placement, f, kind) == PNPBS_ERROR_SPACING, "one rank's bad value");
  expect(strstr(pnpbs_last_error(context), "d[3]") != NULL, "is named");
  f->d[3] = kept;
  pnpbs_placement_destroy(&placement);
}

static void check_all(void) {
  struct field f;
  int kind;
  f = globe();
  for (kind = 0; kind < KINDS; ++kind) check_same_nodes(&f, kind, 1);
  for (kind = 0; kind < PART_OF_GRID; ++kind) check_same_nodes(&f, kind, 0);
  check_ranks_that_differ(&f, MESH);
  check_ranks_that_differ(&f, POINTS);
  free(f.x);
  free(f.d);
  free(f.corners);
}

int main(int argc, char** argv) { return run_in_groups(argc, argv, check_all); }
