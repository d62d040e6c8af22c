/* SPDX-License-Identifier: BSD-3-Clause
 *
 * Measures how a placement is distributed to the ranks of MPI_COMM_WORLD. Initialises it without
 * taking a step, and prints a line of names and values, with the mean and the maximum over the
 * ranks. There may be many more ranks than cores.
 *
 * With `rebalance` the placement is partitioned again by the counted work, and `imbalance` is that
 * of the work. With `run` the nodes are placed; the output then has the time of each phase, the
 * memory, and the nodes computed over those owned (`redundancy.*`). Messages, bytes and collective
 * calls are those of initialising or placing. `computed` is the processor time outside MPI.
 * `memory.own` is the memory without the buffers in which MPI passes messages on a node.
 *
 * usage: decomposition CASE SCALE [run|rebalance] [key=value]...  with the cases of place_on_ranks
 *
 * Ends with status 1 if the figures contradict each other. */
#include <mpi.h>
#include <pnpbs/pnpbs_mpi.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/resource.h>
#include <time.h>

#include "mpi_counts.h"
#include "placement_cases.h"

/* Position and velocity; in space also the facet that the node may have moved to. */
static double bytes_per_ghost;

static const char* const phases[] = {"motion", "lists",  "exchange",   "population",
                                     "stars",  "sweeps", "conformity", "boundary",
                                     "tree",   "fill",   "spacing",    "total"};
static const char* const counted[] = {"lists", "motion", "stars", "sweeps"};

static pnpbs_context context;
static pnpbs_placement placement;
static int rank, size;

static void check(pnpbs_status status, const char* what) { case_check(context, status, what); }

static double integer(const char* key) {
  int64_t value = 0;
  check(pnpbs_placement_get_int64(placement, key, &value), key);
  return (double)value;
}

static double real(const char* key) {
  double value = 0;
  check(pnpbs_placement_get_double(placement, key, &value), key);
  return value;
}

/* Returns the processor time of this process in seconds. */
static double on_a_core_in_all(void) { return (double)clock() / CLOCKS_PER_SEC; }

/* Returns the user time of this process in seconds, without time in the system, for example for
 * yielding while it waits. */
static double on_a_core(void) {
  struct rusage usage;
  getrusage(RUSAGE_SELF, &usage);
  return (double)usage.ru_utime.tv_sec + 1e-6 * (double)usage.ru_utime.tv_usec;
}

/* Returns the bytes of shared memory that this process uses: buffers of MPI between the ranks of a
 * node, which it keeps. 0 if the system does not count them. */
static double shared_memory(void) {
  FILE* const file = fopen("/proc/self/status", "r");
  char line[256];
  long kilobytes = 0;
  if (!file) return 0;
  while (fgets(line, sizeof line, file))
    if (sscanf(line, "RssShmem: %ld", &kilobytes) == 1) break;
  fclose(file);
  return 1024.0 * (double)kilobytes;
}

static double sum_of(double mine) {
  double sum;
  MPI_Allreduce(&mine, &sum, 1, MPI_DOUBLE, MPI_SUM, MPI_COMM_WORLD);
  return sum;
}

static void tell(const char* name, double value) {
  if (rank == 0) printf("%s %.9g ", name, value);
}

static void tell_over_ranks(const char* name, double mine) {
  const double mean = sum_of(mine) / size;
  double largest;
  MPI_Allreduce(&mine, &largest, 1, MPI_DOUBLE, MPI_MAX, MPI_COMM_WORLD);
  if (rank == 0) printf("%s.mean %.9g %s.largest %.9g ", name, mean, name, largest);
}

/* Returns a statistic of a family, such as "seconds.motion". */
static double real_of(const char* family, const char* member) {
  char key[64];
  snprintf(key, sizeof key, "%s.%s", family, member);
  return real(key);
}

/* Returns whether every node is owned once, and the bytes sent equal those of the ghosts. */
static int consistent(double owned, double ghosts, double bytes) {
  const double nodes = integer("nodes"), all = sum_of(owned), sent = sum_of(bytes),
               arriving = bytes_per_ghost * sum_of(ghosts);
  if (all == nodes && sent == arriving) return 1;
  if (rank == 0)
    fprintf(stderr, "%.0f nodes, but %.0f owned; %.0f bytes sent, but ghosts of %.0f bytes\n",
            nodes, all, sent, arriving);
  return 0;
}

int main(int argc, char** argv) {
  struct case_spacing spacing;
  struct mpi_counts asked;
  int64_t count;
  double owned, ghosts, bytes, empty, shared, core_seconds, all_seconds;
  size_t p;
  int run, rebalance, first, right;
  MPI_Init(&argc, &argv);
  MPI_Comm_rank(MPI_COMM_WORLD, &rank);
  MPI_Comm_size(MPI_COMM_WORLD, &size);
  if (argc < 3) {
    if (rank == 0)
      fprintf(stderr, "usage: decomposition CASE SCALE [run|rebalance] [key=value]...\n");
    MPI_Finalize();
    return 2;
  }
  run = argc > 3 && strcmp(argv[3], "run") == 0;
  rebalance = argc > 3 && strcmp(argv[3], "rebalance") == 0;
  first = run || rebalance ? 4 : 3;
  bytes_per_ghost = case_dimension(argv[1]) == 3 ? 52 : 32;
  check(pnpbs_context_create_mpi(MPI_COMM_WORLD, &context), "context");
  placement = case_placement(context, argv[1], atof(argv[2]), argc - first, argv + first, &spacing);
  empty = integer("memory.peak_bytes");
  shared = shared_memory();
  mpi_counts = (struct mpi_counts){0, 0, 0, 0, 0};
  all_seconds = on_a_core_in_all();
  core_seconds = on_a_core();
  check(run ? pnpbs_placement_run(placement) : pnpbs_placement_initialise(placement), argv[1]);
  core_seconds = on_a_core() - core_seconds;
  all_seconds = on_a_core_in_all() - all_seconds;
  asked = mpi_counts;
  check(pnpbs_placement_count(placement, &count), "count");
  owned = (double)count;
  ghosts = integer("ghosts");
  bytes = integer("exchange.bytes");
  tell("ranks", size);
  tell("nodes", integer("nodes"));
  tell_over_ranks("owned", owned);
  tell_over_ranks("ghosts", ghosts);
  tell_over_ranks("neighbours", integer("neighbours"));
  tell_over_ranks("bytes", bytes);
  tell_over_ranks("partition", real("seconds.partition"));
  tell_over_ranks("on_a_core", core_seconds);
  tell_over_ranks("computed", all_seconds - asked.seconds); /* with one thread */
  tell_over_ranks("memory.empty", empty);
  tell_over_ranks("memory", integer("memory.peak_bytes"));
  tell_over_ranks("memory.own", integer("memory.peak_bytes") - (shared_memory() - shared));
  tell_over_ranks("messages", asked.messages);
  tell_over_ranks("sent", asked.sent);
  tell_over_ranks("collectives", asked.collectives);
  tell_over_ranks("gathered", asked.gathered);
  right = consistent(owned, ghosts, bytes);
  if (rebalance) check(pnpbs_placement_rebalance(placement), "rebalance");
  /* The work is counted from the lists, which a placement without steps does not have. */
  if (run || rebalance) tell("imbalance", real("imbalance"));
  tell("steps", integer("steps"));
  for (p = 0; p < sizeof phases / sizeof *phases; ++p)
    tell_over_ranks(phases[p], real_of("seconds", phases[p]));
  for (p = 0; run && p < sizeof counted / sizeof *counted; ++p) {
    char name[64];
    snprintf(name, sizeof name, "redundancy.%s", counted[p]);
    tell(name, real(name));
  }
  if (rank == 0) printf("\n");
  pnpbs_placement_destroy(&placement);
  pnpbs_context_destroy(&context);
  MPI_Finalize();
  return right ? 0 : 1;
}
