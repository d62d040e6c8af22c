/* SPDX-License-Identifier: BSD-3-Clause
 *
 * Injects faults of the file system: replaces the system's calls on temporary files and makes one
 * of them fail, whether the library, MPI-IO or the command makes it.
 *
 * A program that links this file controls the faults by these functions. If the file is preloaded
 * as a shared library, environment variables control them: PNPBS_FAULT_AT is the number of the
 * call, PNPBS_FAULT_RANK the rank (every rank if it is not set), and PNPBS_FAULT_LOG a file that
 * receives the name of the failed call. */
#ifndef PNPBS_TESTS_FAULT_CALLS_H
#define PNPBS_TESTS_FAULT_CALLS_H

/* Makes the n-th call from now on fail, counted from 0. No call fails if n is negative. */
void fault_arm(long n);

/* Returns the name of the call that has failed since fault_arm, or NULL. */
const char* fault_happened(void);

#endif
