/* SPDX-License-Identifier: BSD-3-Clause
 *
 * The cases that the programs over MPI_COMM_WORLD share: graded-square, uniform-square,
 * jump-square, steep-square (slope 0.2), ring (a disk with a hole, from which d grows, and with
 * inner curves), even-cube, graded-cube (1:10 from a corner), or a .poly file (graded). A scale
 * multiplies the spacings; in the steep case it multiplies the spacing at the point. */
#ifndef PNPBS_PLACEMENT_CASES_H
#define PNPBS_PLACEMENT_CASES_H

#include <math.h>
#include <mpi.h>
#include <pnpbs/pnpbs_mpi.h>
#include <stdio.h>
#include <string.h>

/* A spacing that grows from a point, in space from one with z = 0. Right of a line it has another
 * value. */
struct case_spacing {
  double constant, slope, x, y, line, beyond;
};

static int32_t case_spacing_at(int64_t n, int32_t dim, const double* x, double* d, void* user) {
  const struct case_spacing* s = user;
  int64_t i;
  for (i = 0; i < n; ++i)
    d[i] = x[dim * i] < s->line
               ? s->constant + s->slope * hypot(hypot(x[dim * i] - s->x, x[dim * i + 1] - s->y),
                                                dim == 3 ? x[dim * i + 2] : 0.0)
               : s->beyond;
  return 0;
}

static int32_t case_dimension(const char* name) { return strstr(name, "-cube") ? 3 : 2; }

static void case_check(pnpbs_context context, pnpbs_status status, const char* what) {
  if (status >= 0) return;
  fprintf(stderr, "%s: %s\n", what, pnpbs_last_error(context));
  MPI_Abort(MPI_COMM_WORLD, 1);
}

static void case_add_ring(pnpbs_context context, pnpbs_domain domain) {
  const double pi = 3.14159265358979323846, middle[] = {0.5, 0.5}, hole[] = {0.4, 0.55},
               island[] = {0.62, 0.8}, hook[] = {0.5, 0.1, 0.8, 0.3, 0.85, 0.6};
  case_check(context, pnpbs_domain_add_arc(domain, PNPBS_BOUNDARY, middle, 0.5, 0, 2 * pi, 1),
             "disk");
  case_check(context, pnpbs_domain_add_arc(domain, PNPBS_BOUNDARY, hole, 0.2, 0, 2 * pi, 2),
             "hole");
  case_check(context, pnpbs_domain_add_arc(domain, PNPBS_INNER, island, 0.1, 0, 2 * pi, 3),
             "inner circle");
  case_check(context, pnpbs_domain_add_polyline(domain, PNPBS_INNER, 0, 3, hook, NULL, 0), "hook");
}

/* Creates a placement of the case with the options in `settings`. Each is "key=value", which this
 * function splits in place. `spacing` must outlive the placement. */
static pnpbs_placement case_placement(pnpbs_context context, const char* name, double scale,
                                      int count, char** settings, struct case_spacing* spacing) {
  const double square[] = {0, 0, 1, 0, 1, 1, 0, 1};
  const struct case_spacing graded = {0.00068, 9 * 0.00068 / 0.7071, 0.5, 0.5, HUGE_VAL, 0},
                            uniform = {0.0034, 0, 0, 0, HUGE_VAL, 0},
                            steep = {0.0005, 0, 0.3, 0.4, HUGE_VAL, 0},
                            ring = {0.002, 0.05, 0.4, 0.55, HUGE_VAL, 0},
                            jump = {0.3, 0, 0, 0, 0.52, 0.012},
                            in_a_lake = {0.3, 0.006, 0, 0, HUGE_VAL, 0},
                            even = {0.0185, 0, 0, 0, HUGE_VAL, 0},
                            corner = {0.004, 0.02, 0, 0, HUGE_VAL, 0};
  const double low[] = {0, 0, 0}, high[] = {1, 1, 1};
  pnpbs_domain domain;
  pnpbs_placement placement;
  int a;
  case_check(context, pnpbs_domain_create(context, case_dimension(name), &domain), "domain");
  if (strstr(name, "square")) {
    case_check(context, pnpbs_domain_add_polyline(domain, PNPBS_BOUNDARY, 1, 4, square, NULL, 0),
               "square");
    *spacing = strstr(name, "uniform") ? uniform
               : strstr(name, "jump")  ? jump
               : strstr(name, "steep") ? steep
                                       : graded;
  } else if (strcmp(name, "ring") == 0) {
    case_add_ring(context, domain);
    *spacing = ring;
  } else if (case_dimension(name) == 3) {
    case_check(context, pnpbs_domain_add_box(domain, low, high, 1), "cube");
    *spacing = strstr(name, "even") ? even : corner;
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
