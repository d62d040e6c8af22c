// SPDX-License-Identifier: BSD-3-Clause
// All files of a run. They are checked before it, and appear together after it.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "io/formats.hpp"
#include "io/output_file.hpp"
#include "tool/arguments.hpp"
#include "tool/library.hpp"

namespace pnpbs::tool {

class Outputs {
 public:
  // Throws BadInput for unknown formats and for files that cannot be written.
  explicit Outputs(const Arguments& arguments);

  void write(pnpbs_placement placement, pnpbs_domain domain, pnpbs_context context);
  void write_report(const std::string& text);
  void publish();

  bool use_standard_output() const;
  std::vector<std::string> files() const;  // without standard output

 private:
  struct Output {
    io::OutputFile file;
    const io::Format* format;  // nullptr: the report
  };
  void add(const std::string& path, const io::Format* format);
  void check() const;

  io::PictureStyle style_;
  std::vector<Output> outputs_;
};

}  // namespace pnpbs::tool
