// SPDX-License-Identifier: BSD-3-Clause
// The way from a C call into the library and back: exceptions become a status and a message.
#pragma once

#include <new>
#include <string>

#include "api/calls_in_progress.hpp"
#include "api/floating_point.hpp"
#include "api/handles.hpp"
#include "base/message_text.hpp"

namespace pnpbs::api {

// The calling thread's last error, for calls that have no live context.
LastError& thread_error();

pnpbs_status status_of(ErrorKind kind) noexcept;

// Returns how an object lies on a sphere; the identity if it is on none. Messages name points by
// the chart of the sphere, and users want to know longitude and latitude.
template <class Object>
Embedding<2> sphere_of(const Object&) {
  return {};
}
inline Embedding<2> sphere_of(const DomainObject& object) {
  return object.plane ? object.plane->embedding() : Embedding<2>();
}
Embedding<2> sphere_of(const PlacementObject& object);
// Returns the message with longitude and latitude for the points of the chart in it, which become
// points of the sphere in space.
MessageText in_degrees(const Embedding<2>& sphere, const MessageText& message);
void tell_in_degrees(const Embedding<2>& sphere, Context& context) noexcept;

// [3], NaN for the third coordinate in the plane. Nothing if `output` is null.
void copy_point(const NamedPoint& point, double* output) noexcept;

// Turns the exception in flight into a status; puts the message where last_error finds it.
pnpbs_status report_failure(Context* context) noexcept;

inline void require_pointer(const void* pointer, const char* argument) {
  if (!pointer) throw Error(ErrorKind::argument, std::string("argument ") + argument + " is NULL");
}

inline void require_count(std::int64_t count, const char* argument) {
  if (count < 0)
    throw Error(ErrorKind::argument, std::string("argument ") + argument + " = " +
                                         std::to_string(count) + " is negative");
}

inline void require_not_in_callback(const Context& context) {
  if (context.computing)
    throw Error(ErrorKind::state,
                "a computation on this context is in progress: from inside a callback only "
                "queries are allowed");
}

// Marks the context as computing while callbacks may run.
class Computing {
 public:
  explicit Computing(Context& context) : context_(context) {
    require_not_in_callback(context);
    context_.computing = true;
  }
  Computing(const Computing&) = delete;
  Computing& operator=(const Computing&) = delete;
  ~Computing() { context_.computing = false; }

 private:
  Context& context_;
};

// A call without a live context.
template <class Body>
pnpbs_status guarded(const Body& body) noexcept {
  const DefaultArithmetic arithmetic;
  try {
    const CallInProgress call;
    return body();
  } catch (...) {
    return report_failure(nullptr);
  }
}

inline Context& context_of(Context& object) { return object; }
template <class Object>
Context& context_of(Object& object) {
  return *object.context;
}

// A call on a handle: body(object).
template <class Handle, class Body>
pnpbs_status guarded(
    Handle handle, const Body& body,
    CallInProgress::WhileEnding while_ending = CallInProgress::WhileEnding::throws) noexcept {
  const DefaultArithmetic arithmetic;
  Context* context = nullptr;
  try {
    const CallInProgress call(while_ending);
    const auto object = require(handle);
    context = &context_of(*object);
    try {
      return body(*object);
    } catch (...) {
      const pnpbs_status status = report_failure(context);
      tell_in_degrees(sphere_of(*object), *context);
      return status;
    }
  } catch (...) {
    return report_failure(nullptr);
  }
}

// Removes what the handle stands for from its registry, and makes it NULL; nothing if it is NULL.
template <class Object, class Handle>
pnpbs_status destroy(Handle* handle, Registry<Object, Handle>& (*registry)()) noexcept {
  if (!handle || !*handle) return PNPBS_OK;
  const auto remove = [&](Object& object) {
    require_not_in_callback(context_of(object));
    registry().remove(*handle);
    *handle = nullptr;
    return PNPBS_OK;
  };
  return guarded(*handle, remove, CallInProgress::WhileEnding::waits);
}

}  // namespace pnpbs::api
