// SPDX-License-Identifier: BSD-3-Clause
//
// Cases as text files, which do not depend on the generator of random cases.
//
// A file begins with the line "hunt-case 1" and ends with the line "end". Each line between them
// begins with a keyword, and its numbers are written such that reading returns the same bits. Lines
// that begin with # are comments.
#pragma once

#include <string>

#include "case.hpp"

namespace hunt {

/** Writes the case. A body that the case reads from a file is copied into the folder of `path`.
 *  Throws std::runtime_error if a file cannot be written, or if the copy would replace a file with
 *  other contents. */
void write_case(const Case& job, const std::string& path);

/** Reads a case that write_case wrote. Throws std::runtime_error with the file and the line. */
Case read_case(const std::string& path);

}  // namespace hunt
