// SPDX-License-Identifier: BSD-3-Clause
// Which file --spacing names, if it is no formula: FILE or FILE:FIELD.
#pragma once

#include <optional>
#include <string>

namespace pnpbs::tool {

struct SpacingFile {
  std::string path;
  std::string field;  // empty: the only one
};

// By the ending of FILE: .vtu, .msh or .csv, in capitals or not. No formula has such.
std::optional<SpacingFile> spacing_file(const std::string& text);

}  // namespace pnpbs::tool
