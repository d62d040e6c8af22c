// SPDX-License-Identifier: BSD-3-Clause
// The frame of every C call: conversion of exceptions to a status and a message.
#pragma once

#include <new>
#include <string>

#include "api/calls_in_progress.hpp"
#include "api/floating_point.hpp"
#include "api/handles.hpp"
#include "base/message_text.hpp"

namespace pnpbs::api {

// Returns the last error of the calling thread, for calls without a live context.
LastError& thread_error();

pnpbs_status status_of(ErrorKind kind) noexcept;

// Returns the embedding of an object on a sphere, or the identity for other objects. Messages name
// points by their coordinates in the chart, and users see longitude and latitude instead.
template <class Object>
Embedding<2> sphere_of(const Object&) {
  return {};
}
inline Embedding<2> sphere_of(const DomainObject& object) {
  return object.plane ? object.plane->embedding() : Embedding<2>();
}
Embedding<2> sphere_of(const PlacementObject& object);
// Returns the message with each point of the chart replaced by longitude and latitude. The points
// of the result are points of the sphere in space.
MessageText in_degrees(const Embedding<2>& sphere, const MessageText& message);
// Converts the last error of the context in this way. Without memory for it the error stays as it
// is.
void convert_to_degrees(const Embedding<2>& sphere, Context& context) noexcept;

// Writes three coordinates; the third is NaN in the plane. Does nothing if `output` is NULL.
void copy_point(const NamedPoint& point, double* output) noexcept;

// Stores the message of the current exception as the last error and returns its status. Must be
// called in a catch block.
pnpbs_status report_failure(Context* context) noexcept;

inline void require_pointer(const void* pointer, const char* argument) {
  if (!pointer) throw Error(ErrorKind::argument, std::string("argument ") + argument + " is NULL");
}

inline void require_count(std::int64_t count, const char* argument) {
  if (count < 0)
    throw Error(ErrorKind::argument, std::string("argument ") + argument + " = " +
                                         std::to_string(count) + " is negative");
}

// Throws Error(ErrorKind::state) while a call that may run callbacks is in progress.
inline void require_not_in_callback(const Context& context) {
  if (context.computing)
    throw Error(ErrorKind::state,
                "a computation on this context is in progress: from inside a callback only "
                "queries are allowed");
}

// A scope in which callbacks may run. Throws if the context is computing already.
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

// Runs the body of a call without a live context.
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

// Runs body(object) as a call on a handle. Throws nothing: errors become the last error of the
// context and a status.
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
      convert_to_degrees(sphere_of(*object), *context);
      return status;
    }
  } catch (...) {
    return report_failure(nullptr);
  }
}

// Removes the object of a handle from its registry and sets the handle to NULL. Does nothing if it
// is NULL.
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
