/* SPDX-License-Identifier: BSD-3-Clause
 *
 * Tests that the exchange pattern transfers values from nodes to their ghosts with plain MPI, as a
 * solver uses it; that numbers are contiguous per rank; and that a request for ghosts does not
 * change local indices. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "rank_program.h"

static void* array(int64_t n, size_t of) { return calloc((size_t)n + 1, of); }

static int32_t graded(int64_t n, int32_t dim, const double* x, double* d, void* user) {
  int64_t i;
  (void)user;
  for (i = 0; i < n; ++i) d[i] = 0.02 + 0.05 * hypot(x[dim * i] - 0.3, x[dim * i + 1] - 0.4);
  return 0;
}

struct pattern {
  int32_t neighbours;
  int64_t sends, receives;
  int32_t* ranks;
  int64_t *send_offsets, *send_nodes, *receive_offsets, *receive_nodes;
};

static struct pattern get_pattern(pnpbs_placement placement) {
  struct pattern p;
  expect(
      pnpbs_placement_exchange_sizes(placement, &p.neighbours, &p.sends, &p.receives) == PNPBS_OK,
      "sizes");
  p.ranks = array(p.neighbours, sizeof *p.ranks);
  p.send_offsets = array(p.neighbours, sizeof(int64_t));
  p.receive_offsets = array(p.neighbours, sizeof(int64_t));
  p.send_nodes = array(p.sends, sizeof(int64_t));
  p.receive_nodes = array(p.receives, sizeof(int64_t));
  expect(pnpbs_placement_get_exchange(placement, p.neighbours, p.sends, p.receives, p.ranks,
                                      p.send_offsets, p.send_nodes, p.receive_offsets,
                                      p.receive_nodes) == PNPBS_OK,
         "pattern");
  return p;
}

static void free_pattern(struct pattern* p) {
  free(p->ranks), free(p->send_offsets), free(p->receive_offsets);
  free(p->send_nodes), free(p->receive_nodes);
}

/* Exchanges `width` doubles per node: ghosts receive the values of their owners. */
static void exchange(const struct pattern* p, double* values, int width) {
  double* out = array(p->sends * width, sizeof(double));
  double* in = array(p->receives * width, sizeof(double));
  MPI_Request* requests = array(2 * p->neighbours, sizeof(MPI_Request));
  int64_t s, k;
  for (s = 0; s < p->sends; ++s)
    memcpy(out + s * width, values + p->send_nodes[s] * width, (size_t)width * sizeof(double));
  for (k = 0; k < p->neighbours; ++k) {
    const int64_t to = p->send_offsets[k], from = p->receive_offsets[k];
    MPI_Irecv(in + from * width, (int)((p->receive_offsets[k + 1] - from) * width), MPI_DOUBLE,
              p->ranks[k], 5, group, &requests[2 * k]);
    MPI_Isend(out + to * width, (int)((p->send_offsets[k + 1] - to) * width), MPI_DOUBLE,
              p->ranks[k], 5, group, &requests[2 * k + 1]);
  }
  MPI_Waitall(2 * p->neighbours, requests, MPI_STATUSES_IGNORE);
  for (s = 0; s < p->receives; ++s)
    memcpy(values + p->receive_nodes[s] * width, in + s * width, (size_t)width * sizeof(double));
  free(out), free(in), free(requests);
}

/* Expects that the neighbour relation is symmetric. Otherwise the messages of the solver would wait
 * forever. */
static void expect_symmetric(const struct pattern* p) {
  int *named = array(size, sizeof(int)), *names_us = array(size, sizeof(int)), r;
  for (r = 0; r < p->neighbours; ++r) named[p->ranks[r]] = 1;
  MPI_Alltoall(named, 1, MPI_INT, names_us, 1, MPI_INT, group);
  expect(memcmp(named, names_us, (size_t)size * sizeof(int)) == 0, "neighbours name each other");
  expect(!named[rank], "no rank is its own neighbour");
  free(named), free(names_us);
}

static void check(pnpbs_placement placement) {
  int64_t nodes, again, ghosts, i, first, count, before = 0, all;
  int64_t *ids, *ids_again, *ghost_ids, *ghost_numbers;
  int32_t* owners;
  double *xy, *ghost_xy, *values;
  struct pattern p;
  pnpbs_placement_count(placement, &nodes);
  ids = array(nodes, sizeof(int64_t));
  expect(pnpbs_placement_get_nodes(placement, nodes, NULL, ids, NULL, NULL) == PNPBS_OK, "nodes");
  expect(pnpbs_placement_ghost_count(placement, &ghosts) == PNPBS_OK, "ghost count");

  /* A request for ghosts must not change local indices. */
  pnpbs_placement_count(placement, &again);
  expect(again == nodes, "asking for ghosts moved nodes to other ranks");
  if (again != nodes) return;
  ids_again = array(nodes, sizeof(int64_t));
  xy = array(2 * nodes, sizeof(double));
  pnpbs_placement_get_nodes(placement, nodes, xy, ids_again, NULL, NULL);
  expect(memcmp(ids, ids_again, (size_t)nodes * sizeof(int64_t)) == 0, "order of nodes");

  ghost_ids = array(ghosts, sizeof(int64_t));
  ghost_numbers = array(ghosts, sizeof(int64_t));
  owners = array(ghosts, sizeof(int32_t));
  ghost_xy = array(2 * ghosts, sizeof(double));
  expect(pnpbs_placement_get_ghosts(placement, ghosts, ghost_xy, ghost_ids, NULL, NULL, owners) ==
             PNPBS_OK,
         "ghosts");
  expect(
      pnpbs_placement_get_numbering(placement, ghosts, &first, &count, ghost_numbers) == PNPBS_OK,
      "numbering");
  MPI_Exscan(&nodes, &before, 1, MPI_INT64_T, MPI_SUM, group);
  expect(count == nodes && first == (rank > 0 ? before : 0), "a range of numbers for each rank");

  p = get_pattern(placement);
  expect_symmetric(&p);
  expect(p.receives == ghosts, "every ghost is received once");

  /* Each ghost must receive the position, id, number and rank of its owned node. */
  values = array(5 * (nodes + ghosts), sizeof(double));
  for (i = 0; i < nodes; ++i) {
    values[5 * i] = xy[2 * i];
    values[5 * i + 1] = xy[2 * i + 1];
    values[5 * i + 2] = (double)ids[i];
    values[5 * i + 3] = (double)(first + i);
    values[5 * i + 4] = rank;
  }
  for (i = 5 * nodes; i < 5 * (nodes + ghosts); ++i) values[i] = -1;
  exchange(&p, values, 5);
  for (i = 0; i < ghosts; ++i) {
    const double* v = values + 5 * (nodes + i);
    if (v[0] == ghost_xy[2 * i] && v[1] == ghost_xy[2 * i + 1] && v[2] == (double)ghost_ids[i] &&
        v[3] == (double)ghost_numbers[i] && v[4] == owners[i])
      continue;
    expect(0, "a ghost got another node's values");
    break;
  }
  MPI_Allreduce(&ghosts, &all, 1, MPI_INT64_T, MPI_SUM, group);
  expect(size == 1 ? all == 0 : all > 0, "there are ghosts to test");

  if (ghosts > 0 && rank == size - 1) --p.receives; /* too small on one rank: an error on all */
  if (size > 1)
    expect(pnpbs_placement_get_exchange(placement, p.neighbours, p.sends, p.receives, NULL, NULL,
                                        NULL, NULL, NULL) == PNPBS_ERROR_CAPACITY,
           "capacity");
  free(ids), free(ids_again), free(ghost_ids), free(ghost_numbers), free(owners);
  free(xy), free(ghost_xy), free(values);
  free_pattern(&p);
}

static void check_all(void) {
  const double square[] = {0, 0, 1, 0, 1, 1, 0, 1};
  pnpbs_domain domain;
  pnpbs_placement placement;
  pnpbs_domain_create(context, 2, &domain);
  pnpbs_domain_add_polyline(domain, PNPBS_BOUNDARY, 1, 4, square, NULL, 0);
  expect(pnpbs_placement_create(context, domain, &placement) == PNPBS_OK, "placement");
  expect(pnpbs_placement_set_spacing_callback(placement, graded, NULL) == PNPBS_OK, "spacing");
  expect(pnpbs_placement_step(placement, 7) >= 0, "steps");
  check(placement);
  expect(pnpbs_placement_run(placement) >= 0, "run");
  check(placement);
  pnpbs_placement_destroy(&placement);
  pnpbs_domain_destroy(&domain);
}

int main(int argc, char** argv) { return run_in_groups(argc, argv, check_all); }
