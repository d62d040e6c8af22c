// SPDX-License-Identifier: BSD-3-Clause
// Several files of one placement, which appear together.
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

struct FileRequest {
  std::string path;
  const Format* format;
  bool elements;
  bool facets = false;  // of a grid, in a file beside that of its elements
};

// Of what files are wanted.
struct Requested {
  int dimension = 2;
  bool has_elements = false;
  GeometryKind kind = GeometryKind::plane;
};

Requested requested_of(const Placement& placement);

// What is wanted of one file: in its format by name, or by extension if that is empty. Where
// elements or facets are in files beside it, these are wishes of their own. Throws
// Error(ErrorKind::argument).
void add_request(const std::string& path, const std::string& format, bool elements,
                 const Requested& of, std::vector<FileRequest>& requests);
// Throws unless HDF5 is there for those that need it. Collective, and agreed.
void require_hdf5_for(const std::vector<FileRequest>& requests, const Communicator& comm);
// Asks the monitor, with the part of all files that is done: Monitoring::asks_to_stop.
using AsksToStop = std::function<bool(double fraction)>;
// Throws Error(ErrorKind::stopped) if it stops; it may be empty. Local.
void give_up_if_asked(const AsksToStop& asks_to_stop, std::size_t done, std::size_t files);

// The files of all ranks appear together, or none. Collective, and agreed.
void publish(const Communicator& comm, std::span<const std::unique_ptr<SharedFile>> files);

// Throws Error(ErrorKind::argument) unless formats have the fields that they cannot do without.
// Local; the fields are the same on all ranks.
void require_fields_for(const std::vector<FileRequest>& requests,
                        const std::vector<OutputField>& fields);

// Names of the pieces of a .pvtu file.
std::string piece_path(const std::string& path, int rank);

// With these fields, in the formats that have room for any. Collective; the monitor may stop it.
void write_files(Placement& placement, const OutputFields& fields,
                 const std::vector<FileRequest>& requests);

}  // namespace pnpbs::io
