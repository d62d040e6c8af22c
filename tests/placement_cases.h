/* SPDX-License-Identifier: BSD-3-Clause
 *
 * The cases that the programs over MPI_COMM_WORLD share: graded-square, uniform-square,
 * jump-square, steep-square (by a fifth of the distance), or a .poly file (graded), with spacings
 * that a scale multiplies; of the steep one, that at the point. */
#ifndef PNPBS_PLACEMENT_CASES_H
#define PNPBS_PLACEMENT_CASES_H

#include <math.h>
#include <mpi.h>
#include <pnpbs/pnpbs_mpi.h>
#include <stdio.h>
#include <string.h>

/* Grows from a point on; something else right of a line. */
struct case_spacing {
  double constant, slope, x, y, line, beyond;
};

static int32_t case_spacing_at(int64_t n, int32_t dim, const double* x, double* d, void* user) {
  const struct case_spacing* s = user;
  int64_t i;
  for (i = 0; i < n; ++i)
    d[i] = x[dim * i] < s->line
               ? s->constant + s->slope * hypot(x[dim * i] - s->x, x[dim * i + 1] - s->y)
               : s->beyond;
  return 0;
}

static void case_check(pnpbs_context context, pnpbs_status status, const char* what) {
  if (status >= 0) return;
  fprintf(stderr, "%s: %s\n", what, pnpbs_last_error(context));
  MPI_Abort(MPI_COMM_WORLD, 1);
}

/* A placement of the case, with the options in `settings` ("key=value", cut in two). `spacing` must
 * stay as long as the placement. */
static pnpbs_placement case_placement(pnpbs_context context, const char* name, double scale,
                                      int count, char** settings, struct case_spacing* spacing) {
  const double square[] = {0, 0, 1, 0, 1, 1, 0, 1};
  const struct case_spacing graded = {0.00068, 9 * 0.00068 / 0.7071, 0.5, 0.5, HUGE_VAL, 0},
                            uniform = {0.0034, 0, 0, 0, HUGE_VAL, 0},
                            steep = {0.0005, 0, 0.3, 0.4, HUGE_VAL, 0},
                            jump = {0.3, 0, 0, 0, 0.52, 0.012},
                            in_a_lake = {0.3, 0.006, 0, 0, HUGE_VAL, 0};
  pnpbs_domain domain;
  pnpbs_placement placement;
  int a;
  case_check(context, pnpbs_domain_create(context, 2, &domain), "domain");
  if (strstr(name, "square")) {
    case_check(context, pnpbs_domain_add_polyline(domain, PNPBS_BOUNDARY, 1, 4, square, NULL, 0),
               "square");
    *spacing = strstr(name, "uniform") ? uniform
               : strstr(name, "jump")  ? jump
               : strstr(name, "steep") ? steep
                                       : graded;
  } else {
    case_check(context, pnpbs_domain_read_poly(domain, name), "poly");
    *spacing = in_a_lake;
  }
  spacing->constant *= scale;
  spacing->slope *= scale;
  spacing->beyond *= scale;
  if (strstr(name, "steep")) spacing->slope = 0.2;
  case_check(context, pnpbs_placement_create(context, domain, &placement), "placement");
  pnpbs_domain_destroy(&domain);
  for (a = 0; a < count; ++a) {
    char* value = strchr(settings[a], '=');
    if (!value) {
      fprintf(stderr, "%s: expected an option as key=value\n", settings[a]);
      MPI_Abort(MPI_COMM_WORLD, 1);
      break;
    }
    *value++ = 0;
    case_check(context, pnpbs_placement_set(placement, settings[a], value), settings[a]);
  }
  case_check(context, pnpbs_placement_set_spacing_callback(placement, case_spacing_at, spacing),
             "spacing");
  return placement;
}

#endif
