/* SPDX-License-Identifier: BSD-3-Clause
 *
 * Tests what assembling a matrix over ranks requires, in the plane, in space and on surfaces. The
 * elements that touch a rank's nodes are those of one process, in the same order, so rows have the
 * same bits. Sums at ghosts are added to their owners exactly and rounded once, for any order of
 * ranks. */
#include <math.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

#include "rank_program.h"

enum { PLANE, SPACE, SURFACES };

static int message_has(const char* text) { return strstr(pnpbs_last_error(context), text) != NULL; }

static void* array(int64_t n, size_t of) { return calloc((size_t)n + 1, of); }

/* The mesh of a rank: its nodes, then its ghosts, and the elements that touch its nodes. */
struct mesh {
  int32_t dim, corners;
  int64_t owned, all, *ids, count, *elements;
  double* x;
};

static struct mesh get_mesh(pnpbs_placement placement) {
  struct mesh m;
  int64_t ghosts;
  pnpbs_placement_dimension(placement, &m.dim);
  pnpbs_placement_count(placement, &m.owned);
  expect(pnpbs_placement_ghost_count(placement, &ghosts) == PNPBS_OK, "ghosts");
  m.all = m.owned + ghosts;
  m.ids = array(m.all, sizeof(int64_t));
  m.x = array(m.dim * m.all, sizeof(double));
  pnpbs_placement_get_nodes(placement, m.owned, m.x, m.ids, NULL, NULL);
  pnpbs_placement_get_ghosts(placement, ghosts, m.x + m.dim * m.owned, m.ids + m.owned, NULL, NULL,
                             NULL);
  expect(
      pnpbs_placement_get_incident_elements(placement, 0, &m.count, &m.corners, NULL) == PNPBS_OK,
      "count of elements");
  m.elements = array(m.count * m.corners, sizeof(int64_t));
  expect(pnpbs_placement_get_incident_elements(placement, m.count, &m.count, NULL, m.elements) ==
             PNPBS_OK,
         "elements");
  return m;
}

static void free_mesh(struct mesh* m) { free(m->ids), free(m->x), free(m->elements); }

static pnpbs_placement placed(int where) {
  const double square[] = {0, 0, 1, 0, 1, 1, 0, 1}, low[] = {0, 0, 0}, high[] = {1, 1, 1};
  pnpbs_domain domain;
  pnpbs_placement placement;
  expect(pnpbs_domain_create(context, where == PLANE ? 2 : 3, &domain) == PNPBS_OK, "domain");
  if (where == PLANE)
    pnpbs_domain_add_polyline(domain, PNPBS_BOUNDARY, 1, 4, square, NULL, 0);
  else
    pnpbs_domain_add_box(domain, low, high, 1);
  if (where == SURFACES) pnpbs_domain_set_filled(domain, 0);
  expect(pnpbs_placement_create(context, domain, &placement) == PNPBS_OK, "placement");
  pnpbs_placement_set_int64(placement, "steps", 20);
  pnpbs_placement_set_spacing_constant(placement, where == PLANE ? 0.06 : 0.17);
  expect(pnpbs_placement_run(placement) >= 0, "run");
  pnpbs_domain_destroy(&domain);
  return placement;
}

/* ---------------------------------------------------------------- elements --------------- */

static pnpbs_status get_own(pnpbs_placement placement, const struct mesh* m, int64_t capacity,
                            int64_t* count, int64_t* own) {
  if (m->dim == 2) return pnpbs_placement_get_triangles(placement, capacity, count, own);
  return m->corners == 4
             ? pnpbs_placement_get_tetrahedra(placement, capacity, count, own)
             : pnpbs_placement_get_boundary_triangles(placement, capacity, count, own, NULL);
}

/* Returns twice the area, or six times the volume; on surfaces 1. */
static double measure(const struct mesh* m, const int64_t* corners) {
  double side[3][3] = {{0}};
  int k, c;
  for (k = 1; k < m->corners; ++k)
    for (c = 0; c < m->dim; ++c)
      side[k - 1][c] = m->x[m->dim * corners[k] + c] - m->x[m->dim * corners[0] + c];
  if (m->dim == 2) return side[0][0] * side[1][1] - side[0][1] * side[1][0];
  if (m->corners == 3) return 1;
  return side[0][0] * (side[1][1] * side[2][2] - side[1][2] * side[2][1]) +
         side[0][1] * (side[1][2] * side[2][0] - side[1][0] * side[2][2]) +
         side[0][2] * (side[1][0] * side[2][1] - side[1][1] * side[2][0]);
}

static int by_ids(const struct mesh* m, const int64_t* a, const int64_t* b) {
  int k;
  for (k = 0; k < m->corners; ++k)
    if (m->ids[a[k]] != m->ids[b[k]]) return m->ids[a[k]] < m->ids[b[k]] ? -1 : 1;
  return 0;
}

/* Hashes an element. The result is the same for any order of corners with the same orientation. */
static uint64_t mixed(uint64_t x) {
  x = (x ^ (x >> 31)) * UINT64_C(0x9e3779b97f4a7c15);
  x = (x ^ (x >> 29)) * UINT64_C(0xbf58476d1ce4e5b9);
  return x ^ (x >> 32);
}
static uint64_t hash_of(const struct mesh* m, const int64_t* corners) {
  uint64_t sum = 0;
  int k;
  for (k = 0; k < m->corners; ++k) sum += mixed((uint64_t)m->ids[corners[k]] + 1);
  return mixed(sum);
}

static void check_elements(pnpbs_placement placement, const struct mesh* m) {
  uint64_t incident = 0, belonging = 0;
  int64_t e, count, others, *own, mine = 0;
  for (e = 0; e < m->count; ++e) {
    const int64_t* corners = m->elements + m->corners * e;
    int k, touches = 0;
    for (k = 0; k < m->corners; ++k) {
      expect(corners[k] >= 0 && corners[k] < m->all, "a corner is a node or a ghost");
      touches |= corners[k] < m->owned;
      expect(k == 0 || m->ids[corners[0]] < m->ids[corners[k]], "the least id comes first");
    }
    expect(m->corners == 3 ||
               (m->ids[corners[1]] < m->ids[corners[2]] && m->ids[corners[1]] < m->ids[corners[3]]),
           "of the others in space, too");
    expect(touches, "an element touches a node of this rank");
    expect(measure(m, corners) > 0, "an element is positively oriented");
    expect(e == 0 || by_ids(m, corners - m->corners, corners) < 0,
           "elements are in the order of ids, each once");
    if (corners[0] < m->owned) ++mine, incident += hash_of(m, corners);
  }
  expect(get_own(placement, m, 0, &count, NULL) == PNPBS_OK, "own elements");
  expect(count == mine, "the elements of this rank are among them");
  own = array(count * m->corners, sizeof(int64_t));
  expect(get_own(placement, m, count, &count, own) == PNPBS_OK, "own elements");
  for (e = 0; e < count; ++e) belonging += hash_of(m, own + m->corners * e);
  expect(incident == belonging,
         "the elements of this rank are those whose first corner is its own");
  others = m->count - count;
  MPI_Allreduce(MPI_IN_PLACE, &others, 1, MPI_INT64_T, MPI_SUM, group);
  expect((others > 0) == (size > 1), "others have elements, too, that touch a rank's nodes");
  if (m->count > 0)
    expect(pnpbs_placement_get_incident_elements(placement, m->count - 1, &count, NULL, own) ==
                   PNPBS_ERROR_CAPACITY &&
               message_has(" are needed"),
           "too little room");
  expect(
      pnpbs_placement_get_incident_elements(placement, 0, NULL, NULL, NULL) == PNPBS_ERROR_ARGUMENT,
      "no count");
  free(own);
}

/* Accumulates rows by elements in their order, and returns a hash of the rows of all ranks. */
static uint64_t hash_of_rows(const struct mesh* m, int over_ranks) {
  double* row = array(m->owned, sizeof(double));
  uint64_t hash = 0, bits;
  int64_t e, i;
  int k;
  for (e = 0; e < m->count; ++e)
    for (k = 0; k < m->corners; ++k) {
      const int64_t* corners = m->elements + m->corners * e;
      const int64_t other = corners[(k + 1) % m->corners];
      if (corners[k] < m->owned)
        row[corners[k]] += measure(m, corners) / (1 + m->x[m->dim * other]);
    }
  for (i = 0; i < m->owned; ++i) {
    memcpy(&bits, &row[i], sizeof bits);
    hash += mixed(mixed((uint64_t)m->ids[i]) + bits);
  }
  free(row);
  if (over_ranks) MPI_Allreduce(MPI_IN_PLACE, &hash, 1, MPI_UINT64_T, MPI_SUM, group);
  return hash;
}

static void check_rows(const struct mesh* m, int where) {
  const uint64_t together = hash_of_rows(m, 1);
  pnpbs_context all = context;
  expect(pnpbs_context_create_serial(&context) == PNPBS_OK, "serial context");
  if (rank == 0) {
    pnpbs_placement placement = placed(where);
    struct mesh alone = get_mesh(placement);
    expect(hash_of_rows(&alone, 0) == together, "rows have other bits than on one process");
    free_mesh(&alone);
    pnpbs_placement_destroy(&placement);
  }
  pnpbs_context_destroy(&context);
  context = all;
}

/* ---------------------------------------------------------------- sums ------------------- */

/* Checks sums of counts: each rank counts its own elements at nodes and ghosts, and the sum at a
 * node must be the number of all elements around it. */
static void check_counts(pnpbs_placement placement, const struct mesh* m, int components) {
  const int64_t n = m->all * components;
  double *sums = array(n, sizeof(double)), *before = array(n, sizeof(double));
  double* around = array(m->all, sizeof(double));
  int64_t e, i;
  int k, c;
  for (e = 0; e < m->count; ++e)
    for (k = 0; k < m->corners; ++k) {
      const int64_t* corners = m->elements + m->corners * e;
      around[corners[k]] += 1;
      if (corners[0] >= m->owned) continue;
      for (c = 0; c < components; ++c) sums[corners[k] * components + c] += c + 1;
    }
  memcpy(before, sums, (size_t)n * sizeof(double));
  expect(pnpbs_placement_add_from_ghosts(placement, m->all, components, sums) == PNPBS_OK, "sums");
  for (i = 0; i < m->owned; ++i)
    for (c = 0; c < components; ++c)
      expect(sums[i * components + c] == around[i] * (c + 1), "all parts of a sum arrive");
  expect(memcmp(sums + m->owned * components, before + m->owned * components,
                (size_t)(n - m->owned * components) * sizeof(double)) == 0,
         "ghosts keep their values");
  free(sums), free(before), free(around);
}

/* Returns one of five terms, of which large ones cancel. A sum that rounds intermediate results
 * loses the small one. */
static double term(int of) {
  static const double terms[] = {0x1p100, 1, -0x1p100, 0x1p60, -0x1p60};
  return terms[of % 5];
}

static void check_exact(pnpbs_placement placement, const struct mesh* m) {
  double* values = array(m->all, sizeof(double));
  double* who = array(m->all, sizeof(double));
  int64_t i, three = 0, all;
  int r;
  for (i = 0; i < m->all; ++i) values[i] = term(rank), who[i] = ldexp(1, rank);
  expect(pnpbs_placement_add_from_ghosts(placement, m->all, 1, who) == PNPBS_OK, "who has it");
  expect(pnpbs_placement_add_from_ghosts(placement, m->all, 1, values) == PNPBS_OK, "sums");
  for (i = 0; i < m->owned; ++i) {
    const int ranks = (int)who[i];
    long double sum = 0, small = 0;
    for (r = 0; r < size; ++r)
      if (ranks >> r & 1) *(r % 5 == 1 ? &small : &sum) += term(r);
    expect(values[i] == (double)(sum + small), "a sum is exact, and rounded once");
    three += (ranks & 7) == 7;
  }
  MPI_Allreduce(&three, &all, 1, MPI_INT64_T, MPI_SUM, group);
  if (size >= 3) expect(all > 0, "there are nodes that three ranks have");
  for (i = 0; i < m->all; ++i) values[i] = i < m->owned ? -0.0 : i % 2 == 0 ? 0 : -0.0;
  expect(pnpbs_placement_add_from_ghosts(placement, m->all, 1, values) == PNPBS_OK, "sums");
  for (i = 0; i < m->owned; ++i) expect(!signbit(values[i]), "a sum that is 0 is +0");
  free(values), free(who);
}

static void check_wrong_sums(pnpbs_placement placement, const struct mesh* m) {
  const int last = rank == size - 1;
  double* values = array(2 * m->all, sizeof(double));
  expect(pnpbs_placement_add_from_ghosts(placement, m->all - last, 1, values) ==
                 PNPBS_ERROR_ARGUMENT &&
             message_has("argument n = "),
         "a value missing on one rank");
  expect(pnpbs_placement_add_from_ghosts(placement, m->all, 1 - last, values) ==
                 PNPBS_ERROR_ARGUMENT &&
             message_has("components = 0"),
         "no component on one rank");
  expect(pnpbs_placement_add_from_ghosts(placement, m->all, 1, last ? NULL : values) ==
                 PNPBS_ERROR_ARGUMENT &&
             message_has("values is NULL"),
         "no values on one rank");
  if (size > 1)
    expect(pnpbs_placement_add_from_ghosts(placement, m->all, 1 + last, values) ==
                   PNPBS_ERROR_ARGUMENT &&
               message_has("all ranks must give the same"),
           "other components on one rank");
  /* The sum does not interfere with an update in progress. */
  expect(pnpbs_placement_begin_update_ghosts(placement, m->all, 2, values) == PNPBS_OK, "begin");
  check_counts(placement, m, 1);
  expect(pnpbs_placement_end_update_ghosts(placement, m->all, 2, values) == PNPBS_OK, "end");
  free(values);
}

static void check(int where) {
  pnpbs_placement placement = placed(where);
  int pass;
  for (pass = 0; pass < 2; ++pass) {
    struct mesh m = get_mesh(placement);
    expect(m.corners == (where == SPACE ? 4 : 3), "corners");
    check_elements(placement, &m);
    check_rows(&m, where);
    check_counts(placement, &m, 1);
    check_counts(placement, &m, 3);
    check_exact(placement, &m);
    check_wrong_sums(placement, &m);
    free_mesh(&m);
    if (pass == 0) expect(pnpbs_placement_rebalance(placement) == PNPBS_OK, "other owners");
  }
  pnpbs_placement_destroy(&placement);
}

static void check_without_nodes(void) {
  pnpbs_domain domain;
  pnpbs_placement placement;
  double value = 0;
  int64_t count;
  pnpbs_domain_create(context, 2, &domain);
  pnpbs_placement_create(context, domain, &placement);
  expect(pnpbs_placement_add_from_ghosts(placement, 0, 1, &value) == PNPBS_ERROR_STATE, "no nodes");
  expect(
      pnpbs_placement_get_incident_elements(placement, 0, &count, NULL, NULL) == PNPBS_ERROR_STATE,
      "no nodes");
  pnpbs_placement_destroy(&placement);
  pnpbs_domain_destroy(&domain);
}

static void check_all(void) {
  check_without_nodes();
  check(PLANE);
  check(SPACE);
  check(SURFACES);
}

int main(int argc, char** argv) { return run_in_groups(argc, argv, check_all); }
