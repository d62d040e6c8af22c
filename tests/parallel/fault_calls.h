/* SPDX-License-Identifier: BSD-3-Clause
 *
 * Faults of the file system: stands in for the system's calls on files written aside, and lets one
 * of them fail, whoever makes it: the library, MPI-IO or the command.
 *
 * Linked into a program, it is told by these functions. Preloaded into one as a shared library, by
 * the environment: PNPBS_FAULT_AT, PNPBS_FAULT_RANK (every rank if missing), and PNPBS_FAULT_LOG, a
 * file that gets the name of the call that has failed. */
#ifndef PNPBS_TESTS_FAULT_CALLS_H
#define PNPBS_TESTS_FAULT_CALLS_H

/* The n-th call from now on fails, from 0; none if negative. */
void fault_arm(long n);

/* The call that has failed since, or NULL. */
const char* fault_happened(void);

#endif
