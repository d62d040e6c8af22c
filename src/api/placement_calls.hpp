// SPDX-License-Identifier: BSD-3-Clause
// How calls on a placement begin and end.
#pragma once

#include "api/guard.hpp"

namespace pnpbs::api {

// A local call that changes the placement.
template <class Body>
pnpbs_status local_change(pnpbs_placement placement, const Body& body) {
  return guarded(placement, [&](PlacementObject& object) {
    const Computing computing(*object.context);
    return body(*object.placement);
  });
}

// Does collective work on a placement: what fails on one rank, a bad argument even, fails on all.
// Where it fails, ranks may have come to different points, and agree on what is derived by then.
template <class Work>
void agreed_on(Placement& placement, const Work& work) {
  try {
    collective_try(placement.communicator(), work);
  } catch (...) {
    placement.results().agree_on_derived();
    throw;
  }
}

// A collective call, which may ask callbacks.
template <class Body>
pnpbs_status collective_on_object(pnpbs_placement placement, const Body& body) {
  return guarded(placement, [&](PlacementObject& object) {
    const Computing computing(*object.context);
    pnpbs_status status = PNPBS_OK;
    agreed_on(*object.placement, [&] { status = body(object); });
    return status;
  });
}
template <class Body>
pnpbs_status collective(pnpbs_placement placement, const Body& body) {
  return collective_on_object(placement,
                              [&](PlacementObject& object) { return body(*object.placement); });
}

// Creates an object from a placement on all ranks or on none: make(placement object) is a pointer
// to it. `handle` is that of the new object, or NULL. Collective.
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

// The same of what only asks for results.
template <class Body>
pnpbs_status collective_results(pnpbs_placement placement, const Body& body) {
  return collective(placement, [&](Placement& p) { return body(p.results()); });
}

inline void require_capacity(std::int64_t capacity, std::int64_t needed,
                             const std::string& argument = "capacity") {
  require_count(capacity, argument.c_str());
  if (capacity < needed)
    throw Error(ErrorKind::capacity, "argument " + argument + " = " + std::to_string(capacity) +
                                         "; " + std::to_string(needed) + " are needed");
}

// Throws unless the results are of a placement in that dimension.
template <int Dim>
Results<Dim>& require_dimension(NodalResults& results) {
  if (results.dimension() != Dim)
    throw Error(ErrorKind::argument,
                "argument placement has " + std::to_string(results.dimension()) +
                    " dimensions; this function is for " + std::to_string(Dim));
  return static_cast<Results<Dim>&>(results);
}

}  // namespace pnpbs::api
