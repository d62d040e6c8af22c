/* SPDX-License-Identifier: BSD-3-Clause
 *
 * A job that the linkage tests repeat: create a context and a placement in a square, make some
 * steps, read the nodes, and destroy everything. It calls functions by a table, so that the same
 * job runs on a linked library and on one opened by name.
 */
#ifndef PNPBS_TESTS_LINKAGE_SMALL_JOB_H
#define PNPBS_TESTS_LINKAGE_SMALL_JOB_H

#include <stdio.h>
#include <stdlib.h>

#include "pnpbs/pnpbs.h"

/* X(name) for every function that the job calls, without the prefix. */
#define SMALL_JOB_FUNCTIONS(X)      \
  X(last_error)                     \
  X(context_create_serial)          \
  X(context_set)                    \
  X(context_destroy)                \
  X(domain_create)                  \
  X(domain_add_polyline)            \
  X(domain_destroy)                 \
  X(placement_create)               \
  X(placement_set_spacing_constant) \
  X(placement_run)                  \
  X(placement_count)                \
  X(placement_get_int64)            \
  X(placement_destroy)

typedef struct {
#define SMALL_JOB_MEMBER(name) __typeof__(&pnpbs_##name) name;
  SMALL_JOB_FUNCTIONS(SMALL_JOB_MEMBER)
#undef SMALL_JOB_MEMBER
} small_job_functions;

typedef struct {
  pnpbs_status status; /* of the first call that failed, or else of the run */
  char message[1000];  /* of the error */
  int64_t nodes;
  int64_t threads;
} small_job_result;

/* Runs the job. With `threads` NULL the library chooses the number of threads. */
static inline small_job_result small_job(const small_job_functions* f, const char* threads) {
  const double corners[4][2] = {{0, 0}, {1, 0}, {1, 1}, {0, 1}};
  small_job_result result = {PNPBS_OK, "", 0, 0};
  pnpbs_context context = NULL;
  pnpbs_domain domain = NULL;
  pnpbs_placement placement = NULL;
  pnpbs_status status = f->context_create_serial(&context);
  pnpbs_status ended;

  if (status >= 0 && threads != NULL) status = f->context_set(context, "threads", threads);
  if (status >= 0) status = f->domain_create(context, 2, &domain);
  if (status >= 0) {
    status = f->domain_add_polyline(domain, PNPBS_BOUNDARY, 1, 4, &corners[0][0], NULL, 0.0);
  }
  if (status >= 0) status = f->placement_create(context, domain, &placement);
  if (status >= 0) status = f->placement_set_spacing_constant(placement, 0.02);
  if (status >= 0) status = f->placement_run(placement);
  result.status = status;
  if (status >= 0) status = f->placement_count(placement, &result.nodes);
  if (status >= 0) {
    status = f->placement_get_int64(placement, "threads", &result.threads);
  }
  if (status < 0) {
    result.status = status;
    snprintf(result.message, sizeof result.message, "%s", f->last_error(context));
  }
  /* Parents are destroyed first, which is allowed since children keep them alive. */
  ended = f->context_destroy(&context);
  if (ended == PNPBS_OK) ended = f->domain_destroy(&domain);
  if (ended == PNPBS_OK) ended = f->placement_destroy(&placement);
  if (ended != PNPBS_OK) result.status = ended;
  return result;
}

#ifndef SMALL_JOB_BY_NAME
static const small_job_functions linked_library = {
#define SMALL_JOB_ADDRESS(name) pnpbs_##name,
    SMALL_JOB_FUNCTIONS(SMALL_JOB_ADDRESS)
#undef SMALL_JOB_ADDRESS
};
#endif

#endif
