/* SPDX-License-Identifier: BSD-3-Clause
 *
 * Tests that the same job with one, two and more threads gives the same nodes, bit for bit. The
 * number of threads is fixed once per process, so this program runs itself: `test_api_threads <job>
 * <file>` runs a job and writes all of its results. Without arguments, it compares such files.
 */
#define _POSIX_C_SOURCE 200809L
#include <inttypes.h>
#include <sys/types.h>
#include <sys/wait.h>
#include <unistd.h>

#include "api_support.h"

/* ---------------------------------------------------------------- the jobs -------------- */

/* Ends the process if a call fails. Jobs run in processes of their own, without Check. */
static void demand(pnpbs_status status, const char* what) {
  if (status >= 0) return;
  fprintf(stderr, "%s: %s\n", what, pnpbs_last_error(NULL));
  exit(EXIT_FAILURE);
}
#define DEMAND(call) demand((call), #call)

typedef struct {
  const char* name;
  const char* file; /* a domain under examples/data, or NULL for the unit square */
  cone slope;
  const char* options[10];
  double second; /* factor of d for a second run; 0 for none */
} thread_job;

static const thread_job jobs[] = {
    {"uniform square", NULL, {0.02, 0, 0, 0}, {NULL}, 0},
    {"graded square", NULL, {0.008, 0.08, 0.5, 0.5}, {NULL}, 0},
    {"Great Lakes", "great_lakes.poly", {1.6, 0.028, 0, 0}, {NULL}, 0},
    {"islands", "great_lakes_islands.poly", {4, 0.03, 0, 0}, {"growth_limit", "0.02", NULL}, 0},
    {"the paper", NULL, {0.02, 0.05, 0, 0}, {"method", "paper", "steps", "200", NULL}, 0},
    {"paper, lake",
     "lake_victoria.poly",
     {3, 0.02, 0, 0},
     {"method", "paper", "steps", "80", NULL},
     0},
    {"refined", NULL, {0.03, 0.05, 0, 0}, {NULL}, 0.4},
    {"coarsened", NULL, {0.01, 0.03, 0, 0}, {NULL}, 2},
    {"restless",
     NULL,
     {0.02, 0.02, 0, 0},
     {"delete_above", "6.3", "insert_below", "5.9", "event_interval", "4", "population_tolerance",
      "0", NULL},
     0},
};

/* Writes all results to a text file, with all bits. */
static void write_results(pnpbs_placement p, FILE* file) {
  int64_t n = 0, entries = 0, near = 0, triangles = 0, edges = 0, i;
  double *xy, *d;
  int64_t *ids, *offsets, *neighbours, *corners, *ends, inserted = 0, deleted = 0, steps = 0;
  int32_t *tags, *edge_tags;
  int8_t* is_triangle;
  const char* hash = NULL;
  DEMAND(pnpbs_placement_get_string(p, "hash", &hash));
  fprintf(file, "hash %s\n", hash);
  DEMAND(pnpbs_placement_get_int64(p, "inserted", &inserted));
  DEMAND(pnpbs_placement_get_int64(p, "deleted", &deleted));
  DEMAND(pnpbs_placement_get_int64(p, "steps", &steps));
  fprintf(file, "inserted %" PRId64 " deleted %" PRId64 " steps %" PRId64 "\n", inserted, deleted,
          steps);
  {
    static const char* const keys[] = {"d_error.mean", "d_error.deviation", "d_error.least",
                                       "speed.mean", "speed.largest"};
    int k;
    for (k = 0; k < COUNT_OF(keys); ++k) {
      double value = 0;
      DEMAND(pnpbs_placement_get_double(p, keys[k], &value));
      fprintf(file, "%s %a\n", keys[k], value);
    }
  }
  DEMAND(pnpbs_placement_count(p, &n));
  DEMAND(pnpbs_placement_star_size(p, &entries));
  DEMAND(pnpbs_placement_adjacency_size(p, &near));
  DEMAND(pnpbs_placement_get_triangles(p, 0, &triangles, NULL));
  DEMAND(pnpbs_placement_get_boundary_edges(p, 0, &edges, NULL, NULL));
  xy = malloc(2 * (size_t)n * sizeof *xy);
  d = malloc((size_t)n * sizeof *d);
  ids = malloc((size_t)n * sizeof *ids);
  tags = malloc((size_t)n * sizeof *tags);
  offsets = malloc((size_t)(n + 1) * sizeof *offsets);
  neighbours = malloc((size_t)(entries > near ? entries : near) * sizeof *neighbours);
  is_triangle = malloc((size_t)entries * sizeof *is_triangle);
  corners = malloc(3 * (size_t)triangles * sizeof *corners);
  ends = malloc(2 * (size_t)edges * sizeof *ends);
  edge_tags = malloc((size_t)edges * sizeof *edge_tags);
  DEMAND(pnpbs_placement_get_nodes(p, n, xy, ids, tags, d));
  fprintf(file, "%" PRId64 " 2 1 1\n", n); /* as in Triangle's .node files */
  for (i = 0; i < n; ++i) {
    fprintf(file, "%" PRId64 " %a %a %a %" PRId32 " id %" PRId64 "\n", i + 1, xy[2 * i],
            xy[2 * i + 1], d[i], tags[i], ids[i]);
  }
  DEMAND(pnpbs_placement_get_stars(p, entries, offsets, neighbours, is_triangle));
  for (i = 0; i <= n; ++i) fprintf(file, "%" PRId64 " ", offsets[i]);
  for (i = 0; i < entries; ++i) fprintf(file, "%" PRId64 " %d\n", neighbours[i], is_triangle[i]);
  DEMAND(pnpbs_placement_get_adjacency(p, near, offsets, neighbours));
  for (i = 0; i <= n; ++i) fprintf(file, "%" PRId64 " ", offsets[i]);
  for (i = 0; i < near; ++i) fprintf(file, "%" PRId64 "\n", neighbours[i]);
  DEMAND(pnpbs_placement_get_triangles(p, triangles, &triangles, corners));
  for (i = 0; i < 3 * triangles; ++i) fprintf(file, "%" PRId64 "\n", corners[i]);
  DEMAND(pnpbs_placement_get_boundary_edges(p, edges, &edges, ends, edge_tags));
  for (i = 0; i < edges; ++i) {
    fprintf(file, "%" PRId64 " %" PRId64 " %" PRId32 "\n", ends[2 * i], ends[2 * i + 1],
            edge_tags[i]);
  }
  free(xy), free(d), free(ids), free(tags), free(offsets), free(neighbours), free(is_triangle);
  free(corners), free(ends), free(edge_tags);
}

static int do_job(int which, const char* path) {
  const thread_job* it = &jobs[which];
  const double square[8] = {0, 0, 1, 0, 1, 1, 0, 1};
  cone slope = it->slope, again = it->slope;
  pnpbs_context context = NULL;
  pnpbs_domain domain = NULL;
  pnpbs_placement placement = NULL;
  int64_t threads = 0;
  char data[1000];
  int k;
  FILE* file = fopen(path, "w");
  if (file == NULL) return EXIT_FAILURE;
  DEMAND(pnpbs_context_create_serial(&context));
  DEMAND(pnpbs_domain_create(context, 2, &domain));
  if (it->file != NULL) {
    snprintf(data, sizeof data, "%s/examples/data/%s", PNPBS_SOURCE_DIR, it->file);
    DEMAND(pnpbs_domain_read_poly(domain, data));
  } else {
    DEMAND(pnpbs_domain_add_polyline(domain, PNPBS_BOUNDARY, 1, 4, square, NULL, 0));
  }
  DEMAND(pnpbs_placement_create(context, domain, &placement));
  for (k = 0; it->options[k] != NULL; k += 2) {
    DEMAND(pnpbs_placement_set(placement, it->options[k], it->options[k + 1]));
  }
  DEMAND(pnpbs_placement_set_spacing_callback(placement, cone_spacing, &slope));
  DEMAND(pnpbs_placement_run(placement));
  write_results(placement, file);
  if (it->second != 0) {
    again.a *= it->second;
    again.b *= it->second;
    DEMAND(pnpbs_placement_set_spacing_callback(placement, cone_spacing, &again));
    DEMAND(pnpbs_placement_run(placement));
    write_results(placement, file);
  }
  DEMAND(pnpbs_placement_get_int64(placement, "threads", &threads));
  printf("%" PRId64 "\n", threads);
  DEMAND(pnpbs_placement_destroy(&placement));
  DEMAND(pnpbs_domain_destroy(&domain));
  DEMAND(pnpbs_context_destroy(&context));
  return fclose(file) == 0 ? EXIT_SUCCESS : EXIT_FAILURE;
}

/* ---------------------------------------------------------------- comparing ------------- */

static const char* this_program;

/* Runs job `which` with this many threads into a file. Returns the number of threads that it had.
 */
static int run_with(int which, int threads, const char* path) {
  char number[20], count[20];
  int ends[2], status = -1;
  FILE* answer;
  int found = 0;
  pid_t child;
  snprintf(number, sizeof number, "%d", which);
  snprintf(count, sizeof count, "%d", threads);
  ck_assert_int_eq(pipe(ends), 0);
  child = fork();
  ck_assert_int_ge(child, 0);
  if (child == 0) {
    dup2(ends[1], STDOUT_FILENO);
    close(ends[0]);
    close(ends[1]);
    setenv("OMP_NUM_THREADS", count, 1);
    execl(this_program, this_program, number, path, (char*)NULL);
    _exit(127);
  }
  close(ends[1]);
  answer = fdopen(ends[0], "r");
  ck_assert_ptr_nonnull(answer);
  if (fscanf(answer, "%d", &found) != 1) found = -1;
  fclose(answer);
  ck_assert_int_eq(waitpid(child, &status, 0), child);
  ck_assert_msg(WIFEXITED(status) && WEXITSTATUS(status) == 0, "%s with %d threads ended with %d",
                jobs[which].name, threads, status);
  return found;
}

static char* read_file(const char* path, size_t* length) {
  FILE* file = fopen(path, "r");
  char* text;
  long size;
  ck_assert_ptr_nonnull(file);
  ck_assert_int_eq(fseek(file, 0, SEEK_END), 0);
  size = ftell(file);
  ck_assert_int_gt(size, 1000);
  rewind(file);
  text = malloc((size_t)size + 1);
  *length = fread(text, 1, (size_t)size, file);
  ck_assert_int_eq((long)*length, size);
  text[size] = '\0';
  fclose(file);
  return text;
}

START_TEST(any_number_of_threads) {
  static const int threads[] = {1, 2, 5};
  char path[3][1000];
  char* text[3];
  size_t length[3];
  int k;
  long long inserted = 0, deleted = 0;
  for (k = 0; k < 3; ++k) {
    int found;
    snprintf(path[k], sizeof path[k], "%s/threads_%d_%d.txt", PNPBS_TEST_WORK_DIR, _i, threads[k]);
    found = run_with(_i, threads[k], path[k]);
    /* A build without OpenMP always has one thread. */
    if (strstr(pnpbs_build_info(), "back end: OpenMP") != NULL) {
      ck_assert_int_eq(found, threads[k]);
    }
    text[k] = read_file(path[k], &length[k]);
    if (k == 0) continue;
    ck_assert_msg(length[k] == length[0] && memcmp(text[k], text[0], length[0]) == 0,
                  "%s: not the same with %d threads and with 1: see %s and %s", jobs[_i].name,
                  threads[k], path[0], path[k]);
  }
  /* Nodes were inserted and deleted where the job is meant to cause that. */
  ck_assert_int_eq(
      sscanf(strstr(text[0], "inserted"), "inserted %lld deleted %lld", &inserted, &deleted), 2);
  if (strcmp(jobs[_i].name, "restless") == 0) ck_assert(inserted > 0 && deleted > 0);
  for (k = 0; k < 3; ++k) {
    free(text[k]);
    remove(path[k]);
  }
}
END_TEST

int main(int arguments, char** argument) {
  Suite* suite;
  TCase* cases;
  if (arguments == 3) return do_job(atoi(argument[1]), argument[2]);
  this_program = argument[0];
  suite = suite_create("threads");
  cases = tcase_create("threads");
  tcase_add_loop_test(cases, any_number_of_threads, 0, COUNT_OF(jobs));
  suite_add_tcase(suite, cases);
  return run_suite(suite);
}
