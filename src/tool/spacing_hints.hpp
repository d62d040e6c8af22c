// SPDX-License-Identifier: BSD-3-Clause
// The points of --spacing-hints, at which the library samples d as well.
#pragma once

#include <string>
#include <vector>

namespace pnpbs::tool {

// Reads one point per line: `dimension` numbers, or on a sphere a longitude and a latitude in
// degrees, separated by commas. A header, empty lines and lines that begin with # are skipped.
// Returns the coordinates of the points, one after the other; on a sphere those of directions in
// space. Throws BadInput, which names the line.
std::vector<double> read_spacing_hints(const std::string& path, int dimension, bool on_sphere);

}  // namespace pnpbs::tool
