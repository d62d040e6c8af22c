// SPDX-License-Identifier: BSD-3-Clause
// C interface: output files and checkpoints.
#include <optional>

#include "api/file_requests.hpp"
#include "api/placement_calls.hpp"
#include "io/checkpoint.hpp"
#include "io/temporaries.hpp"
#include "io/write_files.hpp"

using namespace pnpbs;
using namespace pnpbs::api;

pnpbs_status pnpbs_placement_write_files(pnpbs_placement placement, int32_t n,
                                         const char* const* paths, const char* const* formats,
                                         const int32_t* elements) {
  return collective_on_object(placement, [&](PlacementObject& object) {
    const std::vector<io::FileRequest> requests =
        requests_of(n, paths, formats, elements, io::requested_of(*object.placement));
    require_same_requests(object.placement->communicator(), requests);
    io::write_files(*object.placement, object.output_fields, requests);
    return PNPBS_OK;
  });
}

pnpbs_status pnpbs_placement_write(pnpbs_placement placement, const char* path, int32_t elements) {
  return pnpbs_placement_write_files(placement, 1, &path, nullptr, &elements);
}

pnpbs_status pnpbs_placement_add_output_field(pnpbs_placement placement, const char* name,
                                              int64_t n, int32_t components, const double* values) {
  return guarded(placement, [&](PlacementObject& object) {
    const Computing computing(*object.context);
    require_pointer(name, "name");
    object.output_fields.add(object.placement->results(), name, n, components, values);
    return PNPBS_OK;
  });
}

pnpbs_status pnpbs_placement_clear_output_fields(pnpbs_placement placement) {
  return guarded(placement, [&](PlacementObject& object) {
    require_not_in_callback(*object.context);
    object.output_fields.clear();
    return PNPBS_OK;
  });
}

// May also be called by a monitor that is called between two steps.
pnpbs_status pnpbs_placement_write_checkpoint(pnpbs_placement placement, const char* path) {
  return guarded(placement, [&](PlacementObject& object) {
    std::optional<Computing> computing;
    if (!object.context->computing)
      computing.emplace(*object.context);
    else if (!object.placement->monitoring().between_steps())
      throw Error(ErrorKind::state,
                  "from inside a callback, only the monitor can write a checkpoint, when it is "
                  "called between two steps of this placement: not before the first nodes are "
                  "placed, on coarser levels, or in the finish");
    collective_try(object.placement->communicator(), [&] {
      require_pointer(path, "path");
      io::write_checkpoint(*object.placement, path);
    });
    return PNPBS_OK;
  });
}

pnpbs_status pnpbs_placement_read_checkpoint(pnpbs_placement placement, const char* path) {
  return collective(placement, [&](Placement& p) {
    require_pointer(path, "path");
    io::read_checkpoint(p, path);
    return PNPBS_OK;
  });
}

pnpbs_status pnpbs_discard_unfinished_files(void) {
  io::remove_temporaries();
  return PNPBS_OK;
}
