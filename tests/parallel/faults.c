/* SPDX-License-Identifier: BSD-3-Clause
 *
 * Tests that an error on one rank is an error on every rank: no rank hangs, the message names the
 * rank, and the placement continues after the fault is removed, with the nodes of one process. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "rank_program.h"

static int bad_rank;
static char right_hash[40]; /* of the square with spacing() and no fault */

/* Expects the same status on all ranks, and that the message contains `part`. */
static void expect_error(pnpbs_status status, pnpbs_status wanted, const char* part) {
  int least, most, mine = (int)status;
  MPI_Allreduce(&mine, &least, 1, MPI_INT, MPI_MIN, MPI_COMM_WORLD);
  MPI_Allreduce(&mine, &most, 1, MPI_INT, MPI_MAX, MPI_COMM_WORLD);
  expect(least == most, "ranks disagree on the status");
  expect(status == wanted, "another status was expected");
  expect(strstr(pnpbs_last_error(context), part) != NULL, part);
}

/* Expects in addition that the message names the bad rank. */
static void expect_bad_rank(pnpbs_status status, pnpbs_status wanted, const char* part) {
  char begin[20] = "";
  if (size > 1) snprintf(begin, sizeof begin, "rank %d: ", bad_rank);
  expect_error(status, wanted, part);
  expect(strncmp(pnpbs_last_error(context), begin, strlen(begin)) == 0, begin);
}

/* Expects that every rank has the first point of the message, at its position in the text. */
static void expect_point(void) {
  double point[3] = {0, 0, 0}, x = 0, y = 0;
  int64_t begin = 0, end = 0;
  const char* message;
  expect(pnpbs_last_error_point(context, 0, point, &begin, &end) == PNPBS_OK, "a point");
  message = pnpbs_last_error(context);
  expect(sscanf(message + begin, "(%lf, %lf)", &x, &y) == 2, "its text");
  expect(point[0] == x && point[1] == y && message[end - 1] == ')', "the same point");
}

/* --- callbacks ----------------------------------------------------------------------------- */

struct fault {
  int rank, after_calls, calls;
  double value; /* value that the bad rank returns; 0: an error instead */
};

static int32_t spacing(int64_t n, int32_t dim, const double* x, double* d, void* user) {
  struct fault* fault = user;
  int64_t i;
  for (i = 0; i < n; ++i) d[i] = 0.04 + 0.04 * x[dim * i];
  if (rank != fault->rank || fault->calls++ < fault->after_calls) return 0;
  if (fault->value == 0) return 7;
  if (n > 0) d[n / 2] = fault->value;
  return 0;
}

static struct fault no_fault = {-1, 0, 0, 0};

static pnpbs_placement placement_on(pnpbs_domain domain) {
  pnpbs_placement placement = NULL;
  expect(pnpbs_placement_create(context, domain, &placement) == PNPBS_OK, "placement");
  pnpbs_placement_set_int64(placement, "steps", 60);
  pnpbs_domain_destroy(&domain);
  return placement;
}

static pnpbs_placement square_placement(double side) {
  const double corners[] = {0, 0, side, 0, side, 1, 0, 1};
  pnpbs_domain domain;
  expect(pnpbs_domain_create(context, 2, &domain) == PNPBS_OK, "domain");
  expect(pnpbs_domain_add_polyline(domain, PNPBS_BOUNDARY, 1, 4, corners, NULL, 0) == PNPBS_OK,
         "square");
  return placement_on(domain);
}

static void expect_right_nodes(pnpbs_placement placement, const char* what) {
  const char* hash = "";
  expect(pnpbs_placement_run(placement) >= 0, what);
  expect(pnpbs_placement_get_string(placement, "hash", &hash) == PNPBS_OK, "hash");
  expect(strcmp(hash, right_hash) == 0, what);
}

/* Computes the hash of the nodes that one process places. */
static void find_right_hash(void) {
  pnpbs_context all = context;
  pnpbs_placement placement;
  const char* hash = "";
  expect(pnpbs_context_create_serial(&context) == PNPBS_OK, "serial context");
  placement = square_placement(1);
  pnpbs_placement_set_spacing_callback(placement, spacing, &no_fault);
  expect(pnpbs_placement_run(placement) >= 0, "serial run");
  expect(pnpbs_placement_get_string(placement, "hash", &hash) == PNPBS_OK, "serial hash");
  snprintf(right_hash, sizeof right_hash, "%s", hash);
  pnpbs_placement_destroy(&placement);
  pnpbs_context_destroy(&context);
  context = all;
}

/* Makes a callback fail in its n-th call, for increasing n until all calls succeed. */
static void failing_callbacks(double value, pnpbs_status wanted, const char* part) {
  int after, ended = 0;
  for (after = 0; !ended && after < 200; after += 1 + after / 4) {
    struct fault fault = {0, 0, 0, 0};
    pnpbs_placement placement = square_placement(1);
    pnpbs_status status;
    fault.rank = bad_rank;
    fault.after_calls = after;
    fault.value = value;
    expect(pnpbs_placement_set_spacing_callback(placement, spacing, &fault) == PNPBS_OK,
           "callback");
    status = pnpbs_placement_run(placement);
    ended = fault.calls <= after;
    MPI_Bcast(&ended, 1, MPI_INT, bad_rank, MPI_COMM_WORLD);
    if (!ended) expect_bad_rank(status, wanted, part);
    if (!ended && wanted == PNPBS_ERROR_SPACING) expect_point();
    if (!ended && after % 3 == 0) {
      pnpbs_placement_set_spacing_callback(placement, spacing, &no_fault);
      expect(pnpbs_placement_run(placement) >= 0, "mended, it goes on");
    }
    pnpbs_placement_destroy(&placement);
  }
  expect(after > 10, "calls to fail in");
}

static int32_t curve(int64_t n, int32_t dim, const double* t, double* xy, void* user) {
  (void)dim;
  const struct fault* fault = user;
  int64_t i;
  for (i = 0; i < n; ++i) {
    xy[2 * i] = cos(t[i]);
    xy[2 * i + 1] = sin(t[i]);
  }
  if (rank == fault->rank && fault->value != 0 && n > 0) xy[n] = fault->value;
  return rank == fault->rank && fault->value == 0 ? 3 : 0;
}

static void failing_curve(void) {
  struct fault fault = {-1, 0, 0, 0};
  pnpbs_domain domain;
  pnpbs_placement placement;
  pnpbs_domain_create(context, 2, &domain);
  expect(pnpbs_domain_add_curve(domain, PNPBS_BOUNDARY, curve, &fault, 0, 2 * acos(-1.0), 1) ==
             PNPBS_OK,
         "curve");
  placement = placement_on(domain);
  pnpbs_placement_set_spacing_constant(placement, 0.2);
  fault.rank = bad_rank;
  expect_bad_rank(pnpbs_placement_run(placement), PNPBS_ERROR_CALLBACK, "curve");
  fault.rank = -1;
  expect(pnpbs_placement_run(placement) >= 0, "run after the curve's fault");
  pnpbs_placement_destroy(&placement);
}

/* --- a stop asked for on one rank ---------------------------------------------------------- */

static int32_t stop_on_bad_rank(double fraction, int64_t step, int64_t nodes, double speed,
                                void* user) {
  (void)fraction, (void)step, (void)nodes, (void)speed, (void)user;
  return rank == bad_rank;
}

static void stops(void) {
  pnpbs_placement placement = square_placement(1);
  pnpbs_placement_set_spacing_callback(placement, spacing, &no_fault);
  expect(pnpbs_placement_set_monitor(placement, stop_on_bad_rank, NULL) == PNPBS_OK, "monitor");
  expect(pnpbs_placement_run(placement) == PNPBS_STOPPED, "a run stopped by one rank");
  expect(pnpbs_placement_step(placement, 1000) == PNPBS_STOPPED, "steps stopped by one rank");
  pnpbs_placement_set_monitor(placement, NULL, NULL);
  expect(pnpbs_placement_run(placement) >= 0, "run after the stops");
  pnpbs_placement_destroy(&placement);
}

/* --- ranks that pass different arguments ----------------------------------------------------- */

static void different_input(void) {
  const double one[] = {1}, bad[] = {NAN}, origin[] = {0, 0}, step[] = {1, 1},
               bad_point[] = {INFINITY, 0};
  const int64_t grid[] = {1, 1};
  const int is_bad = rank == bad_rank;
  pnpbs_placement placement = square_placement(1);

  /* An invalid spacing on one rank leaves the spacing unset on all ranks. */
  expect_bad_rank(pnpbs_placement_set_spacing_constant(placement, is_bad ? -1 : 0.05),
                  PNPBS_ERROR_SPACING, "-1");
  expect_bad_rank(
      pnpbs_placement_set_spacing_grid(placement, grid, origin, step, is_bad ? bad : one),
      PNPBS_ERROR_SPACING, "values[0][0]");
  expect_error(pnpbs_placement_run(placement), PNPBS_ERROR_STATE, "no spacing");
  expect_bad_rank(
      pnpbs_placement_set_spacing_callback(placement, is_bad ? NULL : spacing, &no_fault),
      PNPBS_ERROR_ARGUMENT, "spacing");

  pnpbs_placement_set_spacing_constant(placement, 0.05);
  expect_bad_rank(pnpbs_placement_step(placement, is_bad ? -1 : 1), PNPBS_ERROR_ARGUMENT, "n = -1");
  if (size > 1) {
    pnpbs_placement_set_int64(placement, "steps", is_bad ? 40 : 60);
    expect_error(pnpbs_placement_run(placement), PNPBS_ERROR_ARGUMENT, "options differ");
    expect_error(pnpbs_placement_initialise(placement), PNPBS_ERROR_ARGUMENT, "options differ");
    pnpbs_placement_set_int64(placement, "steps", 60);
    expect_error(pnpbs_placement_step(placement, is_bad ? 5 : 6), PNPBS_ERROR_ARGUMENT,
                 "differs between ranks");
    expect(pnpbs_placement_run(placement) >= 0, "run with the same options");
    pnpbs_placement_set_int64(placement, "exchange_interval", is_bad ? 1 : 2);
    expect_error(pnpbs_placement_run(placement), PNPBS_ERROR_ARGUMENT, "options differ");
    pnpbs_placement_set_int64(placement, "exchange_interval", 2);
    pnpbs_placement_set_spacing_constant(placement, is_bad ? 0.04 : 0.05);
    expect_error(pnpbs_placement_run(placement), PNPBS_ERROR_SPACING, "differs between ranks");
    pnpbs_placement_set_spacing_callback(placement, spacing, &no_fault);
    expect(pnpbs_placement_run(placement) >= 0, "run with the same spacing");
  }
  pnpbs_placement_destroy(&placement);

  /* Arguments that one rank rejects are set on no rank. */
  placement = square_placement(1);
  pnpbs_placement_set_spacing_callback(placement, spacing, &no_fault);
  expect_bad_rank(pnpbs_placement_set_spacing_constant(placement, is_bad ? 0 : 0.05),
                  PNPBS_ERROR_SPACING, "d = 0");
  expect_bad_rank(pnpbs_placement_set_nodes(placement, 1, is_bad ? bad_point : origin, NULL),
                  PNPBS_ERROR_ARGUMENT, "coordinates[0]");
  expect_right_nodes(placement, "nodes after what was not set");
  pnpbs_placement_destroy(&placement);

  if (size == 1) return;
  placement = square_placement(is_bad ? 1 : 2);
  pnpbs_placement_set_spacing_constant(placement, 0.05);
  expect_error(pnpbs_placement_run(placement), PNPBS_ERROR_DOMAIN, "domains differ");
  pnpbs_placement_destroy(&placement);
}

/* Returns a placement in a square with a triangle in it and a fixed node. */
static pnpbs_placement marked_placement(int32_t role, int32_t vertex_tag, int32_t fixed_tag) {
  const double corners[] = {0, 0, 1, 0, 1, 1, 0, 1}, fixed[] = {0.75, 0.75};
  const double inner[] = {0.2, 0.2, 0.5, 0.2, 0.2, 0.5};
  const int64_t ends[] = {0, 1, 1, 2, 2, 3, 3, 0};
  const int32_t tags[] = {0, vertex_tag, 0, 0};
  pnpbs_domain domain;
  pnpbs_placement placement;
  expect(pnpbs_domain_create(context, 2, &domain) == PNPBS_OK, "domain");
  if (vertex_tag != 0)
    pnpbs_domain_add_pslg(domain, 4, corners, tags, 4, ends, NULL, 0, NULL);
  else {
    pnpbs_domain_add_polyline(domain, PNPBS_BOUNDARY, 1, 4, corners, NULL, 0);
    pnpbs_domain_add_polyline(domain, role, 1, 3, inner, NULL, 0);
    pnpbs_domain_add_fixed_nodes(domain, 1, fixed, &fixed_tag);
  }
  placement = placement_on(domain);
  pnpbs_placement_set_spacing_constant(placement, 0.05);
  return placement;
}

/* Checks that input that differs between ranks is an error, and that no rank hangs. */
static void different_marks_and_keys(void) {
  const int is_bad = rank == bad_rank;
  int64_t value;
  double real;
  const char* text;
  pnpbs_placement placement;
  if (size > 1) {
    placement = marked_placement(is_bad ? PNPBS_BOUNDARY : PNPBS_INNER, 0, 5);
    expect_error(pnpbs_placement_run(placement), PNPBS_ERROR_DOMAIN, "domains differ");
    pnpbs_placement_destroy(&placement);
    placement = marked_placement(PNPBS_INNER, 0, is_bad ? 6 : 5);
    expect_error(pnpbs_placement_run(placement), PNPBS_ERROR_DOMAIN, "domains differ");
    pnpbs_placement_destroy(&placement);
    placement = marked_placement(PNPBS_INNER, is_bad ? 6 : 5, 0);
    expect_error(pnpbs_placement_run(placement), PNPBS_ERROR_DOMAIN, "domains differ");
    pnpbs_placement_destroy(&placement);
  }
  placement = marked_placement(PNPBS_INNER, 0, 5);
  expect(pnpbs_placement_run(placement) >= 0, "run with the same marks");
  expect(pnpbs_placement_check(placement) == PNPBS_OK, "the results are right");
  expect_bad_rank(pnpbs_placement_get_int64(placement, is_bad ? "nodos" : "nodes", &value),
                  PNPBS_ERROR_KEY, "nodos");
  expect_bad_rank(pnpbs_placement_get_double(placement, is_bad ? "hash" : "d_error.mean", &real),
                  PNPBS_ERROR_KEY, "hash");
  expect_bad_rank(pnpbs_placement_get_string(placement, is_bad ? NULL : "hash", &text),
                  PNPBS_ERROR_ARGUMENT, "key");
  if (size > 1)
    expect_error(pnpbs_placement_get_int64(placement, is_bad ? "steps" : "nodes", &value),
                 PNPBS_ERROR_ARGUMENT, "differs between ranks");
  expect(pnpbs_placement_get_int64(placement, "nodes", &value) == PNPBS_OK, "nodes");
  pnpbs_placement_destroy(&placement);
}

static void bad_domain(void) {
  const double bow_tie[] = {0, 0, 1, 1, 1, 0, 0, 1}, square[] = {0, 0, 1, 0, 1, 1, 0, 1};
  pnpbs_domain domain;
  pnpbs_placement placement;
  pnpbs_domain_create(context, 2, &domain);
  pnpbs_domain_add_polyline(domain, PNPBS_BOUNDARY, 1, 4, rank == bad_rank ? bow_tie : square, NULL,
                            0);
  placement = placement_on(domain);
  pnpbs_placement_set_spacing_constant(placement, 0.1);
  expect_bad_rank(pnpbs_placement_run(placement), PNPBS_ERROR_DOMAIN, "");
  pnpbs_placement_destroy(&placement);
}

static void bad_extraction(void) {
  const int is_bad = rank == bad_rank;
  int64_t count = 0, entries = 0, nodes = 0, *offsets, *neighbours;
  pnpbs_placement placement = square_placement(1);
  expect_error(pnpbs_placement_ghost_count(placement, &count), PNPBS_ERROR_STATE, "no nodes");
  pnpbs_placement_set_spacing_callback(placement, spacing, &no_fault);
  expect(pnpbs_placement_run(placement) >= 0, "run");
  expect_bad_rank(pnpbs_placement_ghost_count(placement, is_bad ? NULL : &count),
                  PNPBS_ERROR_ARGUMENT, "ghosts");
  expect(pnpbs_placement_ghost_count(placement, &count) == PNPBS_OK, "ghosts after the fault");
  expect_bad_rank(
      pnpbs_placement_get_ghosts(placement, is_bad ? -1 : count, NULL, NULL, NULL, NULL, NULL),
      PNPBS_ERROR_ARGUMENT, "capacity");
  expect(pnpbs_placement_adjacency_size(placement, &entries) == PNPBS_OK, "entries");
  expect(pnpbs_placement_count(placement, &nodes) == PNPBS_OK, "count");
  offsets = malloc(((size_t)nodes + 1) * sizeof *offsets);
  neighbours = malloc(((size_t)entries + 1) * sizeof *neighbours);
  expect_bad_rank(
      pnpbs_placement_get_adjacency(placement, entries, is_bad ? NULL : offsets, neighbours),
      PNPBS_ERROR_ARGUMENT, "offsets");
  expect(pnpbs_placement_get_adjacency(placement, entries, offsets, neighbours) == PNPBS_OK,
         "adjacency after the faults");
  free(offsets), free(neighbours);
  pnpbs_placement_destroy(&placement);
}

/* --- the user's own messages on the parent communicator ------------------------------------ */

#define MOST_MESSAGES 64
struct traffic {
  int sent;
  int out[MOST_MESSAGES], in[MOST_MESSAGES];
  MPI_Request requests[2 * MOST_MESSAGES];
};

/* Sends a message to the next rank in the middle of a run and receives from any source. The tags
 * include some that the library uses. */
static int32_t send_something(double fraction, int64_t step, int64_t nodes, double speed,
                              void* user) {
  struct traffic* t = user;
  const int k = t->sent;
  (void)fraction, (void)step, (void)nodes, (void)speed;
  if (k == MOST_MESSAGES) return 0;
  t->out[k] = 1000 * rank + k;
  t->in[k] = -1;
  MPI_Irecv(&t->in[k], 1, MPI_INT, MPI_ANY_SOURCE, MPI_ANY_TAG, MPI_COMM_WORLD,
            &t->requests[2 * k]);
  MPI_Isend(&t->out[k], 1, MPI_INT, (rank + 1) % size, k % 5, MPI_COMM_WORLD,
            &t->requests[2 * k + 1]);
  ++t->sent;
  return 0;
}

static void traffic_beside_ours(void) {
  static struct traffic t;
  pnpbs_placement placement = square_placement(1);
  int k;
  t.sent = 0;
  send_something(0, 0, 0, 0, &t); /* a message in flight when the run begins */
  pnpbs_placement_set_spacing_callback(placement, spacing, &no_fault);
  pnpbs_placement_set_monitor(placement, send_something, &t);
  expect_right_nodes(placement, "nodes beside the user's traffic");
  MPI_Waitall(2 * t.sent, t.requests, MPI_STATUSES_IGNORE);
  expect(t.sent > 2, "messages sent");
  for (k = 0; k < t.sent; ++k)
    expect(t.in[k] == 1000 * ((rank + size - 1) % size) + k, "the user's message came through");
  pnpbs_placement_destroy(&placement);
}

/* --- contexts ------------------------------------------------------------------------------ */

static void no_communicator(pnpbs_status status, const char* part) {
  expect(status == PNPBS_ERROR_MPI, part);
  expect(context == NULL, "no context");
  expect(strstr(pnpbs_last_error(NULL), part) != NULL, part);
}

static void communicators(void) {
  const int32_t world = (int32_t)MPI_Comm_c2f(MPI_COMM_WORLD);
  char library[MPI_MAX_LIBRARY_VERSION_STRING + 20] = "";
  int length;
  no_communicator(pnpbs_context_create_mpi(MPI_COMM_NULL, &context), "MPI_COMM_NULL");
  no_communicator(
      pnpbs_context_create_checked_f(world, "MPICH Version:      4.0.2\nmore", &context),
      "another MPI library, \"MPICH Version:      4.0.2\"");
  no_communicator(pnpbs_context_create_checked_f(world, "Open MPI v9.9.9, package: x", &context),
                  "Open MPI v9.9.9");
  no_communicator(pnpbs_context_create_checked_f(world, "", &context), "another MPI library");
  expect(pnpbs_context_create_checked_f(world, NULL, &context) == PNPBS_ERROR_ARGUMENT,
         "no library's name");
  MPI_Get_library_version(library, &length);
  strcat(library, "  \n"); /* padded as in Fortran */
  expect(pnpbs_context_create_checked_f(world, library, &context) == PNPBS_OK, "our own MPI");
  expect(pnpbs_context_destroy(&context) == PNPBS_OK, "destroyed");
}

int main(int argc, char** argv) {
  pnpbs_placement placement;
  int all;
  no_communicator(pnpbs_context_create_mpi(MPI_COMM_WORLD, &context), "not initialised");
  no_communicator(pnpbs_context_create_f(0, &context), "not initialised");
  MPI_Init(&argc, &argv);
  MPI_Comm_rank(MPI_COMM_WORLD, &rank);
  MPI_Comm_size(MPI_COMM_WORLD, &size);
  communicators();

  expect(pnpbs_context_create_mpi(MPI_COMM_WORLD, &context) == PNPBS_OK, "context");
  find_right_hash();
  for (bad_rank = 0; bad_rank<size; bad_rank += size - 1> 0 ? size - 1 : 1) {
    failing_callbacks(0, PNPBS_ERROR_CALLBACK, "returned 7");
    failing_callbacks(NAN, PNPBS_ERROR_SPACING, "not finite");
    failing_curve();
    stops();
    different_input();
    different_marks_and_keys();
    bad_domain();
    bad_extraction();
  }
  traffic_beside_ours();

  /* The context can still be used after an error, and can be destroyed. */
  bad_rank = size / 2;
  placement = square_placement(1);
  pnpbs_placement_set_spacing_callback(placement, spacing, &no_fault);
  expect_right_nodes(placement, "nodes after all faults");
  expect_bad_rank(pnpbs_placement_step(placement, rank == bad_rank ? -1 : 1), PNPBS_ERROR_ARGUMENT,
                  "n = -1");
  MPI_Allreduce(&failures, &all, 1, MPI_INT, MPI_SUM, MPI_COMM_WORLD);
  MPI_Finalize();

  failures = 0;
  expect(pnpbs_placement_run(placement) == PNPBS_ERROR_MPI, "run after MPI_Finalize");
  expect(pnpbs_placement_rebalance(placement) == PNPBS_ERROR_MPI, "rebalance after MPI_Finalize");
  expect(strstr(pnpbs_last_error(context), "already finalised") != NULL, "the reason");
  pnpbs_context_destroy(&context);
  pnpbs_placement_destroy(&placement);
  no_communicator(pnpbs_context_create_mpi(MPI_COMM_WORLD, &context), "already finalised");
  no_communicator(pnpbs_context_create_f(0, &context), "already finalised");
  if (rank == 0) printf("%d failed\n", all + failures);
  return all + failures != 0;
}
