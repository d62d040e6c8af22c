/* SPDX-License-Identifier: BSD-3-Clause
 *
 * Tests that contexts are independent: host threads may each use one at the same time and get the
 * results that they get alone. Destroyed objects leave no memory behind.
 */
#define _GNU_SOURCE /* for mallinfo2 */
#include <malloc.h>
#include <pthread.h>
#include <unistd.h>

#include "api_support.h"

/* ---------------------------------------------------------------- at the same time ------ */

typedef struct {
  cone slope;
  int rounds;
  int with_errors;
  char hash[8][32];
  char failure[400]; /* message of the first call that failed */
} worker;

/* Check's assertions are for the main thread only, so workers store their first failure. */
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
  int round;
  for (round = 0; round < it->rounds; ++round) {
    pnpbs_context context = NULL;
    pnpbs_domain domain = NULL;
    pnpbs_placement placement = NULL;
    const char* hash = NULL;
    int64_t entries = 0;
    TRY(pnpbs_context_create_serial(&context));
    TRY(pnpbs_domain_create(context, 2, &domain));
    TRY(pnpbs_domain_add_polyline(domain, PNPBS_BOUNDARY, 1, 4, square, NULL, 0));
    TRY(pnpbs_placement_create(context, domain, &placement));
    TRY(pnpbs_placement_set(placement, "steps", "60"));
    TRY(pnpbs_placement_set_spacing_callback(placement, cone_spacing, &it->slope));
    TRY(pnpbs_placement_run(placement));
    TRY(pnpbs_placement_star_size(placement, &entries));
    TRY(pnpbs_placement_adjacency_size(placement, &entries));
    if (it->with_errors) {
      char wanted[40];
      snprintf(wanted, sizeof wanted, "no_%g", it->slope.a);
      if (pnpbs_placement_set(placement, wanted, "1") != PNPBS_ERROR_KEY ||
          strstr(pnpbs_last_error(context), wanted) == NULL ||
          strstr(pnpbs_last_error(NULL), wanted) == NULL) {
        snprintf(it->failure, sizeof it->failure, "a stranger's message: %s",
                 pnpbs_last_error(NULL));
        return NULL;
      }
    }
    TRY(pnpbs_placement_get_string(placement, "hash", &hash));
    snprintf(it->hash[round], sizeof it->hash[round], "%s", hash);
    TRY(pnpbs_placement_destroy(&placement));
    TRY(pnpbs_domain_destroy(&domain));
    TRY(pnpbs_context_destroy(&context));
  }
  return NULL;
}

START_TEST(threads_of_the_host) {
  enum { WORKERS = 3, ROUNDS = 4 };
  static const cone slopes[WORKERS] = {{0.04, 0, 0, 0}, {0.03, 0.03, 0, 0}, {0.02, 0.08, 1, 1}};
  worker alone[WORKERS], together[WORKERS];
  pthread_t threads[WORKERS];
  int k, round;
  memset(alone, 0, sizeof alone);
  memset(together, 0, sizeof together);
  for (k = 0; k < WORKERS; ++k) {
    alone[k].slope = together[k].slope = slopes[k];
    alone[k].rounds = 1;
    together[k].rounds = ROUNDS;
    together[k].with_errors = 1;
    work(&alone[k]);
    ck_assert_msg(alone[k].failure[0] == '\0', "%s", alone[k].failure);
  }
  for (k = 0; k < WORKERS; ++k) {
    ck_assert_int_eq(pthread_create(&threads[k], NULL, work, &together[k]), 0);
  }
  for (k = 0; k < WORKERS; ++k) ck_assert_int_eq(pthread_join(threads[k], NULL), 0);
  for (k = 0; k < WORKERS; ++k) {
    ck_assert_msg(together[k].failure[0] == '\0', "%s", together[k].failure);
    for (round = 0; round < ROUNDS; ++round) {
      ck_assert_str_eq(together[k].hash[round], alone[k].hash[0]);
    }
  }
}
END_TEST

/* ---------------------------------------------------------------- nothing is left ------- */

/* Returns the bytes in use by the allocator of the C library, or 0 if another allocator replaces
 * it. */
static double bytes_in_use(void) {
#if defined(__GLIBC__) && (__GLIBC__ > 2 || __GLIBC_MINOR__ >= 33)
  const struct mallinfo2 info = mallinfo2();
#else
  const struct mallinfo info = mallinfo();
#endif
  return (double)info.uordblks + (double)info.hblkhd;
}

static double resident_bytes(void) {
  FILE* file = fopen("/proc/self/statm", "r");
  double pages = 0;
  ck_assert_ptr_nonnull(file);
  ck_assert_int_eq(fscanf(file, "%*f %lf", &pages), 1);
  fclose(file);
  return pages * (double)sysconf(_SC_PAGESIZE);
}

/* Makes a run, an error in the middle of another one, reads all results, and destroys everything.
 */
static void use_and_destroy(int k) {
  const double middle[2] = {0.5, 0.5};
  job it = square_job(1);
  result nodes;
  int64_t entries = 0;
  add_circle(it.domain, PNPBS_INNER, 0.5, 0.5, 0.2, 2);
  MUST(pnpbs_domain_add_fixed_nodes(it.domain, 1, middle, NULL));
  MUST(pnpbs_placement_set(it.placement, "steps", "4"));
  MUST(pnpbs_placement_set(it.placement, "event_interval", "2"));
  MUST(pnpbs_placement_set(it.placement, "growth_limit", "0.2"));
  MUST(pnpbs_placement_set_spacing_constant(it.placement, 0.04));
  MUST_COMPUTE(pnpbs_placement_run(it.placement));
  MUST(pnpbs_placement_adjacency_size(it.placement, &entries));
  nodes = result_of(it.placement);
  result_free(&nodes);
  MUST(pnpbs_placement_set_spacing_constant(it.placement, 1e-12));
  MUST_BE(PNPBS_ERROR_SPACING, pnpbs_placement_run(it.placement));
  if (k % 2 == 0) {
    job_end(&it);
  } else { /* parents before children */
    MUST(pnpbs_context_destroy(&it.context));
    MUST(pnpbs_domain_destroy(&it.domain));
    MUST(pnpbs_placement_destroy(&it.placement));
  }
}

START_TEST(memory_comes_back) {
  double used, resident;
  int k;
  for (k = 0; k < 20; ++k) use_and_destroy(k);
  used = bytes_in_use();
  resident = resident_bytes();
  for (k = 0; k < 200; ++k) use_and_destroy(k);
  used = bytes_in_use() - used;
  resident = resident_bytes() - resident;
  /* The limit would detect one leaked object per round: a placement takes more than 300 KB, a
   * domain 10 KB and a context 1 KB. */
  ck_assert_msg(used < 50e3, "%g more bytes are in use", used);
#if !defined(PNPBS_TESTS_SANITIZED) /* sanitizers keep freed memory to detect its use */
  ck_assert_msg(resident < 4e6, "%g more bytes are resident", resident);
#endif
}
END_TEST

TEST_SUITE(test_contexts) {
  Suite* suite = suite_create("contexts");
  TCase* cases = tcase_create("contexts");
  tcase_add_test(cases, threads_of_the_host);
  tcase_add_test(cases, memory_comes_back);
  suite_add_tcase(suite, cases);
  return run_suite(suite);
}
