/* SPDX-License-Identifier: BSD-3-Clause
 *
 * Implements the helpers of volume_support.h. */
#include "volume_support.h"

job body_job(volume_body body) {
  job it = {NULL, NULL, NULL};
  MUST(pnpbs_context_create_serial(&it.context));
  MUST(pnpbs_domain_create(it.context, 3, &it.domain));
  MUST(body(it.domain, DATA));
  job_place(&it);
  return it;
}

job box_job(double d) {
  job it = body_job(volume_unit_box);
  MUST(pnpbs_placement_set_spacing_constant(it.placement, d));
  return it;
}

int warnings_with(pnpbs_placement placement, const char* words) {
  int32_t warnings = 0, k;
  int found = 0;
  MUST(pnpbs_placement_warning_count(placement, &warnings));
  for (k = 0; k < warnings; ++k) {
    const char* text = NULL;
    MUST(pnpbs_placement_get_warning(placement, k, &text));
    found += strstr(text, words) != NULL;
  }
  return found;
}

static void* room(int64_t n, size_t size) {
  void* memory = malloc((size_t)(n > 0 ? n : 1) * size);
  ck_assert_ptr_nonnull(memory);
  return memory;
}

volume volume_of(pnpbs_placement p) {
  volume v;
  MUST(pnpbs_placement_count(p, &v.n));
  v.xyz = room(3 * v.n, sizeof *v.xyz);
  v.d = room(v.n, sizeof *v.d);
  v.ids = room(v.n, sizeof *v.ids);
  v.tags = room(v.n, sizeof *v.tags);
  MUST(pnpbs_placement_get_nodes(p, v.n, v.xyz, v.ids, v.tags, v.d));
  MUST(pnpbs_placement_get_tetrahedra(p, 0, &v.tetrahedra, NULL));
  v.corners = room(4 * v.tetrahedra, sizeof *v.corners);
  MUST(pnpbs_placement_get_tetrahedra(p, v.tetrahedra, &v.tetrahedra, v.corners));
  MUST(pnpbs_placement_get_boundary_triangles(p, 0, &v.triangles, NULL, NULL));
  v.sides = room(3 * v.triangles, sizeof *v.sides);
  v.side_tags = room(v.triangles, sizeof *v.side_tags);
  MUST(pnpbs_placement_get_boundary_triangles(p, v.triangles, &v.triangles, v.sides, v.side_tags));
  return v;
}

void volume_free(volume* v) {
  free(v->xyz), free(v->d), free(v->ids), free(v->tags);
  free(v->corners), free(v->sides), free(v->side_tags);
}

double distance(const double* a, const double* b) {
  return sqrt((a[0] - b[0]) * (a[0] - b[0]) + (a[1] - b[1]) * (a[1] - b[1]) +
              (a[2] - b[2]) * (a[2] - b[2]));
}

static void cross(const double* a, const double* b, const double* c, double* product) {
  int k;
  for (k = 0; k < 3; ++k) {
    const int u = (k + 1) % 3, v = (k + 2) % 3;
    product[k] = (b[u] - a[u]) * (c[v] - a[v]) - (b[v] - a[v]) * (c[u] - a[u]);
  }
}

double volume_sum(const volume* v) {
  double sum = 0;
  int64_t t;
  int k;
  for (t = 0; t < v->tetrahedra; ++t) {
    const int64_t* c = v->corners + 4 * t;
    const double *a = v->xyz + 3 * c[0], *top = v->xyz + 3 * c[3];
    double product[3], six = 0;
    cross(a, v->xyz + 3 * c[1], v->xyz + 3 * c[2], product);
    for (k = 0; k < 3; ++k) six += product[k] * (top[k] - a[k]);
    ck_assert_double_gt(six, 0);
    sum += six / 6;
  }
  return sum;
}

double boundary_area(const volume* v, int32_t tag, double* enclosed) {
  double area = 0, six = 0;
  int64_t t;
  int k;
  for (t = 0; t < v->triangles; ++t) {
    const int64_t* c = v->sides + 3 * t;
    const double zero[3] = {0, 0, 0};
    double product[3];
    cross(v->xyz + 3 * c[0], v->xyz + 3 * c[1], v->xyz + 3 * c[2], product);
    for (k = 0; k < 3; ++k) six += product[k] * v->xyz[3 * c[0] + k];
    if (tag == 0 || v->side_tags[t] == tag) area += distance(zero, product) / 2;
  }
  if (enclosed) *enclosed = six / 6;
  return area;
}

double nearest_pair(const volume* v) {
  double nearest = HUGE_VAL;
  int64_t i, j;
  for (i = 0; i < v->n; ++i)
    for (j = 0; j < i; ++j)
      nearest = fmin(nearest, 2 * distance(v->xyz + 3 * i, v->xyz + 3 * j) / (v->d[i] + v->d[j]));
  return nearest;
}

static void check_volume(const job* it, double tolerance) {
  double measure, enclosed;
  volume v;
  MUST(pnpbs_domain_measure(it->domain, &measure));
  v = volume_of(it->placement);
  ck_assert_double_eq_tol(volume_sum(&v), measure, tolerance * measure);
  boundary_area(&v, 0, &enclosed);
  ck_assert_double_eq_tol(volume_sum(&v), enclosed, 1e-12 * measure);
  volume_free(&v);
}

void check_body(const job* it, double tolerance) {
  MUST(pnpbs_placement_check(it->placement));
  check_volume(it, tolerance);
}

void check_stopped_body(const job* it, double tolerance) {
  const pnpbs_status status = pnpbs_placement_check(it->placement);
  ck_assert_msg(status == PNPBS_OK || status == PNPBS_NOT_CONFORMING, "status %d; %s", (int)status,
                MESSAGE());
  check_volume(it, tolerance);
}

job rough_job(double depth, double waves, double d) { return repaired_job(depth, waves, d, 0); }

job repaired_job(double depth, double waves, double d, double resolution) {
  job it = {NULL, NULL, NULL};
  MUST(pnpbs_context_create_serial(&it.context));
  MUST(pnpbs_domain_create(it.context, 3, &it.domain));
  MUST(volume_add_rough_globe(it.domain, depth, waves));
  if (resolution > 0) MUST(pnpbs_domain_set_resurfaced(it.domain, resolution));
  job_place(&it);
  MUST(pnpbs_placement_set_spacing_constant(it.placement, d));
  return it;
}

job unresolved_job(void) { return rough_job(0.7, 6.5, 0.4); }

static pnpbs_status small_sphere(pnpbs_domain domain, const char* data) {
  const double centre[] = {0, 0, 0};
  const pnpbs_status status = pnpbs_domain_add_ball(domain, centre, 0.3, 1);
  (void)data;
  return status < 0 ? status : pnpbs_domain_set_filled(domain, 0);
}

job unresolved_surface_job(void) {
  job it = body_job(small_sphere);
  MUST(pnpbs_placement_set_spacing_constant(it.placement, 0.5));
  return it;
}
