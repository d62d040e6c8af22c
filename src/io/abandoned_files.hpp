// SPDX-License-Identifier: BSD-3-Clause
// What a killed process has left of a file that it was writing: it goes when the file is written
// next.
#pragma once

#include <string>

namespace pnpbs::io {

// A name in the folder of `target` for a file that this process writes and nobody has: it tells
// target, machine and process.
std::string unfinished_name_beside(const std::string& target);

// Removes the files of such names for this target whose processes have ended, on this machine since
// it was started. Others stay: nobody here can tell whether they are still written.
void remove_abandoned_beside(const std::string& target) noexcept;

}  // namespace pnpbs::io
