// SPDX-License-Identifier: BSD-3-Clause
// Helpers of the C functions on domains.
#pragma once

#include <string>

#include "api/guard.hpp"

namespace pnpbs::api {

// Returns the plane domain. Throws for domains on a sphere or in space.
inline PlaneDomain& plane_of(const DomainObject& object) {
  if (sphere_of(object).is_sphere())
    throw Error(ErrorKind::argument,
                "argument domain is on a sphere; this function is for domains in the plane");
  if (!object.plane)
    throw Error(ErrorKind::argument,
                "argument domain has three dimensions; this function is for domains in the plane");
  return *object.plane;
}

// Returns the domain in space. Throws for others.
inline VolumeDomain& volume_of(const DomainObject& object) {
  if (!object.volume)
    throw Error(ErrorKind::argument,
                std::string("argument domain ") +
                    (sphere_of(object).is_sphere() ? "is on a sphere" : "has two dimensions") +
                    "; this function is for domains in space");
  return *object.volume;
}

// Calls work(domain) with the concrete type of the domain.
template <class Work>
auto visit_dimension(const DomainObject& object, const Work& work) {
  return object.plane ? work(*object.plane) : work(*object.volume);
}

// Changes the definition of a domain of any dimension and discards what was derived from its shape.
template <class Change>
pnpbs_status change_domain(pnpbs_domain domain, const Change& change) {
  return guarded(domain, [&](DomainObject& object) {
    const Computing computing(*object.context);
    change(object);
    object.plane_shapes.reset();
    object.volume_shapes.reset();
    return PNPBS_OK;
  });
}

// Changes a plane domain likewise. Fails for other domains.
template <class Change>
pnpbs_status change_plane(pnpbs_domain domain, const Change& change) {
  return change_domain(domain, [&](DomainObject& object) { change(plane_of(object)); });
}

// Changes a domain in space likewise. Fails for other domains.
template <class Change>
pnpbs_status change_volume(pnpbs_domain domain, const Change& change) {
  return change_domain(domain, [&](DomainObject& object) { change(volume_of(object)); });
}

// Returns the domain `body` for use with another one. Throws unless it belongs to the context, has
// the required dimension and is not on a sphere.
inline std::shared_ptr<DomainObject> body_with(const Context& context, bool in_plane,
                                               pnpbs_domain body) {
  require_pointer(body, "body");
  std::shared_ptr<DomainObject> object = require(body);
  if (object->context.get() != &context)
    throw Error(ErrorKind::argument, "argument body belongs to another context");
  if (sphere_of(*object).is_sphere())
    throw Error(ErrorKind::argument, "argument body is on a sphere");
  if ((object->plane != nullptr) != in_plane)
    throw Error(ErrorKind::argument, std::string("argument body has ") +
                                         (object->plane ? "two" : "three") +
                                         " dimensions, expected " + (in_plane ? "two" : "three"));
  return object;
}

inline CurveRole role_from(int32_t role) {
  if (role == PNPBS_BOUNDARY) return CurveRole::boundary;
  if (role == PNPBS_INNER) return CurveRole::inner;
  throw Error(ErrorKind::argument, "role is " + std::to_string(role) +
                                       ", expected PNPBS_BOUNDARY (0) or PNPBS_INNER (1)");
}

inline SurfaceRole surface_role_from(int32_t role) {
  return role_from(role) == CurveRole::boundary ? SurfaceRole::boundary : SurfaceRole::inner;
}

}  // namespace pnpbs::api
