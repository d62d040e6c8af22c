// SPDX-License-Identifier: BSD-3-Clause
// Estimate of the memory that the system can still give to this process: the free memory of the
// machine, or less if a control group (container, batch system) has a lower limit.
#pragma once

#include <cstdint>
#include <string>

namespace pnpbs {

// Returns the available memory in bytes, or infinity if the system does not report it. `root` is a
// prefix of the paths that are read; tests pass a folder with files of their own.
double available_memory(const std::string& root = "");

// Returns the largest memory in bytes that this process has used up to now.
std::int64_t peak_memory();

}  // namespace pnpbs
