// SPDX-License-Identifier: BSD-3-Clause
//
// The least of a failing case that still fails.
#pragma once

#include "groups.hpp"

namespace hunt {

struct Failure {
  CaseSpec spec;
  Configuration configuration;
  std::string difference;  // on rank 0 of the world alone
};

/** Leaves out what it can, one thing after the other. The group comes to lie behind the reference;
 *  false if it does not fail there. Collective over the world. */
bool shrink(Failure& failure, const Settings& extra);

}  // namespace hunt
