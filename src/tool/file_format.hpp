// SPDX-License-Identifier: BSD-3-Clause
// All file formats that the command can write: those of the library, and pictures.
#pragma once

#include <string>
#include <vector>

#include "picture/formats.hpp"

namespace pnpbs::tool {

struct FileFormat {
  std::string name, help;
  bool binary;                     // not written to terminals
  bool elements;                   // holds nodes and, on request, elements
  const picture::Format* picture;  // nullptr: a format of the library
};

const std::vector<FileFormat>& file_formats();
std::vector<std::string> format_names();
std::string list_of_formats();

// Returns nullptr for an unknown name or extension.
const FileFormat* format_by_name(const std::string& name);
const FileFormat* format_by_extension(const std::string& path);

}  // namespace pnpbs::tool
