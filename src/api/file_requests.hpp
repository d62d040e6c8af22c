// SPDX-License-Identifier: BSD-3-Clause
// Output files that the arguments of a call name.
#pragma once

#include <string>
#include <vector>

#include "api/guard.hpp"
#include "io/write_files.hpp"

namespace pnpbs::api {

// Returns the requests of n files. `formats` and `elements` may be NULL. Throws for NULL paths and
// unknown formats.
inline std::vector<io::FileRequest> requests_of(std::int32_t n, const char* const* paths,
                                                const char* const* formats,
                                                const std::int32_t* elements,
                                                const io::Requested& of) {
  require_count(n, "n");
  if (n > 0) require_pointer(paths, "paths");
  std::vector<io::FileRequest> requests;
  for (std::int32_t k = 0; k < n; ++k) {
    const std::string at = "[" + std::to_string(k) + "]";
    require_pointer(paths[k], ("paths" + at).c_str());
    const char* format = formats && formats[k] ? formats[k] : "";
    const std::int32_t wanted = elements ? elements[k] : 0;
    io::add_request(paths[k], format, wanted == 2 ? 2 : wanted != 0 ? 1 : 0, of, requests);
  }
  return requests;
}

// Throws unless all ranks request the same files, since they would wait for each other forever.
// Collective.
inline void require_same_requests(const Communicator& comm,
                                  const std::vector<io::FileRequest>& requests) {
  std::string mine;
  for (const io::FileRequest& request : requests)
    mine += std::string(request.format->name) +
            std::string(static_cast<std::size_t>(request.order), '+') + " " + request.path + "\n";
  Bytes theirs(mine.begin(), mine.end());
  comm.broadcast(theirs, 0);
  collective_try(comm, [&] {
    if (std::string(theirs.begin(), theirs.end()) == mine) return;
    throw Error(ErrorKind::argument,
                "the files to write are not those of rank 0: name the same ones on all ranks");
  });
}

}  // namespace pnpbs::api
