// SPDX-License-Identifier: BSD-3-Clause
//
// Reduction of a failing case to a smaller one that still fails.
#pragma once

#include "groups.hpp"

namespace hunt {

struct Failure {
  CaseSpec spec;
  Configuration configuration;
  std::string difference;  // on rank 0 of the world only
};

/** Removes parts of the case one after the other as long as it fails. The group is moved directly
 * after the reference. Returns false if the case does not fail there. Collective over the world. */
bool shrink(Failure& failure, const Settings& extra);

}  // namespace hunt
