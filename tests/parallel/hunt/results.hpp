// SPDX-License-Identifier: BSD-3-Clause
//
// What a run of a case tells that must not depend on ranks: names and values, as text.
#pragma once

#include <mpi.h>
#include <pnpbs/pnpbs.h>

#include <string>
#include <utility>
#include <vector>

namespace hunt {

using Results = std::vector<std::pair<std::string, std::string>>;

/** The name of an error's text. It is the same on all ranks of a run, and may name one of them and
 *  what that one met first; so it is not compared between runs. */
constexpr const char* kMessage = "message";

/** Adds what the placement tells now, each name with the prefix. Collective. False if ranks of the
 *  communicator disagree, or a call fails. */
bool add_results(pnpbs_placement placement, pnpbs_context context, MPI_Comm ranks,
                 const std::string& prefix, Results& results);

/** Whether all ranks were told the same status and, of an error, the same message; adds both.
 *  Collective. */
bool collective_try(pnpbs_status status, pnpbs_context context, MPI_Comm ranks,
                    const std::string& name, Results& results);

std::string packed(const Results& results);
Results unpacked(const std::string& text);

/** The names whose values differ, with the values of the first ones; "" if none does. */
std::string difference(const Results& expected, const Results& found);

}  // namespace hunt
