/* SPDX-License-Identifier: BSD-3-Clause
 *
 * Implements the helpers of api_support.h. Reference results are computed by brute force. */
#include "api_support.h"

/* ---------------------------------------------------------------- jobs ------------------ */

job job_begin(void) {
  job it = {NULL, NULL, NULL};
  MUST(pnpbs_context_create_serial(&it.context));
  MUST(pnpbs_domain_create(it.context, 2, &it.domain));
  return it;
}

void job_place(job* it) { MUST(pnpbs_placement_create(it->context, it->domain, &it->placement)); }

job square_job(double side) {
  job it = job_begin();
  add_rectangle(it.domain, PNPBS_BOUNDARY, 0, 0, side, side, 1);
  job_place(&it);
  return it;
}

void job_end(job* it) {
  MUST(pnpbs_placement_destroy(&it->placement));
  MUST(pnpbs_domain_destroy(&it->domain));
  MUST(pnpbs_context_destroy(&it->context));
}

void add_rectangle(pnpbs_domain domain, int32_t role, double x0, double y0, double x1, double y1,
                   int32_t tag) {
  const double xy[8] = {x0, y0, x1, y0, x1, y1, x0, y1};
  const int32_t tags[4] = {tag, tag, tag, tag};
  MUST(pnpbs_domain_add_polyline(domain, role, 1, 4, xy, tags, 0.0));
}

void add_circle(pnpbs_domain domain, int32_t role, double x, double y, double radius, int32_t tag) {
  const double centre[2] = {x, y};
  MUST(pnpbs_domain_add_arc(domain, role, centre, radius, 0.0, 2 * PI, tag));
}

int32_t cone_spacing(int64_t n, int32_t dim, const double* xyz, double* d, void* user) {
  const cone* c = user;
  int64_t i;
  for (i = 0; i < n; ++i) {
    d[i] = c->a + c->b * hypot(xyz[dim * i] - c->x0, xyz[dim * i + 1] - c->y0);
  }
  return 0;
}

int64_t integer_of(pnpbs_placement placement, const char* key) {
  int64_t value = -1;
  MUST(pnpbs_placement_get_int64(placement, key, &value));
  return value;
}

double real_of(pnpbs_placement placement, const char* key) {
  double value = NAN;
  MUST(pnpbs_placement_get_double(placement, key, &value));
  return value;
}

hash_text hash_of(pnpbs_placement placement) {
  hash_text hash;
  const char* text = NULL;
  MUST(pnpbs_placement_get_string(placement, "hash", &text));
  snprintf(hash.text, sizeof hash.text, "%s", text);
  return hash;
}

/* ---------------------------------------------------------------- results --------------- */

static void* room(int64_t n, size_t size) {
  void* memory = malloc((size_t)(n > 0 ? n : 1) * size);
  ck_assert_ptr_nonnull(memory);
  return memory;
}

result result_of(pnpbs_placement placement) {
  result it;
  int64_t i;
  memset(&it, 0, sizeof it);
  MUST(pnpbs_placement_count(placement, &it.n));
  it.xy = room(2 * it.n, sizeof *it.xy);
  it.ids = room(it.n, sizeof *it.ids);
  it.tags = room(it.n, sizeof *it.tags);
  it.d = room(it.n, sizeof *it.d);
  MUST(pnpbs_placement_get_nodes(placement, it.n, it.xy, it.ids, it.tags, it.d));

  MUST(pnpbs_placement_star_size(placement, &it.entries));
  it.offsets = room(it.n + 1, sizeof *it.offsets);
  it.neighbours = room(it.entries, sizeof *it.neighbours);
  it.is_triangle = room(it.entries, sizeof *it.is_triangle);
  MUST(pnpbs_placement_get_stars(placement, it.entries, it.offsets, it.neighbours, it.is_triangle));

  MUST(pnpbs_placement_get_triangles(placement, 0, &it.triangles, NULL));
  it.corners = room(3 * it.triangles, sizeof *it.corners);
  MUST(pnpbs_placement_get_triangles(placement, it.triangles, &it.triangles, it.corners));

  MUST(pnpbs_placement_get_boundary_edges(placement, 0, &it.edges, NULL, NULL));
  it.ends = room(2 * it.edges, sizeof *it.ends);
  it.edge_tags = room(it.edges, sizeof *it.edge_tags);
  MUST(pnpbs_placement_get_boundary_edges(placement, it.edges, &it.edges, it.ends, it.edge_tags));

  it.on_boundary = room(it.n, sizeof *it.on_boundary);
  memset(it.on_boundary, 0, (size_t)it.n);
  for (i = 0; i < 2 * it.edges; ++i) {
    ck_assert_int_ge(it.ends[i], 0);
    ck_assert_int_lt(it.ends[i], it.n);
    it.on_boundary[it.ends[i]] = 1;
  }
  return it;
}

void result_free(result* it) {
  free(it->xy);
  free(it->ids);
  free(it->tags);
  free(it->d);
  free(it->offsets);
  free(it->neighbours);
  free(it->is_triangle);
  free(it->corners);
  free(it->ends);
  free(it->edge_tags);
  free(it->on_boundary);
  memset(it, 0, sizeof *it);
}

int64_t node_at(const result* it, double x, double y) {
  int64_t i;
  for (i = 0; i < it->n; ++i) {
    if (it->xy[2 * i] == x && it->xy[2 * i + 1] == y) return i;
  }
  return -1;
}

int64_t node_with_id(const result* it, int64_t id) {
  int64_t i;
  for (i = 0; i < it->n; ++i) {
    if (it->ids[i] == id) return i;
  }
  return -1;
}

int32_t edge_between(const result* it, int64_t a, int64_t b) {
  int64_t e;
  if (!it->on_boundary[a] || !it->on_boundary[b]) return 0;
  for (e = 0; e < it->edges; ++e) {
    const int64_t p = it->ends[2 * e], q = it->ends[2 * e + 1];
    if ((p == a && q == b) || (p == b && q == a)) return it->edge_tags[e];
  }
  return 0;
}

/* Returns the index of b among the entries of the star of a, or -1. */
static int64_t place_in_star(const result* it, int64_t a, int64_t b) {
  int64_t k;
  for (k = it->offsets[a]; k < it->offsets[a + 1]; ++k) {
    if (it->neighbours[k] == b) return k;
  }
  return -1;
}

int are_star_neighbours(const result* it, int64_t a, int64_t b) {
  return place_in_star(it, a, b) >= 0 && place_in_star(it, b, a) >= 0;
}

static double cross(const double* o, const double* a, const double* b) {
  return (a[0] - o[0]) * (b[1] - o[1]) - (a[1] - o[1]) * (b[0] - o[0]);
}

static double gap(const double* a, const double* b) { return hypot(a[0] - b[0], a[1] - b[1]); }

static double gap_to_segment(const double* a, const double* b, const double* x) {
  const double ux = b[0] - a[0], uy = b[1] - a[1];
  const double t = ((x[0] - a[0]) * ux + (x[1] - a[1]) * uy) / (ux * ux + uy * uy);
  const double s = t < 0 ? 0 : t > 1 ? 1 : t;
  return hypot(a[0] + s * ux - x[0], a[1] + s * uy - x[1]);
}

double clearance(const result* it, int64_t node) {
  double least = HUGE_VAL;
  int64_t e;
  for (e = 0; e < it->edges; ++e) {
    const int64_t a = it->ends[2 * e], b = it->ends[2 * e + 1];
    if (a == node || b == node) continue;
    least = fmin(least, gap_to_segment(it->xy + 2 * a, it->xy + 2 * b, it->xy + 2 * node));
  }
  return least;
}

double quality(const double* a, const double* b, const double* c) {
  const double ab = gap(a, b), bc = gap(b, c), ca = gap(c, a);
  const double twice_area = cross(a, b, c);
  const double product = ab * bc * ca * (ab + bc + ca);
  return product > 0 ? 4 * twice_area * fabs(twice_area) / product : 0;
}

quality_summary quality_of(const result* it) {
  quality_summary all = {0, 1, 0};
  int64_t t;
  for (t = 0; t < it->triangles; ++t) {
    const int64_t* v = it->corners + 3 * t;
    const double q = quality(it->xy + 2 * v[0], it->xy + 2 * v[1], it->xy + 2 * v[2]);
    all.mean += q / (double)it->triangles;
    all.least = fmin(all.least, q);
    if (q < 0.95) all.below_95 += 1 / (double)it->triangles;
  }
  return all;
}

double triangle_area(const result* it) {
  double sum = 0;
  int64_t t;
  for (t = 0; t < it->triangles; ++t) {
    const int64_t* v = it->corners + 3 * t;
    sum += 0.5 * cross(it->xy + 2 * v[0], it->xy + 2 * v[1], it->xy + 2 * v[2]);
  }
  return sum;
}

/* ---------------------------------------------------------------- checks ---------------- */

static void check_nodes(const result* it) {
  int64_t i;
  for (i = 0; i < it->n; ++i) {
    ck_assert_msg(isfinite(it->xy[2 * i]) && isfinite(it->xy[2 * i + 1]), "node %lld is nowhere",
                  (long long)i);
    ck_assert_msg(isfinite(it->d[i]) && it->d[i] > 0, "d of node %lld is %g", (long long)i,
                  it->d[i]);
    ck_assert_int_ge(it->ids[i], 0);
    ck_assert_msg(i == 0 || it->ids[i - 1] < it->ids[i], "ids %lld and %lld are out of order",
                  (long long)it->ids[i > 0 ? i - 1 : 0], (long long)it->ids[i]);
    if (it->tags[i] == 0) {
      const double free_way = clearance(it, i);
      ck_assert_msg(!it->on_boundary[i], "node %lld on the boundary has tag 0", (long long)i);
      ck_assert_msg(free_way >= 0.35 * it->d[i] * (1 - 1e-9),
                    "node %lld at (%.17g, %.17g) is only %g d off the boundary", (long long)i,
                    it->xy[2 * i], it->xy[2 * i + 1], free_way / it->d[i]);
    }
  }
}

static void check_edges(const result* it) {
  int64_t e;
  for (e = 0; e < it->edges; ++e) {
    const int64_t a = it->ends[2 * e], b = it->ends[2 * e + 1];
    ck_assert_int_ne(a, b);
    ck_assert_int_ne(it->edge_tags[e], 0);
    ck_assert_int_ne(it->tags[a], 0);
    ck_assert_int_ne(it->tags[b], 0);
    ck_assert_msg(are_star_neighbours(it, a, b),
                  "the boundary edge from (%g, %g) to (%g, %g) is no edge of the stars",
                  it->xy[2 * a], it->xy[2 * a + 1], it->xy[2 * b], it->xy[2 * b + 1]);
  }
}

/* Returns the neighbour that follows entry k in the star of i, in cyclic order. */
static int64_t next_around(const result* it, int64_t i, int64_t k) {
  return it->neighbours[k + 1 < it->offsets[i + 1] ? k + 1 : it->offsets[i]];
}

/* Checks that every star goes round once, counter-clockwise, and that every triangle is in three
 * stars. */
static void check_stars(const result* it) {
  int64_t i, k, triangles = 0;
  ck_assert_int_eq(it->offsets[0], 0);
  ck_assert_int_eq(it->offsets[it->n], it->entries);
  for (i = 0; i < it->n; ++i) {
    const double* x = it->xy + 2 * i;
    double turned = 0;
    int closed = 1;
    ck_assert_int_le(it->offsets[i], it->offsets[i + 1]);
    for (k = it->offsets[i]; k < it->offsets[i + 1]; ++k) {
      const int64_t j = it->neighbours[k], next = next_around(it, i, k);
      int64_t back;
      ck_assert_int_ge(j, 0);
      ck_assert_int_lt(j, it->n);
      ck_assert_int_ne(j, i);
      back = place_in_star(it, j, i);
      ck_assert_msg(back >= 0, "node %lld has %lld in its star, but not the other way round",
                    (long long)i, (long long)j);
      ck_assert(it->is_triangle[k] == 0 || it->is_triangle[k] == 1);
      if (!it->is_triangle[k]) {
        /* The star has a gap here, so this edge and the next one must be on the boundary. */
        ck_assert_int_ne(edge_between(it, i, j), 0);
        ck_assert_int_ne(edge_between(it, i, next), 0);
        closed = 0;
        continue;
      }
      ++triangles;
      ck_assert_msg(cross(x, it->xy + 2 * j, it->xy + 2 * next) > 0,
                    "triangle (%lld, %lld, %lld) is not counter-clockwise", (long long)i,
                    (long long)j, (long long)next);
      turned += atan2(cross(x, it->xy + 2 * j, it->xy + 2 * next),
                      (it->xy[2 * j] - x[0]) * (it->xy[2 * next] - x[0]) +
                          (it->xy[2 * j + 1] - x[1]) * (it->xy[2 * next + 1] - x[1]));
      /* The second corner must have the same triangle in its star. */
      ck_assert_msg(place_in_star(it, j, next) >= 0 &&
                        it->is_triangle[place_in_star(it, j, next)] &&
                        next_around(it, j, place_in_star(it, j, next)) == i,
                    "triangle (%lld, %lld, %lld) is not in the star of its second corner",
                    (long long)i, (long long)j, (long long)next);
    }
    ck_assert_msg(closed ? fabs(turned - 2 * PI) < 1e-6 : turned < 2 * PI,
                  "the star of node %lld turns by %g", (long long)i, turned);
    if (!it->on_boundary[i]) {
      ck_assert_msg(closed, "the star of inner node %lld has a gap", (long long)i);
    }
  }
  ck_assert_int_eq(triangles, 3 * it->triangles);
}

static void check_triangles(const result* it) {
  int64_t t;
  int k;
  for (t = 0; t < it->triangles; ++t) {
    const int64_t* v = it->corners + 3 * t;
    for (k = 0; k < 3; ++k) {
      const int64_t a = v[k], b = v[(k + 1) % 3], c = v[(k + 2) % 3];
      const int64_t place = place_in_star(it, a, b);
      ck_assert_msg(place >= 0 && it->is_triangle[place] && next_around(it, a, place) == c,
                    "triangle %lld is not in the star of node %lld", (long long)t, (long long)a);
    }
  }
}

/* Checks the Delaunay property: the two angles opposite to a common edge sum up to at most 180
 * degrees. */
static void check_delaunay(const result* it) {
  int64_t i, k;
  for (i = 0; i < it->n; ++i) {
    for (k = it->offsets[i]; k < it->offsets[i + 1]; ++k) {
      const int64_t j = it->neighbours[k];
      const int64_t before = it->neighbours[k > it->offsets[i] ? k - 1 : it->offsets[i + 1] - 1];
      const int64_t after = next_around(it, i, k);
      const double *a = it->xy + 2 * i, *b = it->xy + 2 * j, *c = it->xy + 2 * before,
                   *d = it->xy + 2 * after;
      double angles;
      if (i > j || edge_between(it, i, j) != 0) continue;
      angles = atan2(fabs(cross(c, a, b)),
                     (a[0] - c[0]) * (b[0] - c[0]) + (a[1] - c[1]) * (b[1] - c[1])) +
               atan2(fabs(cross(d, a, b)),
                     (a[0] - d[0]) * (b[0] - d[0]) + (a[1] - d[1]) * (b[1] - d[1]));
      ck_assert_msg(angles <= PI + 1e-9, "edge (%lld, %lld) is not Delaunay", (long long)i,
                    (long long)j);
    }
  }
}

void check_result(const result* it, int euler) {
  check_nodes(it);
  check_edges(it);
  check_stars(it);
  check_triangles(it);
  check_delaunay(it);
  ck_assert_int_eq(it->entries % 2, 0);
  ck_assert_int_eq(it->n - it->entries / 2 + it->triangles, euler);
}

void check_placement(pnpbs_placement placement, int euler) {
  result it = result_of(placement);
  MUST(pnpbs_placement_check(placement));
  check_result(&it, euler);
  ck_assert_int_eq(integer_of(placement, "nodes"), it.n);
  result_free(&it);
}
