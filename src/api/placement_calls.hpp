// SPDX-License-Identifier: BSD-3-Clause
// Helpers of the C functions on placements: local and collective calls.
#pragma once

#include "api/guard.hpp"

namespace pnpbs::api {

// Runs body(placement) as a local call that changes the placement.
template <class Body>
pnpbs_status local_change(pnpbs_placement placement, const Body& body) {
  return guarded(placement, [&](PlacementObject& object) {
    const Computing computing(*object.context);
    return body(*object.placement);
  });
}

// Runs collective work on a placement. If it fails on one rank, even because of an argument, all
// ranks throw. Ranks may have failed at different points, so they then agree on which derived data
// are valid. Collective.
template <class Work>
void collective_on(Placement& placement, const Work& work) {
  try {
    collective_try(placement.communicator(), work);
  } catch (...) {
    placement.results().agree_on_derived();
    throw;
  }
}

// Runs body(placement object) as a collective call, which may call callbacks.
template <class Body>
pnpbs_status collective_on_object(pnpbs_placement placement, const Body& body) {
  return guarded(placement, [&](PlacementObject& object) {
    const Computing computing(*object.context);
    pnpbs_status status = PNPBS_OK;
    collective_on(*object.placement, [&] { status = body(object); });
    return status;
  });
}
// Runs body(placement) as a collective call.
template <class Body>
pnpbs_status collective(pnpbs_placement placement, const Body& body) {
  return collective_on_object(placement,
                              [&](PlacementObject& object) { return body(*object.placement); });
}

// Throws Error(ErrorKind::unsupported) if the nodes are those of a periodic domain. `what` is what
// does not exist for it.
inline void require_not_periodic(NodalResults& results, const std::string& what) {
  if (!results.has_nodes()) return;
  pnpbs::visit_dimension(results, [&](const auto& in) {
    if (in.level().geometry.cell().any())
      throw Error(ErrorKind::unsupported, what +
                                              " of a periodic domain: elements at its seams have "
                                              "images of nodes as corners (see "
                                              "pnpbs_domain_set_periodic)");
  });
}

// Creates an object from a placement on all ranks or on none. make(placement object) returns a
// shared pointer to it. `*handle` becomes the handle of the new object, or NULL. Collective.
template <class Object, class Handle, class Make>
pnpbs_status collective_create(pnpbs_placement placement, Handle* handle, const char* argument,
                               Registry<Object, Handle>& (*registry)(), const Make& make) {
  if (handle) *handle = nullptr;
  Handle made = nullptr;
  const pnpbs_status status = collective_on_object(placement, [&](PlacementObject& object) {
    require_pointer(handle, argument);
    made = registry().add(make(object));
    return PNPBS_OK;
  });
  if (status == PNPBS_OK)
    *handle = made;
  else if (made)
    registry().remove(made);
  return status;
}

// Runs body(results) as a collective call.
template <class Body>
pnpbs_status collective_results(pnpbs_placement placement, const Body& body) {
  return collective(placement, [&](Placement& p) { return body(p.results()); });
}

// Throws Error(ErrorKind::capacity) if an array of the caller is too small.
inline void require_capacity(std::int64_t capacity, std::int64_t needed,
                             const std::string& argument = "capacity") {
  require_count(capacity, argument.c_str());
  if (capacity < needed)
    throw Error(ErrorKind::capacity, "argument " + argument + " = " + std::to_string(capacity) +
                                         "; " + std::to_string(needed) + " are needed");
}

// Throws for surfaces alone, which have no regions.
inline void require_inside(const NodalResults& results) {
  if (results.kind() == GeometryKind::surface)
    throw Error(ErrorKind::argument,
                "argument placement has surfaces alone: their tags come with "
                "pnpbs_placement_get_boundary_triangles");
}

// Returns the results of a placement of this dimension. Throws for other placements.
template <int Dim>
Results<Dim>& require_dimension(NodalResults& results) {
  if (results.dimension() != Dim)
    throw Error(ErrorKind::argument,
                "argument placement has " + std::to_string(results.dimension()) +
                    " dimensions; this function is for " + std::to_string(Dim));
  return static_cast<Results<Dim>&>(results);
}

}  // namespace pnpbs::api
