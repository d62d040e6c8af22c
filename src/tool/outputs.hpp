// SPDX-License-Identifier: BSD-3-Clause
// All files of a run. They are checked before it, and appear together after it.
#pragma once

#include <exception>
#include <memory>
#include <string>
#include <vector>

#include "io/output_file.hpp"
#include "tool/arguments.hpp"
#include "tool/file_format.hpp"
#include "tool/gathered_picture.hpp"
#include "tool/library.hpp"
#include "tool/ranks.hpp"

namespace pnpbs::tool {

class Outputs {
 public:
  // Local: the first rank looks whether the files can be written. Throws BadInput for that and for
  // unknown formats.
  Outputs(const Arguments& arguments, const Ranks& ranks);

  // Whether there is any. Local.
  bool has_pictures() const;

  // Before the long run: throws if the library would not write its files, for want of HDF5, say, or
  // for names that no format can have. Collective.
  void check_with_library(pnpbs_placement placement, pnpbs_context context) const;

  // Collective, all of these; first pictures and the report, then the nodes. What was written
  // appears with write_nodes, when all of it is complete.
  void write_pictures(const GatheredPicture& picture);
  void write_report(const std::string& text);
  // In a .prj file beside each file of nodes, as shapefiles have it. Without a text there are none.
  // Before the others; of domains that GDAL reads alone.
  void write_projection(const std::string& text);
  // Or the particles that were made of them, unless these are null.
  void write_nodes(pnpbs_placement placement, pnpbs_particles particles, pnpbs_context context);
  // Afterwards: puts another text into the report, unless that has gone where nothing can be taken
  // back. If it cannot be written the text there is stays, as all files are there already.
  void replace_report(const std::string& text);

  bool use_standard_output() const;
  std::vector<std::string> files() const;  // without standard output

 private:
  struct Output {
    io::OutputFile file;
    const FileFormat* format;  // nullptr: the report, or a projection
    bool is_projection = false;
    bool is_picture() const { return format && format->picture; }
    bool is_report() const { return !format && !is_projection; }
    bool is_nodes() const { return format && !format->picture; }
  };
  void add_projections(const std::string& input);
  void write_text(bool is_projection, const std::string& text);
  void add(const std::string& path, const FileFormat* format);
  void refuse_checkpoint(const std::string& path) const;
  void check_pictures(const Arguments& arguments) const;
  void check_writable() const;
  void check_particles() const;
  pnpbs_status ask_for_nodes(pnpbs_placement placement, pnpbs_particles particles) const;
  static std::int32_t monitor(double fraction, std::int64_t, std::int64_t, double, void* user);
  bool publish_own();
  void settle_own(bool published);

  const Ranks& ranks_;
  bool elements_;
  std::vector<Output> outputs_;
  std::exception_ptr failure_;  // of publish_own
};

}  // namespace pnpbs::tool
