// SPDX-License-Identifier: BSD-3-Clause
// All formats the command can write: the library's, and pictures.
#pragma once

#include <string>
#include <vector>

#include "picture/formats.hpp"

namespace pnpbs::tool {

struct FileFormat {
  std::string name, help;
  bool binary;                     // not for terminals
  bool elements;                   // holds nodes and, on request, elements
  const picture::Format* picture;  // nullptr: the library's
};

const std::vector<FileFormat>& file_formats();
std::vector<std::string> format_names();
std::string list_of_formats();

// nullptr if there is none.
const FileFormat* format_by_name(const std::string& name);
const FileFormat* format_by_extension(const std::string& path);

}  // namespace pnpbs::tool
