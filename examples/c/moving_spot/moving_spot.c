/* SPDX-License-Identifier: BSD-3-Clause
 *
 * Repeated adaptation over the ranks of an MPI program. A spot in which d is 20 times smaller moves
 * around the hole of a square, as a refined region follows a feature of a solution. Between frames
 * the program replaces the spacing of the live placement, and the next run starts from the current
 * nodes. No rank holds all nodes.
 *
 *   mpirun -np 4 ./moving_spot [FOLDER]
 *
 * If a folder is given, every rank writes its nodes of every frame into it as a CSV file, and
 * draw_frames.py draws them; the folder must exist.
 *
 * Results to check: the number of nodes of each frame should be the integral of
 * 2 / (sqrt(3) d^2) over the domain plus half of the boundary nodes, to within 8 %. Between frames
 * about as many nodes are inserted as deleted.
 */
#include <math.h>
#include <mpi.h>
#include <pnpbs/pnpbs_mpi.h>
#include <stdio.h>
#include <stdlib.h>

#define FRAMES 12
static const double pi = 3.14159265358979323846;
static const double hole_centre[2] = {0.5, 0.5}, hole_radius = 0.15;

static void check(pnpbs_status status, pnpbs_context context) {
  if (status < 0) {
    fprintf(stderr, "%s: %s\n", pnpbs_status_string(status), pnpbs_last_error(context));
    MPI_Abort(MPI_COMM_WORLD, 1);
  }
}

/* ---------------------------------------------------------------- the spacing ----------- */

typedef struct {
  double x, y, radius; /* centre and radius of the spot */
  double fine, coarse; /* d inside the spot and far away */
  double slope;        /* growth of d per distance in between */
} spot;

static double spacing_at(const spot *s, double x, double y) {
  const double away = fmax(0, hypot(x - s->x, y - s->y) - s->radius);
  return fmin(s->coarse, s->fine + s->slope * away);
}

static int32_t spacing(int64_t n, int32_t dim, const double *xyz, double *d, void *user) {
  int64_t i;
  for (i = 0; i < n; ++i) d[i] = spacing_at(user, xyz[i * dim], xyz[i * dim + 1]);
  return 0;
}

static void move_to_frame(spot *s, int frame) {
  const double angle = 2 * pi * frame / FRAMES;
  s->x = 0.5 + 0.32 * cos(angle);
  s->y = 0.5 + 0.32 * sin(angle);
}

/* Returns the number of nodes that the spacing implies inside the domain. The integral is a sum
 * over cells of the unit square. */
static double wanted_nodes(const spot *s) {
  const int cells = 500;
  double sum = 0;
  int i, j;
  for (j = 0; j < cells; ++j)
    for (i = 0; i < cells; ++i) {
      const double x = (i + 0.5) / cells, y = (j + 0.5) / cells;
      if (hypot(x - hole_centre[0], y - hole_centre[1]) > hole_radius)
        sum += 2 / (sqrt(3.0) * pow(spacing_at(s, x, y), 2));
    }
  return sum / cells / cells;
}

/* ---------------------------------------------------------------- a frame --------------- */

static int64_t integer(pnpbs_placement placement, pnpbs_context context, const char *key) {
  int64_t value;
  check(pnpbs_placement_get_int64(placement, key, &value), context);
  return value;
}

/* Writes x, y and tag of the nodes of this rank to FOLDER/frame_<frame>_rank_<rank>.csv. Local. */
static void write_nodes(pnpbs_placement placement, pnpbs_context context, const char *folder,
                        int frame, int rank) {
  char path[1024];
  int64_t nodes, i;
  int32_t *tags;
  double *xy;
  FILE *file;
  check(pnpbs_placement_count(placement, &nodes), context);
  xy = malloc((size_t)(nodes + 1) * 2 * sizeof *xy);
  tags = malloc((size_t)(nodes + 1) * sizeof *tags);
  snprintf(path, sizeof path, "%s/frame_%02d_rank_%03d.csv", folder, frame, rank);
  file = fopen(path, "w");
  if (xy == NULL || tags == NULL || file == NULL) {
    fprintf(stderr, "cannot write %s\n", path);
    MPI_Abort(MPI_COMM_WORLD, 1);
    return;
  }
  check(pnpbs_placement_get_nodes(placement, nodes, xy, NULL, tags, NULL), context);
  fprintf(file, "x,y,tag\n");
  for (i = 0; i < nodes; ++i)
    fprintf(file, "%.9g,%.9g,%ld\n", xy[2 * i], xy[2 * i + 1], (long)tags[i]);
  fclose(file);
  free(tags);
  free(xy);
}

/* Returns the largest work of a rank over the mean, or 0 if the library has no such statistic.
 * Collective. */
static double imbalance_of(pnpbs_placement placement, pnpbs_context context) {
  double imbalance = 0;
  const pnpbs_status status = pnpbs_placement_get_double(placement, "imbalance", &imbalance);
  if (status != PNPBS_ERROR_KEY) check(status, context);
  return imbalance;
}

int main(int argc, char **argv) {
  const double corners[4][2] = {{0, 0}, {1, 0}, {1, 1}, {0, 1}};
  spot s = {0, 0, 0.04, 0.0015, 0.03, 0.12};
  pnpbs_context context;
  pnpbs_domain domain;
  pnpbs_placement placement;
  int64_t inserted = 0, deleted = 0;
  int rank, frame, as_wanted = 0;

  MPI_Init(&argc, &argv);
  MPI_Comm_rank(MPI_COMM_WORLD, &rank);
  check(pnpbs_context_create_mpi(MPI_COMM_WORLD, &context), NULL);
  check(pnpbs_domain_create(context, 2, &domain), context);
  check(pnpbs_domain_add_polyline(domain, PNPBS_BOUNDARY, 1, 4, &corners[0][0], NULL, 0), context);
  check(pnpbs_domain_add_arc(domain, PNPBS_BOUNDARY, hole_centre, hole_radius, 0, 2 * pi, 2),
        context);
  check(pnpbs_placement_create(context, domain, &placement), context);

  for (frame = 0; frame < FRAMES; ++frame) {
    int64_t nodes, boundary, now_inserted, now_deleted;
    double imbalance;
    move_to_frame(&s, frame);
    /* The call is necessary although function and pointer are the same: it marks d as changed. */
    check(pnpbs_placement_set_spacing_callback(placement, spacing, &s), context);
    check(pnpbs_placement_run(placement), context);

    /* Statistics are collective and refer to all ranks. */
    nodes = integer(placement, context, "nodes");
    boundary = integer(placement, context, "boundary_nodes");
    now_inserted = integer(placement, context, "inserted");
    now_deleted = integer(placement, context, "deleted");
    imbalance = imbalance_of(placement, context);
    if (rank == 0) {
      const double wanted = wanted_nodes(&s) + 0.5 * (double)boundary;
      as_wanted += fabs((double)nodes / wanted - 1) < 0.08;
      printf("frame %2d, nodes %lld, wanted %.0f, inserted %lld, deleted %lld", frame,
             (long long)nodes, wanted, (long long)(now_inserted - inserted),
             (long long)(now_deleted - deleted));
      if (imbalance > 0) printf(", work max/mean %.3f", imbalance);
      printf("\n");
    }
    inserted = now_inserted;
    deleted = now_deleted;
    if (argc > 1) write_nodes(placement, context, argv[1], frame, rank);
  }
  if (rank == 0)
    printf("frames with about the nodes that d asks for: %d, expected %d\n", as_wanted, FRAMES);

  pnpbs_placement_destroy(&placement);
  pnpbs_domain_destroy(&domain);
  pnpbs_context_destroy(&context);
  MPI_Finalize();
  return 0;
}
