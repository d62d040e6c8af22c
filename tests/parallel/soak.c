/* SPDX-License-Identifier: BSD-3-Clause
 *
 * Tests memory and results over time: random operations in random order, equal on all ranks by a
 * seed, with a check after each and a memory report at intervals. The program runs for hours by
 * hand and for seconds as a test:
 *
 *   soak <seconds> [seed] [most operations between reports]
 *
 * Memory is constant if the resident size of every rank in the last quarter of the time equals that
 * in the second. */
#define _GNU_SOURCE /* for mkdtemp, mallinfo2, malloc_trim */
#include <inttypes.h>
#include <malloc.h>
#include <math.h>
#include <mpi.h>
#include <pnpbs/pnpbs_mpi.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

static pnpbs_context context;
static pnpbs_domain domain;
static pnpbs_placement placement;
static int has_nodes; /* whether the placement has any */
static int rank, failures;
static int64_t operations;
static uint64_t state; /* of the random choices, equal on all ranks */

static void expect(int condition, const char* what) {
  if (condition) return;
  fprintf(stderr, "rank %d, operation %" PRId64 ": %s; last error: %s\n", rank, operations, what,
          pnpbs_last_error(context));
  if (++failures > 5) MPI_Abort(MPI_COMM_WORLD, 1);
}
#define TRY(call) expect((call) >= 0, #call)

static uint64_t choose(uint64_t n) {
  state ^= state << 13, state ^= state >> 7, state ^= state << 17; /* xorshift */
  return (state >> 11) % n;
}
static double between(double low, double high) {
  return low + (high - low) * (double)choose(1 << 20) / (1 << 20);
}

/* --- operations ----------------------------------------------------------------------------- */

static double fine, grade, centre; /* of the spacing callback; equal on all ranks */

static int32_t graded(int64_t n, int32_t dim, const double* x, double* d, void* user) {
  int64_t i;
  (void)user;
  for (i = 0; i < n; ++i) d[i] = fine + grade * hypot(x[dim * i] - centre, x[dim * i + 1]);
  return 0;
}

static void add_curves(void) {
  const double outer[] = {-1, -1, 1, -1, 1, 1, -1, 1};
  const double hole[] = {-0.3, -0.2, 0.3, -0.25, 0.1, 0.4};
  TRY(pnpbs_domain_add_polyline(domain, PNPBS_BOUNDARY, 1, 4, outer, NULL, 0));
  if (choose(2)) TRY(pnpbs_domain_add_polyline(domain, PNPBS_BOUNDARY, 1, 3, hole, NULL, 0));
}

static void new_context(void) {
  pnpbs_placement_destroy(&placement);
  pnpbs_domain_destroy(&domain);
  pnpbs_context_destroy(&context);
  TRY(pnpbs_context_create_mpi(MPI_COMM_WORLD, &context));
}

static void set_spacing(void) {
  if (choose(3) == 0) {
    TRY(pnpbs_placement_set_spacing_constant(placement, between(0.04, 0.3)));
    return;
  }
  fine = between(0.02, 0.08), grade = between(0, 0.2), centre = between(-1, 1);
  TRY(pnpbs_placement_set_spacing_callback(placement, graded, NULL));
}

static void new_placement(void) {
  pnpbs_placement_destroy(&placement);
  pnpbs_domain_destroy(&domain);
  TRY(pnpbs_domain_create(context, 2, &domain));
  add_curves();
  TRY(pnpbs_placement_create(context, domain, &placement));
  TRY(pnpbs_placement_set_int64(placement, "steps", 20 + (int64_t)choose(60)));
  TRY(pnpbs_placement_set_int64(placement, "sweeps", (int64_t)choose(6)));
  TRY(pnpbs_placement_set_int64(placement, "exchange_interval", 1 + (int64_t)choose(5)));
  set_spacing();
  has_nodes = 0;
}

static void nodal_spacing(void) {
  const double factor = between(0.8, 1.3);
  int64_t n = 0, i;
  double* d;
  TRY(pnpbs_placement_count(placement, &n));
  d = malloc(sizeof *d * ((size_t)n + 1));
  TRY(pnpbs_placement_get_nodes(placement, n, NULL, NULL, NULL, d));
  for (i = 0; i < n; ++i) d[i] = fmin(fmax(factor * d[i], 0.02), 0.4);
  TRY(pnpbs_placement_set_spacing_at_nodes(placement, n, d));
  free(d);
}

/* Passes the extracted nodes back as start nodes. */
static void given_nodes(void) {
  int64_t n = 0, *ids;
  double* xy;
  TRY(pnpbs_placement_count(placement, &n));
  xy = malloc(sizeof *xy * 2 * ((size_t)n + 1));
  ids = malloc(sizeof *ids * ((size_t)n + 1));
  TRY(pnpbs_placement_get_nodes(placement, n, xy, ids, NULL, NULL));
  TRY(pnpbs_placement_set_nodes(placement, n, xy, choose(2) ? ids : NULL));
  TRY(pnpbs_placement_initialise(placement));
  free(xy);
  free(ids);
}

static void extract(void) {
  int64_t triangles = 0, ghosts = 0, entries = 0, edges = 0, *corners;
  TRY(pnpbs_placement_ghost_count(placement, &ghosts));
  TRY(pnpbs_placement_adjacency_size(placement, &entries));
  TRY(pnpbs_placement_star_size(placement, &entries));
  TRY(pnpbs_placement_get_triangles(placement, 0, &triangles, NULL));
  corners = malloc(sizeof *corners * 3 * ((size_t)triangles + 1));
  TRY(pnpbs_placement_get_triangles(placement, triangles, &triangles, corners));
  TRY(pnpbs_placement_get_boundary_edges(placement, 0, &edges, NULL, NULL));
  free(corners);
}

static void write_files(void) {
  static const char* const paths[] = {"a.vtu", "b.pvtu", "c.msh", "d.node", "e.csv"};
  const int32_t elements[] = {1, (int32_t)choose(2), 1, 1, 0};
  TRY(pnpbs_placement_write_files(placement, 1 + (int32_t)choose(5), paths, NULL, elements));
}

static void one_operation(void) {
  const uint64_t choice = choose(40);
  ++operations;
  if (!context || choice == 0) new_context();
  if (!placement || choice < 4) new_placement();
  if (choice < 8) set_spacing();
  if (!has_nodes || choice < 14) {
    TRY(pnpbs_placement_run(placement));
    has_nodes = 1;
  } else if (choice < 18) {
    nodal_spacing();
  } else if (choice < 22) {
    TRY(pnpbs_placement_step(placement, (int64_t)choose(30)));
  } else if (choice < 25) {
    given_nodes();
  } else if (choice < 28) {
    TRY(pnpbs_placement_rebalance(placement));
  } else if (choice < 32) {
    TRY(pnpbs_placement_adjust_population(placement, NULL, NULL));
  } else if (choice < 36) {
    extract();
  } else {
    write_files();
  }
  if (has_nodes) TRY(pnpbs_placement_check(placement));
}

/* --- memory over time ------------------------------------------------------------------------ */

/* Computes the largest heap in use and the largest resident size of all ranks, in MiB. Collective.
 */
static void memory_now(double* heap, double* resident) {
  FILE* file = fopen("/proc/self/statm", "r");
  long pages[2] = {0, 0};
  double mine[2], most[2];
  const struct mallinfo2 info = mallinfo2();
  if (file) {
    if (fscanf(file, "%ld %ld", &pages[0], &pages[1]) != 2) pages[1] = 0;
    fclose(file);
  }
  mine[0] = (double)(info.uordblks + info.hblkhd) / 1048576;
  mine[1] = (double)pages[1] * (double)sysconf(_SC_PAGESIZE) / 1048576;
  MPI_Allreduce(mine, most, 2, MPI_DOUBLE, MPI_MAX, MPI_COMM_WORLD);
  *heap = most[0], *resident = most[1];
}

/* Returns the size of the heap after all objects are destroyed. */
static double empty_heap(double* resident) {
  double heap;
  pnpbs_placement_destroy(&placement);
  pnpbs_domain_destroy(&domain);
  pnpbs_context_destroy(&context);
  has_nodes = 0;
  malloc_trim(0);
  memory_now(&heap, resident);
  return heap;
}

static int time_is_up(double end) {
  int up = MPI_Wtime() > end;
  MPI_Bcast(&up, 1, MPI_INT, 0, MPI_COMM_WORLD);
  return up;
}

static void soak(double seconds, int64_t between_reports) {
  const double begin = MPI_Wtime();
  double settled = 0, heap = 0, resident = 0;
  int reports = 0, up = 0;
  while (!up) {
    int64_t k;
    for (k = 0; k < between_reports && !up; ++k) {
      one_operation();
      up = time_is_up(begin + seconds);
    }
    heap = empty_heap(&resident);
    if (rank == 0)
      printf("%6.0f s %8" PRId64 " operations; empty: heap %.2f MiB, resident %.1f MiB\n",
             MPI_Wtime() - begin, operations, heap, resident),
          fflush(stdout);
    if (++reports <= 3) settled = fmax(settled, heap); /* memory that MPI and Kokkos keep */
  }
  expect(reports <= 3 || heap < settled + 1 + 0.02 * settled, "memory grows");
}

int main(int argc, char** argv) {
  char folder[] = "/tmp/pnpbs-soak-XXXXXX", command[100];
  int all;
  MPI_Init(&argc, &argv);
  MPI_Comm_rank(MPI_COMM_WORLD, &rank);
  if (rank == 0 && !mkdtemp(folder)) MPI_Abort(MPI_COMM_WORLD, 1);
  MPI_Bcast(folder, sizeof folder, MPI_CHAR, 0, MPI_COMM_WORLD);
  expect(chdir(folder) == 0, "folder");
  state = argc > 2 ? strtoull(argv[2], NULL, 10) * 2654435761U + 1 : 88172645463325252U;
  soak(argc > 1 ? atof(argv[1]) : 5, argc > 3 ? atol(argv[3]) : 25);
  snprintf(command, sizeof command, "rm -r %s", folder);
  MPI_Barrier(MPI_COMM_WORLD);
  if (rank == 0) expect(system(command) == 0, "remove the files");
  MPI_Allreduce(&failures, &all, 1, MPI_INT, MPI_SUM, MPI_COMM_WORLD);
  if (rank == 0) printf("%d failed\n", all);
  MPI_Finalize();
  return all != 0;
}
