// SPDX-License-Identifier: BSD-3-Clause
#include "io/checkpoint.hpp"

#include "base/error.hpp"
#include "io/checkpoint_parts.hpp"

namespace pnpbs::io {

namespace {

void require_same_path(const Communicator& comm, const std::string& path) {
  Bytes theirs(path.begin(), path.end());
  comm.broadcast(theirs, 0);
  agreed(comm, [&] {
    if (path.empty())
      throw Error(ErrorKind::argument, "argument path: the name of a file is empty");
    if (std::string(theirs.begin(), theirs.end()) != path)
      throw Error(ErrorKind::argument, "argument path = \"" + path +
                                           "\" is not that of rank 0: name the same file on all "
                                           "ranks");
  });
}

}  // namespace

void write_checkpoint(Placement& placement, const std::string& path) {
  const Communicator& comm = placement.communicator();
  require_same_path(comm, path);
  // What one rank cannot do at any step of it, all give up.
  agreed(comm, [&] {
    in_its_dimension(placement,
                     [&]<int Dim>(PlacementOf<Dim>& it) { write_checkpoint_of(it, path); });
  });
}

void read_checkpoint(Placement& placement, const std::string& path) {
  const Communicator& comm = placement.communicator();
  require_same_path(comm, path);
  agreed(comm, [&] {
    in_its_dimension(placement,
                     [&]<int Dim>(PlacementOf<Dim>& it) { read_checkpoint_of(it, path); });
  });
}

}  // namespace pnpbs::io
