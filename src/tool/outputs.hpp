// SPDX-License-Identifier: BSD-3-Clause
// All files of a run. They are checked before the run and appear together after it.
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
  // Checks that the files can be written, on the first rank. Local. Throws BadInput if they cannot,
  // or if a format is unknown.
  Outputs(const Arguments& arguments, const Ranks& ranks);

  // Returns whether there are any pictures. Local.
  bool has_pictures() const;

  // Throws if the library would refuse to write its files, for example because HDF5 is missing or a
  // field name is not allowed. Called before the long run. Collective.
  void check_with_library(pnpbs_placement placement, pnpbs_context context) const;

  // These functions are collective. Pictures and the report come first, then the nodes. All files
  // appear with write_nodes, when they are complete.
  void write_pictures(const GatheredPicture& picture);
  void write_report(const std::string& text);
  // Writes the projection to a .prj file beside each file of nodes, as shapefiles have it. An empty
  // text writes none. Must be called before the others, only for domains that GDAL reads.
  void write_projection(const std::string& text);
  // Writes the nodes, or the particles derived from them unless `particles` is null.
  void write_nodes(pnpbs_placement placement, pnpbs_particles particles, pnpbs_context context);
  // Replaces the text of the report after the run, unless it was written to a stream. If that
  // fails, the old text stays, because all files have been published already.
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
  void check_order() const;
  void check_writable() const;
  void check_particles() const;
  pnpbs_status ask_for_nodes(pnpbs_placement placement, pnpbs_particles particles) const;
  static std::int32_t monitor(double fraction, std::int64_t, std::int64_t, double, void* user);
  bool publish_own();
  void settle_own(bool published);

  const Ranks& ranks_;
  int order_;  // of the elements in files, 0: without elements
  std::vector<Output> outputs_;
  std::exception_ptr failure_;  // thrown in publish_own
};

}  // namespace pnpbs::tool
