/* SPDX-License-Identifier: BSD-3-Clause
 *
 * Injects faults of the file system: replaces the system's calls on temporary files and lets one of
 * them fail, whether the library, MPI-IO or the command makes it.
 *
 * A program that links this file controls it by these functions. If it is preloaded as a shared
 * library, the environment controls it: PNPBS_FAULT_AT, PNPBS_FAULT_RANK (every rank if missing),
 * and PNPBS_FAULT_LOG, a file that receives the name of the failed call. */
#ifndef PNPBS_TESTS_FAULT_CALLS_H
#define PNPBS_TESTS_FAULT_CALLS_H

/* Lets the n-th call from now on fail, counted from 0; none if n is negative. */
void fault_arm(long n);

/* Returns the call that has failed since then, or NULL. */
const char* fault_happened(void);

#endif
