// SPDX-License-Identifier: BSD-3-Clause
// Output of several files of one placement. They are published together.
#pragma once

#include <functional>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "io/formats.hpp"
#include "io/output_fields.hpp"
#include "placement/placement.hpp"

namespace pnpbs::io {

// A file to write.
struct FileRequest {
  std::string path;
  const Format* format;
  int order;            // of the elements, 1 or 2; 0: without elements
  bool facets = false;  // the file has the facets of a grid, not its elements
};

// Properties of the results for which files are requested.
struct Requested {
  int dimension = 2;
  bool has_elements = false;
  GeometryKind kind = GeometryKind::plane;
  bool has_cracks = false;   // elements have cracks
  bool is_periodic = false;  // elements cross the sides of the cell of a periodic domain
};

Requested requested_of(Placement& placement);

// Adds the request for a file, and for the files of elements or facets that belong to it. The
// format is given by its name or, if that is empty, by the extension. `order` is that of the
// elements, 0 if none are requested. Throws Error(ErrorKind::argument).
void add_request(const std::string& path, const std::string& format, int order, const Requested& of,
                 std::vector<FileRequest>& requests);
// Throws if a format needs HDF5 and it is not available. Collective; if one rank throws, all ranks
// throw.
void require_hdf5_for(const std::vector<FileRequest>& requests, const Communicator& comm);
// Reports the finished fraction of the files to the monitor and returns whether to stop, see
// Monitoring::requests_stop().
using AsksToStop = std::function<bool(double fraction)>;
// Throws Error(ErrorKind::stopped) if `requests_stop` is not empty and returns true. Local.
void give_up_if_asked(const AsksToStop& requests_stop, std::size_t done, std::size_t files);

// Publishes the files of all ranks, or none. Collective; if one rank throws, all ranks throw.
void publish(const Communicator& comm, std::span<const std::unique_ptr<SharedFile>> files);

// Throws Error(ErrorKind::argument) if a format requires a field that is missing. Local; the fields
// are the same on all ranks.
void require_fields_for(const std::vector<FileRequest>& requests,
                        const std::vector<OutputField>& fields);

// Returns the name of a rank's piece of a .pvtu file.
std::string piece_path(const std::string& path, int rank);

// Writes the files, with the fields if the format can store any. The monitor may stop it.
// Collective.
void write_files(Placement& placement, const OutputFields& fields,
                 const std::vector<FileRequest>& requests);

}  // namespace pnpbs::io
