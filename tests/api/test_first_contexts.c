/* SPDX-License-Identifier: BSD-3-Clause
 *
 * Tests host threads that make the first calls of the process at the same time. Each creates a
 * context of its own, places nodes and writes them. Kokkos is started once.
 */
#define _POSIX_C_SOURCE 200809L
#include <pthread.h>
#include <unistd.h>

#include "api_support.h"

typedef struct {
  int number;
  char hash[32], path[64], failure[400];
} worker;

static pthread_barrier_t start;

static int failed(worker* it, pnpbs_status status, const char* what) {
  if (status >= 0) return 0;
  snprintf(it->failure, sizeof it->failure, "%s: %s", what, pnpbs_last_error(NULL));
  return 1;
}
#define TRY(call) \
  if (failed(it, (call), #call)) return NULL

static void* work(void* argument) {
  worker* it = argument;
  const double square[8] = {0, 0, 1, 0, 1, 1, 0, 1};
  pnpbs_context context = NULL;
  pnpbs_domain domain = NULL;
  pnpbs_placement placement = NULL;
  const char* hash = NULL;
  char wanted[40];
  pthread_barrier_wait(&start);
  TRY(pnpbs_context_create_serial(&context));
  TRY(pnpbs_domain_create(context, 2, &domain));
  TRY(pnpbs_domain_add_polyline(domain, PNPBS_BOUNDARY, 1, 4, square, NULL, 0));
  TRY(pnpbs_placement_create(context, domain, &placement));
  TRY(pnpbs_placement_set(placement, "steps", "20"));
  TRY(pnpbs_placement_set_spacing_constant(placement, 0.06));
  TRY(pnpbs_placement_run(placement));
  TRY(pnpbs_placement_write(placement, it->path, 1));
  snprintf(wanted, sizeof wanted, "no_%d", it->number);
  if (pnpbs_placement_set(placement, wanted, "1") != PNPBS_ERROR_KEY ||
      strstr(pnpbs_last_error(context), wanted) == NULL) {
    snprintf(it->failure, sizeof it->failure, "a stranger's message");
    return NULL;
  }
  TRY(pnpbs_placement_get_string(placement, "hash", &hash));
  snprintf(it->hash, sizeof it->hash, "%s", hash);
  TRY(pnpbs_context_destroy(&context));
  TRY(pnpbs_placement_destroy(&placement));
  TRY(pnpbs_domain_destroy(&domain));
  return NULL;
}

START_TEST(first_calls_at_the_same_time) {
  enum { WORKERS = 4 };
  worker workers[WORKERS];
  pthread_t threads[WORKERS];
  int k;
  memset(workers, 0, sizeof workers);
  ck_assert_int_eq(pthread_barrier_init(&start, NULL, WORKERS), 0);
  for (k = 0; k < WORKERS; ++k) {
    workers[k].number = k;
    snprintf(workers[k].path, sizeof workers[k].path, "first_%d_%d.vtu", (int)getpid(), k);
    ck_assert_int_eq(pthread_create(&threads[k], NULL, work, &workers[k]), 0);
  }
  for (k = 0; k < WORKERS; ++k) ck_assert_int_eq(pthread_join(threads[k], NULL), 0);
  for (k = 0; k < WORKERS; ++k) {
    ck_assert_msg(workers[k].failure[0] == '\0', "%s", workers[k].failure);
    ck_assert_str_eq(workers[k].hash, workers[0].hash);
    ck_assert_int_eq(unlink(workers[k].path), 0);
  }
  pthread_barrier_destroy(&start);
}
END_TEST

TEST_SUITE(test_first_contexts) {
  Suite* suite = suite_create("first contexts");
  TCase* cases = tcase_create("threads");
  tcase_add_test(cases, first_calls_at_the_same_time);
  suite_add_tcase(suite, cases);
  return run_suite(suite);
}
