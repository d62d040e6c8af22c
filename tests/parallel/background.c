/* SPDX-License-Identifier: BSD-3-Clause
 *
 * Tests a spacing from a background mesh and from scattered points over ranks: nodes equal those of
 * one process, d equals the given values, and different input on ranks is an error. */
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "rank_program.h"

enum { N = 5, MAX_POINTS = N * N * N, MAX_ELEMENTS = 6 * (N - 1) * (N - 1) * (N - 1) };

/* ---------------------------------------------------------------- input ------------------ */

struct field {
  int64_t n, elements, corners[4 * MAX_ELEMENTS];
  double x[3 * MAX_POINTS], d[MAX_POINTS];
};

/* Fills a lattice slightly larger than the unit cube or square, cut along the diagonals of its
 * cells. */
static void fill(struct field* f, int dim) {
  static const int ways[6][3] = {{0, 1, 2}, {1, 0, 2}, {0, 2, 1}, {1, 2, 0}, {2, 0, 1}, {2, 1, 0}};
  const int layers = dim == 3 ? N : 1, step[3] = {1, N, N * N};
  int i, j, k, w, c;
  f->n = f->elements = 0;
  for (k = 0; k < layers; ++k)
    for (j = 0; j < N; ++j)
      for (i = 0; i < N; ++i) {
        const int at[3] = {i, j, k};
        double* x = f->x + dim * f->n;
        for (c = 0; c < dim; ++c) x[c] = -0.0625 + 1.125 * at[c] / (N - 1);
        f->d[f->n] = (dim == 3 ? 0.18 : 0.05) * (1 + (i == j ? 1 : 0.3 * i));
        ++f->n;
      }
  for (k = 0; k < (dim == 3 ? N - 1 : 1); ++k)
    for (j = 0; j < N - 1; ++j)
      for (i = 0; i < N - 1; ++i)
        for (w = 0; w < (dim == 3 ? 6 : 2); ++w) {
          int64_t* corners = f->corners + (dim + 1) * f->elements++;
          corners[0] = i + step[1] * j + step[2] * k;
          for (c = 0; c < dim; ++c) corners[c + 1] = corners[c] + step[ways[w][c]];
        }
}

static pnpbs_placement placement_in_cube(int dim) {
  const double square[] = {0, 0, 1, 0, 1, 1, 0, 1}, low[] = {0, 0, 0}, high[] = {1, 1, 1};
  pnpbs_domain domain;
  pnpbs_placement placement;
  expect(pnpbs_domain_create(context, dim, &domain) == PNPBS_OK, "domain");
  if (dim == 2) pnpbs_domain_add_polyline(domain, PNPBS_BOUNDARY, 1, 4, square, NULL, 0);
  if (dim == 3) pnpbs_domain_add_box(domain, low, high, 1);
  expect(pnpbs_placement_create(context, domain, &placement) == PNPBS_OK, "placement");
  pnpbs_placement_set_int64(placement, "steps", 15);
  pnpbs_domain_destroy(&domain);
  return placement;
}

static pnpbs_status give(pnpbs_placement placement, const struct field* f, int as_mesh) {
  return as_mesh ? pnpbs_placement_set_spacing_mesh(placement, f->n, f->x, f->d, f->elements,
                                                    f->corners)
                 : pnpbs_placement_set_spacing_points(placement, f->n, f->x, f->d);
}

/* ---------------------------------------------------------------- checks ----------------- */

static void place(const struct field* f, int dim, int as_mesh, char hash[80]) {
  pnpbs_placement placement = placement_in_cube(dim);
  struct field copy = *f;
  const char* text = "";
  expect(give(placement, &copy, as_mesh) == PNPBS_OK, "spacing");
  memset(&copy, 0, sizeof copy); /* the library has copied it */
  expect(pnpbs_placement_run(placement) >= 0, "run");
  expect(pnpbs_placement_get_string(placement, "hash", &text) == PNPBS_OK, "hash");
  snprintf(hash, 80, "%s", text);
  pnpbs_placement_destroy(&placement);
}

static void check_same_nodes(int dim, int as_mesh) {
  static struct field f;
  char together[80], alone[80];
  pnpbs_context all = context;
  fill(&f, dim);
  place(&f, dim, as_mesh, together);
  expect(pnpbs_context_create_serial(&context) == PNPBS_OK, "serial context");
  if (rank == 0) {
    place(&f, dim, as_mesh, alone);
    expect(strcmp(together, alone) == 0, "other nodes than one process has");
  }
  pnpbs_context_destroy(&context);
  context = all;
}

/* Finds the warning about a mesh that does not cover the domain; "" if there is none. */
static void find_warning(pnpbs_placement placement, char warning[600]) {
  const char* text = "";
  int32_t count = 0, k;
  warning[0] = 0;
  expect(pnpbs_placement_warning_count(placement, &count) == PNPBS_OK, "number of warnings");
  for (k = 0; k < count; ++k) {
    expect(pnpbs_placement_get_warning(placement, k, &text) == PNPBS_OK, "warning");
    if (strstr(text, "covers only a part")) snprintf(warning, 600, "%s", text);
  }
}

/* Finds the warning for a field whose points are scaled by `factor`. */
static void warning_of(int dim, int as_mesh, double factor, char warning[600]) {
  static struct field f;
  pnpbs_placement placement = placement_in_cube(dim);
  int64_t i;
  fill(&f, dim);
  for (i = 0; i < dim * f.n; ++i) f.x[i] *= factor;
  expect(give(placement, &f, as_mesh) == PNPBS_OK, "spacing");
  expect(pnpbs_placement_initialise(placement) >= 0, "first nodes");
  find_warning(placement, warning);
  pnpbs_placement_destroy(&placement);
}

/* Checks that a mesh of half a cube gives the same warning on any number of ranks, and that a mesh
 * of a slightly smaller cube gives none. */
static void check_meshes_of_a_part(int dim) {
  char together[600], alone[600], none[600];
  long all = 0, beyond = 0;
  pnpbs_context ranks = context;
  warning_of(dim, 1, 0.5, together);
  expect(sscanf(together,
                "the background mesh of the spacing covers only a part of the domain: of "
                "%ld nodes, %ld are farther than d from it, one of them at (",
                &all, &beyond) == 2,
         "warning of half a cube");
  expect(beyond > 0.3 * all && beyond < 0.9 * all, "as many nodes as lie beyond");
  warning_of(dim, 1, 0.93, none);
  expect(none[0] == 0, "a warning about less than d");
  warning_of(dim, 0, 0.5, none);
  expect(strncmp(none, "the cloud of points of the spacing covers only a part", 53) == 0,
         "warning of points in half a cube");
  warning_of(dim, 0, 0.93, none);
  expect(none[0] == 0, "a warning about points that are less than d from the edge");
  expect(pnpbs_context_create_serial(&context) == PNPBS_OK, "serial context");
  if (rank == 0) {
    warning_of(dim, 1, 0.5, alone);
    expect(strcmp(together, alone) == 0, "another warning than one process has");
  }
  pnpbs_context_destroy(&context);
  context = ranks;
}

static void check_ranks_that_differ(int as_mesh) {
  static struct field f;
  pnpbs_placement placement = placement_in_cube(2);
  fill(&f, 2);
  if (size > 1 && rank == size - 1) f.d[3] *= 1.5;
  if (size > 1) {
    expect(give(placement, &f, as_mesh) == PNPBS_ERROR_ARGUMENT, "ranks that differ");
    expect(strstr(pnpbs_last_error(context), "all ranks") != NULL, "are told so");
  }
  fill(&f, 2);
  if (rank == size - 1) f.d[3] = -1;
  expect(give(placement, &f, as_mesh) == PNPBS_ERROR_SPACING, "one rank's bad value");
  expect(strstr(pnpbs_last_error(context), "d[3]") != NULL, "is named");
  pnpbs_placement_destroy(&placement);
}

static void check_all(void) {
  int dim, as_mesh;
  for (dim = 2; dim <= 3; ++dim) check_meshes_of_a_part(dim);
  for (as_mesh = 0; as_mesh < 2; ++as_mesh) {
    for (dim = 2; dim <= 3; ++dim) check_same_nodes(dim, as_mesh);
    check_ranks_that_differ(as_mesh);
  }
}

int main(int argc, char** argv) { return run_in_groups(argc, argv, check_all); }
