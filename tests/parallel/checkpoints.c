/* SPDX-License-Identifier: BSD-3-Clause
 *
 * Interrupts placements at several stages, writes checkpoints on some ranks and reads them on
 * others. The continued run must have the same bits as a run without interruption. The program runs
 * on groups of five ranks and of one rank. */
#define _POSIX_C_SOURCE 200809L /* mkdtemp */
#include <dirent.h>
#include <math.h>
#include <stdlib.h>
#include <unistd.h>

#include "rank_program.h"
#include "volume_bodies.h"

static char path[300];
static const char *case_name, *stage_name;

static void expect_of_stage(int condition, const char* what) {
  char text[300];
  snprintf(text, sizeof text, "%s, %s: %s", case_name, stage_name, what);
  expect(condition, text);
}

/* ---------------------------------------------------------------- cases ----------------- */

struct checkpoint_case {
  const char* name;
  int dim;
  volume_body body; /* NULL: a square with a hole, or the whole sphere */
  double d;
  const char* options[3][2];
};

static const struct checkpoint_case cases[] = {
    {"plane", 2, NULL, 0.03, {{"steps", "100"}, {NULL, NULL}, {NULL, NULL}}},
    {"paper", 2, NULL, 0.06, {{"method", "paper"}, {"steps", "90"}, {NULL, NULL}}},
    {"tiny", 2, NULL, 0.5, {{"steps", "50"}, {NULL, NULL}, {NULL, NULL}}},
    {"limited", 2, NULL, 0.045, {{"steps", "60"}, {"growth_limit", "0.1"}, {NULL, NULL}}},
    {"wanted", 2, NULL, 0.05, {{"steps", "60"}, {"wanted_nodes", "700"}, {NULL, NULL}}},
    {"box", 3, volume_unit_box, 0.18, {{"steps", "45"}, {NULL, NULL}, {NULL, NULL}}},
    {"globe", 3, volume_globe, 0.35, {{"steps", "45"}, {NULL, NULL}, {NULL, NULL}}},
    {"sphere", 3, NULL, 0.1, {{"steps", "45"}, {NULL, NULL}, {NULL, NULL}}},
    {"surface", 3, surface_halves, 0.2, {{"steps", "60"}, {NULL, NULL}, {NULL, NULL}}},
};
enum { CASES = sizeof cases / sizeof cases[0] };

struct graded {
  double d, at;
};

/* A spacing that is finer at a plane. */
static int32_t spacing_at(int64_t n, int32_t dim, const double* x, double* d, void* user) {
  const struct graded* s = user;
  int64_t i;
  for (i = 0; i < n; ++i) d[i] = s->d * (1 + 0.6 * fmin(1, fabs(x[dim * i] - s->at)));
  return 0;
}

static pnpbs_placement new_placement(const struct checkpoint_case* it, struct graded* spacing) {
  const double box[] = {0, 0, 1.5, 0, 1.5, 1, 0, 1}, centre[] = {0.7, 0.5}, point[] = {0, 0.6, 0.8};
  const int on_sphere = it->dim == 3 && !it->body;
  pnpbs_domain domain;
  pnpbs_placement placement;
  int k;
  expect_of_stage((on_sphere ? pnpbs_domain_create_sphere(context, 1, point, &domain)
                             : pnpbs_domain_create(context, it->dim, &domain)) == PNPBS_OK,
                  "domain");
  if (on_sphere) {
    /* a whole sphere has no curves */
  } else if (it->body) {
    expect_of_stage(it->body(domain, "") == PNPBS_OK, "body");
  } else {
    pnpbs_domain_add_polyline(domain, PNPBS_BOUNDARY, 1, 4, box, NULL, 0);
    pnpbs_domain_add_arc(domain, PNPBS_BOUNDARY, centre, 0.25, 0, 2 * acos(-1.0), 2);
  }
  expect_of_stage(pnpbs_placement_create(context, domain, &placement) == PNPBS_OK, "placement");
  pnpbs_domain_destroy(&domain);
  for (k = 0; k < 3 && it->options[k][0]; ++k)
    expect_of_stage(
        pnpbs_placement_set(placement, it->options[k][0], it->options[k][1]) == PNPBS_OK, "option");
  pnpbs_placement_set_spacing_callback(placement, spacing_at, spacing);
  return placement;
}

/* ---------------------------------------------------------------- stages ---------------- */

enum { INITIALISED, STEPPED, IN_RUN, RUN, ADAPTED, AT_NODES, PLACED, STEPPED_ON, LAST, STAGES };
static const char* const stage_names[] = {
    "initialised", "7 steps",         "within a run",  "run",      "adapted",
    "at nodes",    "at nodes, again", "further steps", "run again"};

struct watch {
  pnpbs_placement placement;
  int turns, written;
};

/* Writes a checkpoint at the second event and stops the run. Events that do not allow a checkpoint
 * are skipped. */
static int32_t write_and_stop(double fraction, int64_t step, int64_t nodes, double speed,
                              void* user) {
  struct watch* it = user;
  pnpbs_status status;
  (void)step, (void)speed;
  if (fraction == 0 || nodes == 0) return 0;
  status = pnpbs_placement_write_checkpoint(it->placement, path);
  if (status == PNPBS_ERROR_STATE) return 0;
  expect_of_stage(status == PNPBS_OK, "written from a monitor");
  it->written += 1;
  return ++it->turns == 2;
}

static void set_at_nodes(pnpbs_placement placement, int dim, double scale) {
  int64_t n, i;
  double *x, *d;
  expect_of_stage(pnpbs_placement_count(placement, &n) == PNPBS_OK, "count");
  x = malloc(((size_t)n + 1) * (size_t)dim * sizeof(double));
  d = malloc(((size_t)n + 1) * sizeof(double));
  expect_of_stage(pnpbs_placement_get_nodes(placement, n, x, NULL, NULL, d) == PNPBS_OK, "nodes");
  for (i = 0; i < n; ++i) d[i] *= scale * (1 + 0.1 * x[dim * i]);
  expect_of_stage(pnpbs_placement_set_spacing_at_nodes(placement, n, d) == PNPBS_OK,
                  "values at nodes");
  free(x), free(d);
}

/* Performs the stage after `done`. */
static void advance(pnpbs_placement placement, const struct checkpoint_case* it, int done,
                    struct graded* second) {
  pnpbs_status status = PNPBS_OK;
  switch (done + 1) {
    case INITIALISED:
      status = pnpbs_placement_initialise(placement);
      break;
    case STEPPED:
      status = pnpbs_placement_step(placement, 7);
      break;
    case RUN:
      status = pnpbs_placement_run(placement);
      break;
    case ADAPTED:
      second->d = 0.9 * it->d;
      second->at = 0.9;
      pnpbs_placement_set_spacing_callback(placement, spacing_at, second);
      status = pnpbs_placement_run(placement);
      break;
    case AT_NODES:
      set_at_nodes(placement, it->dim, 0.95);
      status = pnpbs_placement_step(placement, 13);
      break;
    case STEPPED_ON:
      status = pnpbs_placement_step(placement, 5);
      break;
    case PLACED:
    case LAST:
      status = pnpbs_placement_run(placement);
      break;
  }
  expect_of_stage(status >= 0, "stage");
}

static void note(pnpbs_placement placement, char* text) {
  const char* hash = "";
  int64_t nodes = 0, steps = 0, inserted = 0, deleted = 0;
  expect_of_stage(pnpbs_placement_get_string(placement, "hash", &hash) == PNPBS_OK, "hash");
  strcpy(text, hash);
  pnpbs_placement_get_int64(placement, "nodes", &nodes);
  pnpbs_placement_get_int64(placement, "steps", &steps);
  pnpbs_placement_get_int64(placement, "inserted", &inserted);
  pnpbs_placement_get_int64(placement, "deleted", &deleted);
  sprintf(text + strlen(text), " %lld nodes, %lld steps, %lld inserted, %lld deleted",
          (long long)nodes, (long long)steps, (long long)inserted, (long long)deleted);
}

/* The communicator of the first ranks of the group, and the context of the group. end() restores
 * the context. */
struct first_ranks {
  MPI_Comm communicator;
  pnpbs_context of_group;
};

/* Sets `context` to one on the first `ranks` ranks of the group. Returns whether this rank is one
 * of them. Collective over the group. */
static int begin(int ranks, struct first_ranks* first) {
  MPI_Comm_split(group, rank < ranks ? 0 : MPI_UNDEFINED, rank, &first->communicator);
  if (first->communicator == MPI_COMM_NULL) return 0;
  first->of_group = context;
  expect_of_stage(pnpbs_context_create_mpi(first->communicator, &context) == PNPBS_OK, "context");
  return 1;
}

static void end(struct first_ranks* first) {
  if (first->communicator != MPI_COMM_NULL) {
    pnpbs_context_destroy(&context);
    context = first->of_group;
    MPI_Comm_free(&first->communicator);
  }
  MPI_Barrier(group);
}

static void run_all(const struct checkpoint_case* it, int ranks, char notes[STAGES][200]) {
  struct graded first = {it->d, 0.3}, second;
  struct first_ranks some;
  int stage;
  if (begin(ranks, &some)) {
    pnpbs_placement placement = new_placement(it, &first);
    for (stage = 0; stage < STAGES; ++stage) {
      stage_name = stage_names[stage];
      if (stage == IN_RUN) continue;
      advance(placement, it, stage == RUN ? STEPPED + 1 : stage - 1, &second);
      note(placement, notes[stage]);
    }
    pnpbs_placement_destroy(&placement);
  }
  end(&some);
}

/* Performs the stages up to `at`, and writes a checkpoint there. */
static void write_at(const struct checkpoint_case* it, int ranks, int at) {
  struct graded first = {it->d, 0.3}, second;
  struct first_ranks some;
  int stage;
  if (begin(ranks, &some)) {
    pnpbs_placement placement = new_placement(it, &first);
    expect_of_stage(pnpbs_placement_write_checkpoint(placement, path) == PNPBS_ERROR_STATE,
                    "no nodes yet");
    for (stage = 0; stage <= at; ++stage) {
      if (stage != IN_RUN) {
        advance(placement, it, stage - 1, &second);
      } else if (stage == at) {
        struct watch watch = {placement, 0, 0};
        pnpbs_placement_set_monitor(placement, write_and_stop, &watch);
        expect_of_stage(pnpbs_placement_run(placement) >= 0, "a run that is stopped");
        expect_of_stage(watch.written >= 1, "nothing written from the monitor");
      }
    }
    if (at != IN_RUN)
      expect_of_stage(pnpbs_placement_write_checkpoint(placement, path) == PNPBS_OK, "written");
    pnpbs_placement_destroy(&placement);
  }
  end(&some);
}

/* Reads the checkpoint of stage `at`, performs the remaining stages and compares them. */
static void read_and_go_on(const struct checkpoint_case* it, int ranks, int at,
                           char notes[STAGES][200]) {
  struct graded first = {it->d, 0.3}, second = {0.9 * it->d, 0.9};
  char now[200];
  struct first_ranks some;
  int stage;
  if (begin(ranks, &some)) {
    pnpbs_placement placement = new_placement(it, at == ADAPTED ? &second : &first);
    expect_of_stage(pnpbs_placement_read_checkpoint(placement, path) == PNPBS_OK, "read");
    for (stage = at; stage < STAGES; ++stage) {
      if (stage == IN_RUN) continue;
      if (stage > at) advance(placement, it, stage == RUN ? STEPPED + 1 : stage - 1, &second);
      note(placement, now);
      if (strcmp(now, notes[stage]) == 0) continue;
      if (rank == 0)
        fprintf(stderr, "%s: read at \"%s\", then \"%s\" is %s, was %s\n", it->name,
                stage_names[at], stage_names[stage], now, notes[stage]);
      ++failures;
    }
    pnpbs_placement_destroy(&placement);
  }
  end(&some);
}

/* ---------------------------------------------------------------- all ------------------- */

static int files_in(const char* folder) {
  DIR* open = opendir(folder);
  const struct dirent* entry;
  int files = 0;
  while ((entry = readdir(open)) != NULL)
    files += !(entry->d_name[0] == '.' && strspn(entry->d_name, ".") == strlen(entry->d_name));
  closedir(open);
  return files;
}

static void check_all(void) {
  const int pairs[][2] = {{1, 3}, {3, 2}, {5, 1}, {2, 5}};
  char folder[] = "checkpointsXXXXXX", notes[STAGES][200];
  int k, at, turn = 0;
  if (rank == 0 && !mkdtemp(folder)) MPI_Abort(MPI_COMM_WORLD, 1);
  MPI_Bcast(folder, (int)sizeof folder, MPI_CHAR, 0, group);
  sprintf(path, "%s/case.vtkhdf", folder);
  for (k = 0; k < CASES; ++k) {
    if (arguments[0] && strcmp(arguments[0], cases[k].name) != 0) continue;
    case_name = cases[k].name;
    stage_name = "";
    run_all(&cases[k], size < 2 ? 1 : 2, notes);
    MPI_Bcast(notes, (int)sizeof notes, MPI_CHAR, 0, group);
    for (at = 0; at < STAGES; ++at, ++turn) {
      const int* pair = pairs[turn % 4];
      stage_name = stage_names[at];
      write_at(&cases[k], pair[0] < size ? pair[0] : size, at);
      read_and_go_on(&cases[k], pair[1] < size ? pair[1] : size, at, notes);
    }
  }
  if (rank == 0) {
    expect_of_stage(files_in(folder) == 1, "files are left");
    unlink(path);
    rmdir(folder);
  }
}

int main(int argc, char** argv) { return run_in_groups(argc, argv, check_all); }
