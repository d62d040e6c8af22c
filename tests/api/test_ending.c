/* SPDX-License-Identifier: BSD-3-Clause
 *
 * Tests the end of Kokkos while other threads make calls, and processes that fork before and after
 * it has started. Kokkos can be ended once per process, so each case runs in a child of this
 * process, in which Kokkos never starts.
 */
#define _POSIX_C_SOURCE 200809L
#include <pthread.h>
#include <stdatomic.h>
#include <sys/wait.h>
#include <time.h>
#include <unistd.h>

#include "api_support.h"

enum { TIME_LIMIT = 60 }; /* in seconds */

/* Ends the child if a condition fails, as Check's assertions do not work there. */
static void demand(int condition, const char* what) {
  if (condition) return;
  fprintf(stderr, "%s: %s\n", what, pnpbs_last_error(NULL));
  _exit(EXIT_FAILURE);
}
#define DEMAND(condition) demand((condition), #condition)

/* Runs work(argument) in a child process, which must end within the time limit. */
static void run_in_child(void (*work)(int), int argument) {
  int status = 0;
  const pid_t child = fork();
  ck_assert_int_ge(child, 0);
  if (child == 0) {
    alarm(TIME_LIMIT);
    work(argument);
    _exit(EXIT_SUCCESS);
  }
  ck_assert_int_eq(waitpid(child, &status, 0), child);
  ck_assert_msg(WIFEXITED(status) && WEXITSTATUS(status) == 0, "status %d of the child", status);
}

static job square_with_nodes(const char* threads, pnpbs_spacing_fn spacing) {
  const double square[] = {0, 0, 1, 0, 1, 1, 0, 1};
  job it;
  DEMAND(pnpbs_context_create_serial(&it.context) == PNPBS_OK);
  DEMAND(pnpbs_context_set(it.context, "threads", threads) == PNPBS_OK);
  DEMAND(pnpbs_domain_create(it.context, 2, &it.domain) == PNPBS_OK);
  DEMAND(pnpbs_domain_add_polyline(it.domain, PNPBS_BOUNDARY, 1, 4, square, NULL, 0) == PNPBS_OK);
  DEMAND(pnpbs_placement_create(it.context, it.domain, &it.placement) == PNPBS_OK);
  DEMAND(pnpbs_placement_set(it.placement, "steps", "40") == PNPBS_OK);
  if (spacing)
    DEMAND(pnpbs_placement_set_spacing_callback(it.placement, spacing, &it) == PNPBS_OK);
  else
    DEMAND(pnpbs_placement_set_spacing_constant(it.placement, 0.05) == PNPBS_OK);
  DEMAND(pnpbs_placement_run(it.placement) >= 0);
  return it;
}

static void destroy_job(job* it) {
  DEMAND(pnpbs_placement_destroy(&it->placement) == PNPBS_OK);
  DEMAND(pnpbs_domain_destroy(&it->domain) == PNPBS_OK);
  DEMAND(pnpbs_context_destroy(&it->context) == PNPBS_OK);
}

/* ---------------------------------------------------------------- queries of other threads ---- */

enum { ASKING = 3 };
static atomic_int ready, ended;

/* Makes queries until Kokkos has ended. */
static void* ask(void* unused) {
  job it = square_with_nodes("2", NULL);
  int64_t n = 0;
  double *x, *values, sum = 0, error = 0;
  DEMAND(pnpbs_placement_count(it.placement, &n) == PNPBS_OK);
  x = calloc(3 * (size_t)n, sizeof *x);
  values = x + 2 * n;
  atomic_fetch_add(&ready, 1);
  while (!atomic_load(&ended)) {
    pnpbs_status status = pnpbs_placement_get_nodes(it.placement, n, x, NULL, NULL, NULL);
    if (status >= 0) status = pnpbs_placement_sum(it.placement, n, 1, values, &sum);
    if (status >= 0) status = pnpbs_placement_get_double(it.placement, "d_error.mean", &error);
    DEMAND(status >= 0 || status == PNPBS_ERROR_STATE || status == PNPBS_ERROR_KOKKOS);
  }
  free(x);
  destroy_job(&it);
  return unused;
}

static void end_while_threads_ask(int microseconds) {
  const struct timespec pause = {0, 1000L * microseconds}, moment = {0, 1000000L};
  pthread_t threads[ASKING];
  int k;
  for (k = 0; k < ASKING; ++k) DEMAND(pthread_create(&threads[k], NULL, ask, NULL) == 0);
  while (atomic_load(&ready) < ASKING) nanosleep(&moment, NULL);
  nanosleep(&pause, NULL);
  DEMAND(pnpbs_finalize() == PNPBS_OK);
  nanosleep(&moment, NULL);
  atomic_store(&ended, 1);
  for (k = 0; k < ASKING; ++k) DEMAND(pthread_join(threads[k], NULL) == 0);
}

START_TEST(kokkos_ends_between_queries) {
  int k;
  for (k = 0; k < 12; ++k) run_in_child(end_while_threads_ask, 300 * k);
}
END_TEST

/* ---------------------------------------------------------------- a run in progress ----------- */

static atomic_int started, refused, finished;

/* Keeps its run in progress until a call of the other thread was refused. Queries inside the
 * callback are part of the run. */
static int32_t waiting_spacing(int64_t n, int32_t dim, const double* x, double* d, void* user) {
  const job* it = user;
  const struct timespec moment = {0, 1000000L};
  int64_t i, nodes = 0;
  (void)dim, (void)x;
  for (i = 0; i < n; ++i) d[i] = 0.1;
  atomic_store(&started, 1);
  while (!atomic_load(&refused)) nanosleep(&moment, NULL);
  pnpbs_placement_count(it->placement, &nodes);
  DEMAND(strstr(pnpbs_last_error(NULL), "pnpbs_finalize") == NULL);
  return 0;
}

static void* run_and_wait(void* unused) {
  job it = square_with_nodes("2", waiting_spacing);
  atomic_store(&finished, 1);
  destroy_job(&it);
  return unused;
}

static void* call_until_refused(void* argument) {
  const struct timespec moment = {0, 1000000L};
  pnpbs_context context = argument;
  pnpbs_status status;
  while ((status = pnpbs_context_set(context, "steps", "10")) == PNPBS_OK) nanosleep(&moment, NULL);
  DEMAND(status == PNPBS_ERROR_STATE);
  DEMAND(strstr(pnpbs_last_error(NULL), "pnpbs_finalize") != NULL);
  DEMAND(atomic_load(&finished) == 0);
  atomic_store(&refused, 1);
  DEMAND(pnpbs_context_destroy(&context) == PNPBS_OK); /* waits for the end of the run */
  return NULL;
}

static void end_while_a_run_is_in_progress(int unused) {
  const struct timespec moment = {0, 1000000L};
  pthread_t running, calling;
  pnpbs_context context = NULL;
  (void)unused;
  DEMAND(pnpbs_context_create_serial(&context) == PNPBS_OK);
  DEMAND(pthread_create(&running, NULL, run_and_wait, NULL) == 0);
  while (!atomic_load(&started)) nanosleep(&moment, NULL);
  DEMAND(pthread_create(&calling, NULL, call_until_refused, context) == 0);
  DEMAND(pnpbs_finalize() == PNPBS_OK);
  DEMAND(atomic_load(&finished) == 1 || atomic_load(&refused) == 1);
  DEMAND(pthread_join(running, NULL) == 0);
  DEMAND(pthread_join(calling, NULL) == 0);
  DEMAND(pnpbs_finalize() == PNPBS_OK);
}

START_TEST(kokkos_ends_after_a_run) { run_in_child(end_while_a_run_is_in_progress, 0); }
END_TEST

/* ---------------------------------------------------------------- forked processes ------------ */

static job before_fork;

static void run_after_fork(int threads) {
  const pnpbs_status status = pnpbs_placement_run(before_fork.placement);
  if (threads == 1) {
    DEMAND(status >= 0);
    return;
  }
  DEMAND(status == PNPBS_ERROR_STATE);
  DEMAND(strstr(pnpbs_last_error(before_fork.context), "forked") != NULL);
  DEMAND(pnpbs_placement_create(before_fork.context, before_fork.domain, &before_fork.placement) ==
         PNPBS_ERROR_STATE);
  DEMAND(pnpbs_finalize() == PNPBS_ERROR_STATE);
}

static void fork_with_threads(int threads) {
  char text[16];
  int status = 0;
  pid_t child;
  snprintf(text, sizeof text, "%d", threads);
  before_fork = square_with_nodes(text, NULL);
  child = fork();
  DEMAND(child >= 0);
  if (child == 0) {
    alarm(TIME_LIMIT / 2);
    run_after_fork(threads);
    _exit(EXIT_SUCCESS);
  }
  DEMAND(waitpid(child, &status, 0) == child);
  DEMAND(WIFEXITED(status) && WEXITSTATUS(status) == 0);
  DEMAND(pnpbs_placement_run(before_fork.placement) >= 0); /* starts threads */
}

START_TEST(forked_processes_lack_threads) { run_in_child(fork_with_threads, 2); }
END_TEST

START_TEST(forked_processes_compute_with_one_thread) { run_in_child(fork_with_threads, 1); }
END_TEST

TEST_SUITE(test_ending) {
  Suite* suite = suite_create("ending");
  TCase* cases = tcase_create("processes");
  tcase_set_timeout(cases, 0);
  tcase_add_test(cases, kokkos_ends_between_queries);
  tcase_add_test(cases, kokkos_ends_after_a_run);
  tcase_add_test(cases, forked_processes_lack_threads);
  tcase_add_test(cases, forked_processes_compute_with_one_thread);
  suite_add_tcase(suite, cases);
  return run_suite(suite);
}
