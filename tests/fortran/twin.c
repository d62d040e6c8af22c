/* SPDX-License-Identifier: BSD-3-Clause
 *
 * The C side of the tests of the Fortran modules: makes the same queries by the C interface on the
 * same handles, and counts differences. Indices are passed as in Fortran, from 1.
 */
#include <pnpbs/pnpbs.h>
#include <stdlib.h>
#include <string.h>

int64_t twin_nodes(int64_t handle, int64_t n, const double* xyz, const int64_t* ids,
                   const int32_t* tags, const double* d);
int64_t twin_ghosts(int64_t handle, int64_t n, const double* xyz, const int64_t* ids,
                    const int32_t* tags, const double* d, const int32_t* owners,
                    const int64_t* numbers);
int64_t twin_lists(int64_t handle, int32_t stars, int64_t nodes, const int64_t* offsets,
                   const int64_t* neighbours, const int8_t* triangle);
int64_t twin_triangles(int64_t handle, int64_t n, const int64_t* triangles);
int64_t twin_edges(int64_t handle, int64_t n, const int64_t* edges, const int32_t* tags);
int64_t twin_tetrahedra(int64_t handle, int64_t n, const int64_t* tetrahedra);
int64_t twin_incident_elements(int64_t handle, int64_t n, int32_t corners, const int64_t* elements);
int64_t twin_boundary_triangles(int64_t handle, int64_t n, const int64_t* triangles,
                                const int32_t* tags);
int64_t twin_exchange(int64_t handle, int32_t neighbours, const int32_t* ranks,
                      const int64_t* send_offsets, const int64_t* send_nodes,
                      const int64_t* receive_offsets, const int64_t* receive_nodes);
int64_t twin_mesh_nodes(int64_t handle, int64_t n, const double* xyz, const int64_t* numbers,
                        const int64_t* ids, const int32_t* owners, const int32_t* tags);
int64_t twin_mesh_elements(int64_t handle, int64_t n, const int32_t* nodes, const int64_t* numbers,
                           const int32_t* owners, const int32_t* tags, const int64_t* at_corners);
int64_t twin_mesh_facets(int64_t handle, int64_t n, const int32_t* nodes, const int32_t* tags,
                         const int32_t* elements, const int32_t* opposite, const int8_t* inner,
                         const int32_t* owners);
int64_t twin_mesh_sharing(int64_t handle, int64_t nodes, int64_t entries, const int32_t* shared,
                          const int64_t* offsets, const int32_t* ranks);
int64_t twin_segments(int64_t handle, int64_t n, const double* segments, const int32_t* tags);

static pnpbs_placement placement_of(int64_t handle) { return (pnpbs_placement)(intptr_t)handle; }

static pnpbs_mesh mesh_of(int64_t handle) { return (pnpbs_mesh)(intptr_t)handle; }

static int32_t dimension_of(pnpbs_placement p) {
  int32_t dim = 0;
  return pnpbs_placement_dimension(p, &dim) == PNPBS_OK ? dim : 0;
}

static void* room(int64_t n, size_t size) { return calloc((size_t)n + 1, size); }

/* Returns the number of indices that are not by 1 larger than those of C. */
static int64_t shifted(int64_t n, const int64_t* ours, const int64_t* fortran) {
  int64_t i, wrong = 0;
  for (i = 0; i < n; ++i) wrong += ours[i] + 1 != fortran[i];
  return wrong;
}

static int64_t shifted_short(int64_t n, const int32_t* ours, const int32_t* fortran) {
  int64_t i, wrong = 0;
  for (i = 0; i < n; ++i) wrong += ours[i] + 1 != fortran[i];
  return wrong;
}

int64_t twin_nodes(int64_t handle, int64_t n, const double* xyz, const int64_t* ids,
                   const int32_t* tags, const double* d) {
  const pnpbs_placement p = placement_of(handle);
  const int32_t dim = dimension_of(p);
  double *x = room(dim * n, sizeof *x), *s = room(n, sizeof *s);
  int64_t *i = room(n, sizeof *i), nodes = -1, wrong = 0;
  int32_t* t = room(n, sizeof *t);
  wrong += pnpbs_placement_count(p, &nodes) != PNPBS_OK || nodes != n;
  wrong += pnpbs_placement_get_nodes(p, n, x, i, t, s) != PNPBS_OK;
  wrong += memcmp(x, xyz, (size_t)(dim * n) * sizeof *x) != 0;
  wrong += memcmp(i, ids, (size_t)n * sizeof *i) != 0;
  wrong += memcmp(t, tags, (size_t)n * sizeof *t) != 0;
  wrong += memcmp(s, d, (size_t)n * sizeof *s) != 0;
  free(x), free(s), free(i), free(t);
  return wrong;
}

int64_t twin_ghosts(int64_t handle, int64_t n, const double* xyz, const int64_t* ids,
                    const int32_t* tags, const double* d, const int32_t* owners,
                    const int64_t* numbers) {
  const pnpbs_placement p = placement_of(handle);
  const int32_t dim = dimension_of(p);
  double *x = room(dim * n, sizeof *x), *s = room(n, sizeof *s);
  int64_t *i = room(n, sizeof *i), ghosts = -1, wrong = 0;
  int32_t *t = room(n, sizeof *t), *o = room(n, sizeof *o);
  wrong += pnpbs_placement_ghost_count(p, &ghosts) != PNPBS_OK || ghosts != n;
  wrong += pnpbs_placement_get_ghosts(p, n, x, i, t, s, o) != PNPBS_OK;
  wrong += memcmp(x, xyz, (size_t)(dim * n) * sizeof *x) != 0;
  wrong += memcmp(i, ids, (size_t)n * sizeof *i) != 0;
  wrong += memcmp(t, tags, (size_t)n * sizeof *t) != 0;
  wrong += memcmp(s, d, (size_t)n * sizeof *s) != 0;
  wrong += memcmp(o, owners, (size_t)n * sizeof *o) != 0;
  wrong += pnpbs_placement_get_numbering(p, n, NULL, NULL, i) != PNPBS_OK;
  wrong += memcmp(i, numbers, (size_t)n * sizeof *i) != 0;
  free(x), free(s), free(i), free(t), free(o);
  return wrong;
}

int64_t twin_lists(int64_t handle, int32_t stars, int64_t nodes, const int64_t* offsets,
                   const int64_t* neighbours, const int8_t* triangle) {
  const pnpbs_placement p = placement_of(handle);
  int64_t entries = -1, wrong = 0, *rows = room(nodes, sizeof *rows), *list;
  int8_t* flags;
  wrong += (stars ? pnpbs_placement_star_size(p, &entries)
                  : pnpbs_placement_adjacency_size(p, &entries)) != PNPBS_OK;
  if (entries != offsets[nodes] - 1) return 1;
  list = room(entries, sizeof *list);
  flags = room(entries, sizeof *flags);
  wrong += (stars ? pnpbs_placement_get_stars(p, entries, rows, list, flags)
                  : pnpbs_placement_get_adjacency(p, entries, rows, list)) != PNPBS_OK;
  wrong += shifted(nodes + 1, rows, offsets) + shifted(entries, list, neighbours);
  wrong += stars && memcmp(flags, triangle, (size_t)entries) != 0;
  free(rows), free(list), free(flags);
  return wrong;
}

int64_t twin_triangles(int64_t handle, int64_t n, const int64_t* triangles) {
  int64_t *corners = room(3 * n, sizeof *corners), count = -1, wrong = 0;
  wrong += pnpbs_placement_get_triangles(placement_of(handle), n, &count, corners) != PNPBS_OK;
  wrong += count != n;
  wrong += shifted(3 * n, corners, triangles);
  free(corners);
  return wrong;
}

int64_t twin_edges(int64_t handle, int64_t n, const int64_t* edges, const int32_t* tags) {
  int64_t *ends = room(2 * n, sizeof *ends), count = -1, wrong = 0;
  int32_t* t = room(n, sizeof *t);
  wrong += pnpbs_placement_get_boundary_edges(placement_of(handle), n, &count, ends, t) != PNPBS_OK;
  wrong += count != n;
  wrong += shifted(2 * n, ends, edges) + (memcmp(t, tags, (size_t)n * sizeof *t) != 0);
  free(ends), free(t);
  return wrong;
}

int64_t twin_tetrahedra(int64_t handle, int64_t n, const int64_t* tetrahedra) {
  int64_t *corners = room(4 * n, sizeof *corners), count = -1, wrong = 0;
  wrong += pnpbs_placement_get_tetrahedra(placement_of(handle), n, &count, corners) != PNPBS_OK;
  wrong += count != n;
  wrong += shifted(4 * n, corners, tetrahedra);
  free(corners);
  return wrong;
}

int64_t twin_incident_elements(int64_t handle, int64_t n, int32_t corners,
                               const int64_t* elements) {
  int64_t *found = room(corners * n, sizeof *found), count = -1, wrong = 0;
  int32_t of_each = 0;
  wrong += pnpbs_placement_get_incident_elements(placement_of(handle), n, &count, &of_each,
                                                 found) != PNPBS_OK;
  wrong += count != n || of_each != corners;
  wrong += shifted(corners * n, found, elements);
  free(found);
  return wrong;
}

int64_t twin_boundary_triangles(int64_t handle, int64_t n, const int64_t* triangles,
                                const int32_t* tags) {
  int64_t *corners = room(3 * n, sizeof *corners), count = -1, wrong = 0;
  int32_t* t = room(n, sizeof *t);
  wrong += pnpbs_placement_get_boundary_triangles(placement_of(handle), n, &count, corners, t) !=
           PNPBS_OK;
  wrong += count != n;
  wrong += shifted(3 * n, corners, triangles) + (memcmp(t, tags, (size_t)n * sizeof *t) != 0);
  free(corners), free(t);
  return wrong;
}

int64_t twin_exchange(int64_t handle, int32_t neighbours, const int32_t* ranks,
                      const int64_t* send_offsets, const int64_t* send_nodes,
                      const int64_t* receive_offsets, const int64_t* receive_nodes) {
  const pnpbs_placement p = placement_of(handle);
  int32_t count = -1, *r = room(neighbours, sizeof *r);
  int64_t sends = -1, receives = -1, wrong = 0, *so, *sn, *ro, *rn;
  wrong += pnpbs_placement_exchange_sizes(p, &count, &sends, &receives) != PNPBS_OK;
  wrong += count != neighbours;
  so = room(neighbours, sizeof *so), ro = room(neighbours, sizeof *ro);
  sn = room(sends, sizeof *sn), rn = room(receives, sizeof *rn);
  wrong += pnpbs_placement_get_exchange(p, count, sends, receives, r, so, sn, ro, rn) != PNPBS_OK;
  wrong += memcmp(r, ranks, (size_t)count * sizeof *r) != 0;
  wrong += shifted(count + 1, so, send_offsets) + shifted(count + 1, ro, receive_offsets);
  wrong += shifted(sends, sn, send_nodes) + shifted(receives, rn, receive_nodes);
  free(r), free(so), free(sn), free(ro), free(rn);
  return wrong;
}

int64_t twin_mesh_nodes(int64_t handle, int64_t n, const double* xyz, const int64_t* numbers,
                        const int64_t* ids, const int32_t* owners, const int32_t* tags) {
  const pnpbs_mesh mesh = mesh_of(handle);
  int32_t dim = 0, *o = room(n, sizeof *o), *t = room(n, sizeof *t);
  int64_t nodes = -1, wrong = 0, *m = room(n, sizeof *m), *i = room(n, sizeof *i);
  double* x;
  wrong += pnpbs_mesh_sizes(mesh, &dim, NULL, NULL, &nodes, NULL, NULL, NULL) != PNPBS_OK;
  x = room(dim * n, sizeof *x);
  wrong += nodes != n || pnpbs_mesh_get_nodes(mesh, n, x, m, i, o, t) != PNPBS_OK;
  wrong += memcmp(x, xyz, (size_t)(dim * n) * sizeof *x) != 0;
  wrong += memcmp(m, numbers, (size_t)n * sizeof *m) != 0;
  wrong += memcmp(i, ids, (size_t)n * sizeof *i) != 0;
  wrong += memcmp(o, owners, (size_t)n * sizeof *o) != 0;
  wrong += memcmp(t, tags, (size_t)n * sizeof *t) != 0;
  free(x), free(m), free(i), free(o), free(t);
  return wrong;
}

int64_t twin_mesh_elements(int64_t handle, int64_t n, const int32_t* nodes, const int64_t* numbers,
                           const int32_t* owners, const int32_t* tags, const int64_t* at_corners) {
  const pnpbs_mesh mesh = mesh_of(handle);
  int32_t corners = 0, *o = room(n, sizeof *o), *t = room(n, sizeof *t), *at;
  int64_t elements = -1, wrong = 0, *m = room(n, sizeof *m), *a;
  wrong += pnpbs_mesh_sizes(mesh, NULL, &corners, NULL, NULL, NULL, &elements, NULL) != PNPBS_OK;
  at = room(corners * n, sizeof *at), a = room(corners * n, sizeof *a);
  wrong += elements != n || pnpbs_mesh_get_elements(mesh, n, at, m, o, t) != PNPBS_OK;
  wrong += pnpbs_mesh_get_connectivity(mesh, n, a) != PNPBS_OK;
  wrong += shifted_short(corners * n, at, nodes);
  wrong += memcmp(m, numbers, (size_t)n * sizeof *m) != 0;
  wrong += memcmp(o, owners, (size_t)n * sizeof *o) != 0;
  wrong += memcmp(t, tags, (size_t)n * sizeof *t) != 0;
  wrong += memcmp(a, at_corners, (size_t)(corners * n) * sizeof *a) != 0;
  free(at), free(a), free(m), free(o), free(t);
  return wrong;
}

int64_t twin_mesh_facets(int64_t handle, int64_t n, const int32_t* nodes, const int32_t* tags,
                         const int32_t* elements, const int32_t* opposite, const int8_t* inner,
                         const int32_t* owners) {
  const pnpbs_mesh mesh = mesh_of(handle);
  int32_t corners = 1, *e = room(2 * n, sizeof *e), *p = room(n, sizeof *p), *at;
  int32_t *o = room(n, sizeof *o), *t = room(n, sizeof *t);
  int8_t* i = room(n, sizeof *i);
  int64_t facets = -1, wrong = 0;
  wrong += pnpbs_mesh_sizes(mesh, NULL, &corners, NULL, NULL, NULL, NULL, &facets) != PNPBS_OK;
  at = room((corners - 1) * n, sizeof *at);
  wrong += facets != n || pnpbs_mesh_get_facets(mesh, n, at, t, e, p, i, o) != PNPBS_OK;
  wrong += shifted_short((corners - 1) * n, at, nodes) + shifted_short(2 * n, e, elements);
  wrong += shifted_short(n, p, opposite);
  wrong += memcmp(t, tags, (size_t)n * sizeof *t) != 0;
  wrong += memcmp(i, inner, (size_t)n * sizeof *i) != 0;
  wrong += memcmp(o, owners, (size_t)n * sizeof *o) != 0;
  free(at), free(e), free(p), free(o), free(t), free(i);
  return wrong;
}

int64_t twin_mesh_sharing(int64_t handle, int64_t nodes, int64_t entries, const int32_t* shared,
                          const int64_t* offsets, const int32_t* ranks) {
  const pnpbs_mesh mesh = mesh_of(handle);
  int32_t *s = room(nodes, sizeof *s), *r = room(entries, sizeof *r);
  int64_t n = -1, all = -1, wrong = 0, *o = room(nodes, sizeof *o);
  wrong += pnpbs_mesh_sharing_sizes(mesh, &n, &all) != PNPBS_OK || n != nodes || all != entries;
  wrong += pnpbs_mesh_get_sharing(mesh, nodes, entries, s, o, r) != PNPBS_OK;
  wrong += shifted_short(nodes, s, shared) + shifted(nodes + 1, o, offsets);
  wrong += memcmp(r, ranks, (size_t)entries * sizeof *r) != 0;
  free(s), free(r), free(o);
  return wrong;
}

int64_t twin_segments(int64_t handle, int64_t n, const double* segments, const int32_t* tags) {
  const pnpbs_domain domain = (pnpbs_domain)(intptr_t)handle;
  double* s = room(4 * n, sizeof *s);
  int32_t* t = room(n, sizeof *t);
  int64_t count = -1, wrong = 0;
  wrong += pnpbs_domain_get_segments(domain, n, &count, s, t) != PNPBS_OK || count != n;
  wrong += memcmp(s, segments, (size_t)n * 4 * sizeof *s) != 0;
  wrong += memcmp(t, tags, (size_t)n * sizeof *t) != 0;
  free(s), free(t);
  return wrong;
}
