/* SPDX-License-Identifier: BSD-3-Clause
 *
 * Runs an adaptive sequence over the ranks of MPI_COMM_WORLD: replaced spacings on a live
 * placement, nodes given by the caller, a growth limit, and further runs. Prints one line per
 * stage, which does not depend on the number of ranks.
 * usage: adapt_on_ranks [key=value]... */
#include <math.h>
#include <mpi.h>
#include <pnpbs/pnpbs_mpi.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static pnpbs_context context;
static pnpbs_placement placement;
static int rank, size;
static int64_t inserted, deleted; /* up to the previous stage */

static void require(int condition, const char* what) {
  if (condition) return;
  fprintf(stderr, "rank %d: %s: %s\n", rank, what, pnpbs_last_error(context));
  MPI_Abort(MPI_COMM_WORLD, 1);
}

static void check(pnpbs_status status, const char* what) { require(status >= 0, what); }

static int64_t integer(const char* key) {
  int64_t value;
  check(pnpbs_placement_get_int64(placement, key, &value), key);
  return value;
}

/* Prints the stage, and requires at least this number of insertions and deletions. */
static void report(const char* stage, int64_t least_inserted, int64_t least_deleted) {
  const char* hash;
  const int64_t born = integer("inserted") - inserted, died = integer("deleted") - deleted;
  const int64_t nodes = integer("nodes"), dropped = integer("dropped");
  inserted += born;
  deleted += died;
  check(pnpbs_placement_get_string(placement, "hash", &hash), "hash");
  if (rank == 0)
    printf("%s: hash %s nodes %lld inserted %lld deleted %lld dropped %lld\n", stage, hash,
           (long long)nodes, (long long)born, (long long)died, (long long)dropped);
  require(born >= least_inserted && died >= least_deleted, "too few inserted or deleted");
}

static void run(const char* stage, int64_t least_inserted, int64_t least_deleted) {
  check(pnpbs_placement_run(placement), stage);
  report(stage, least_inserted, least_deleted);
}

/* ---------------------------------------------------------------- spacings -------------- */

struct spot {
  double x, y, least, slope, most;
};

static int32_t spot_spacing(int64_t n, int32_t dim, const double* x, double* d, void* user) {
  const struct spot* s = user;
  int64_t i;
  for (i = 0; i < n; ++i)
    d[i] = fmin(s->most, s->least + s->slope * hypot(x[dim * i] - s->x, x[dim * i + 1] - s->y));
  return 0;
}

/* Sets a grid with a ridge of fine spacing. */
static void set_grid(void) {
  enum { nx = 31, ny = 21 };
  const int64_t grid[] = {nx, ny};
  const double origin[] = {0, 0}, step[] = {2.0 / (nx - 1), 1.0 / (ny - 1)};
  double values[nx * ny];
  int i, j;
  for (j = 0; j < ny; ++j)
    for (i = 0; i < nx; ++i)
      values[j * nx + i] = 0.012 + 0.1 * fabs(i * step[0] - 0.3 - j * step[1]);
  check(pnpbs_placement_set_spacing_grid(placement, grid, origin, step, values), "grid");
}

/* ---------------------------------------------------------------- nodes from outside ---- */

/* Gives points all over the bounding box as nodes, some of them outside the domain. Every rank
 * gives every size-th point regardless of its location; with several ranks the last one gives none.
 */
static void give_scattered(int64_t n) {
  double* xy = malloc((size_t)n * 2 * sizeof *xy);
  int64_t* ids = malloc((size_t)n * sizeof *ids);
  uint64_t state = 4711;
  int64_t i, mine = 0;
  const int givers = size > 1 ? size - 1 : 1;
  require(xy != NULL && ids != NULL, "memory");
  for (i = 0; i < n; ++i) {
    double x[2];
    int k;
    for (k = 0; k < 2; ++k) {
      state = state * 6364136223846793005u + 1442695040888963407u;
      x[k] = (double)(state >> 11) * 0x1p-53;
    }
    if (i % givers != rank) continue;
    xy[2 * mine] = 2.1 * x[0] - 0.05;
    xy[2 * mine + 1] = x[1];
    ids[mine++] = 1000 + (i * 7919) % n;
  }
  check(pnpbs_placement_set_nodes(placement, mine, xy, ids), "scattered nodes");
  free(xy);
  free(ids);
}

/* Gives the current inner nodes with their ids; each rank gives those of the previous rank. */
static void give_to_next_rank(void) {
  const int next = (rank + 1) % size, previous = (rank + size - 1) % size;
  int64_t nodes, inner = 0, arriving, i;
  int64_t *ids, *their_ids;
  int32_t* tags;
  double *xy, *their_xy;
  check(pnpbs_placement_count(placement, &nodes), "count");
  xy = malloc((size_t)(nodes + 1) * 2 * sizeof *xy);
  ids = malloc((size_t)(nodes + 1) * sizeof *ids);
  tags = malloc((size_t)(nodes + 1) * sizeof *tags);
  require(xy != NULL && ids != NULL && tags != NULL, "memory");
  check(pnpbs_placement_get_nodes(placement, nodes, xy, ids, tags, NULL), "nodes");
  for (i = 0; i < nodes; ++i) {
    if (tags[i] != 0) continue;
    xy[2 * inner] = xy[2 * i];
    xy[2 * inner + 1] = xy[2 * i + 1];
    ids[inner++] = ids[i];
  }
  MPI_Sendrecv(&inner, 1, MPI_INT64_T, next, 0, &arriving, 1, MPI_INT64_T, previous, 0,
               MPI_COMM_WORLD, MPI_STATUS_IGNORE);
  their_xy = malloc((size_t)(arriving + 1) * 2 * sizeof *their_xy);
  their_ids = malloc((size_t)(arriving + 1) * sizeof *their_ids);
  require(their_xy != NULL && their_ids != NULL, "memory");
  MPI_Sendrecv(xy, (int)(2 * inner), MPI_DOUBLE, next, 1, their_xy, (int)(2 * arriving), MPI_DOUBLE,
               previous, 1, MPI_COMM_WORLD, MPI_STATUS_IGNORE);
  MPI_Sendrecv(ids, (int)inner, MPI_INT64_T, next, 2, their_ids, (int)arriving, MPI_INT64_T,
               previous, 2, MPI_COMM_WORLD, MPI_STATUS_IGNORE);
  check(pnpbs_placement_set_nodes(placement, arriving, their_xy, their_ids), "nodes of the rank");
  free(xy);
  free(ids);
  free(tags);
  free(their_xy);
  free(their_ids);
}

/* ---------------------------------------------------------------- the sequence ---------- */

static void make_placement(int argc, char** argv) {
  const double corners[] = {0, 0, 2, 0, 2, 1, 0, 1}, centre[] = {1.4, 0.4};
  pnpbs_domain domain;
  int a;
  check(pnpbs_context_create_mpi(MPI_COMM_WORLD, &context), "context");
  check(pnpbs_domain_create(context, 2, &domain), "domain");
  check(pnpbs_domain_add_polyline(domain, PNPBS_BOUNDARY, 1, 4, corners, NULL, 0), "rectangle");
  check(pnpbs_domain_add_arc(domain, PNPBS_BOUNDARY, centre, 0.15, 0, 6.283185307179586, 2),
        "hole");
  check(pnpbs_placement_create(context, domain, &placement), "placement");
  pnpbs_domain_destroy(&domain);
  for (a = 1; a < argc; ++a) {
    char* value = strchr(argv[a], '=');
    require(value != NULL, "usage: adapt_on_ranks [key=value]...");
    *value++ = 0;
    check(pnpbs_placement_set(placement, argv[a], value), argv[a]);
  }
}

int main(int argc, char** argv) {
  struct spot spot = {0.3, 0.3, 0.008, 0.12, 0.06};
  int64_t born = 0, died = 0;
  MPI_Init(&argc, &argv);
  MPI_Comm_rank(MPI_COMM_WORLD, &rank);
  MPI_Comm_size(MPI_COMM_WORLD, &size);
  make_placement(argc, argv);

  check(pnpbs_placement_set_spacing_callback(placement, spot_spacing, &spot), "spacing");
  run("spot", 0, 0);
  spot.x = 1.2;
  spot.y = 0.8;
  check(pnpbs_placement_set_spacing_callback(placement, spot_spacing, &spot), "spacing");
  run("spot elsewhere", 100, 100);
  run("run again", 0, 0);
  set_grid();
  run("grid", 200, 100);
  check(pnpbs_placement_set(placement, "growth_limit", "0.05"), "growth_limit");
  run("growth limit", 100, 0);
  check(pnpbs_placement_set(placement, "growth_limit", "0"), "growth_limit");
  check(pnpbs_placement_set_spacing_constant(placement, 0.06), "spacing");
  check(pnpbs_placement_step(placement, 25), "step");
  report("25 steps, much coarser", 0, 1000);
  check(pnpbs_placement_adjust_population(placement, &born, &died), "population");
  report("population adjusted", born, died);
  give_scattered(900);
  check(pnpbs_placement_initialise(placement), "initialise");
  report("scattered nodes", 0, 0);
  run("scattered nodes, after the run", 5, 20);
  give_scattered(60);
  check(pnpbs_placement_set_spacing_constant(placement, 0.025), "spacing");
  run("far too few nodes", 2000, 0);
  give_to_next_rank();
  spot.least = 0.006;
  check(pnpbs_placement_set_spacing_callback(placement, spot_spacing, &spot), "spacing");
  run("given to the next rank", 100, 500);

  pnpbs_placement_destroy(&placement);
  pnpbs_context_destroy(&context);
  MPI_Finalize();
  return 0;
}
