// SPDX-License-Identifier: BSD-3-Clause
//
// The results of a run that must not depend on ranks, as names and values in text form.
#pragma once

#include <mpi.h>
#include <pnpbs/pnpbs.h>

#include <string>
#include <utility>
#include <vector>

namespace hunt {

using Results = std::vector<std::pair<std::string, std::string>>;

/* Name of the entry with the text of an error. The text is the same on all ranks of a run, but may
 * name a rank and the first error found there, so it is not compared between runs. */
constexpr const char* kMessage = "message";

/** Adds the current results of the placement with this prefix. Returns false if ranks of the
 * communicator disagree or a call fails. Collective. */
bool add_results(pnpbs_placement placement, pnpbs_context context, MPI_Comm ranks,
                 const std::string& prefix, Results& results);

/** Adds the status and, for an error, its message. Returns whether they are the same on all ranks.
 * Collective. */
bool add_status(pnpbs_status status, pnpbs_context context, MPI_Comm ranks, const std::string& name,
                Results& results);

std::string packed(const Results& results);
Results unpacked(const std::string& text);

/** Returns the names with different values, with the first values; "" if there are none. */
std::string difference(const Results& expected, const Results& found);

}  // namespace hunt
