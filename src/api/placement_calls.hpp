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

// A collective call, which may ask callbacks: what fails on one rank, a bad argument even, fails on
// all.
template <class Body>
pnpbs_status collective(pnpbs_placement placement, const Body& body) {
  return local_change(placement, [&](Placement& p) {
    pnpbs_status status = PNPBS_OK;
    agreed(p.communicator(), [&] { status = body(p); });
    return status;
  });
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
