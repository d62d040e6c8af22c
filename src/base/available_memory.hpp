// SPDX-License-Identifier: BSD-3-Clause
// How much memory the system would give this process: what the machine has left, or less where its
// control groups (containers, batch systems) allow less.
#pragma once

#include <cstdint>
#include <string>

namespace pnpbs {

// Bytes; infinite where the system does not tell. `root` stands before the paths of its files.
double available_memory(const std::string& root = "");

// Bytes: the most that this process has held so far.
std::int64_t peak_memory();

}  // namespace pnpbs
