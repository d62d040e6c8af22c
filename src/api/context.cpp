// SPDX-License-Identifier: BSD-3-Clause
// C interface: status texts, last errors, versions and contexts.
#include <array>
#include <cmath>
#include <cstring>
#include <exception>

#include "api/guard.hpp"
#include "base/build_config.hpp"
#include "base/build_level.hpp"
#include "base/execution.hpp"
#include "base/kokkos_runtime.hpp"

namespace pnpbs::api {

LastError& thread_error() {
  static thread_local LastError error;
  return error;
}

namespace {

void keep_error(Context* context, const auto& message,
                ErrorReason reason = ErrorReason::other) noexcept {
  try {
    thread_error() = {message, reason};
    if (context) context->last_error = thread_error();
  } catch (...) {  // no memory for the message; the status is still returned
  }
}

// Returns an empty error if there is no memory for a copy.
LastError last_error_of(pnpbs_context context) noexcept {
  try {
    const auto object = contexts().find(context);
    return object ? object->last_error : thread_error();
  } catch (...) {
    return {};
  }
}

void set_context_option(Context& context, const char* key, const auto& assign) {
  require_pointer(key, "key");
  require_not_in_callback(context);
  Options changed = context.options;  // an error leaves the options unchanged
  assign(changed);
  const std::int64_t threads = changed.integer("threads");
  if (std::strcmp(key, "threads") == 0 && kokkos_was_started() && threads != thread_count())
    throw Error(ErrorKind::state, "option threads = " + std::to_string(threads) +
                                      ": Kokkos already runs in this process with " +
                                      std::to_string(thread_count()) +
                                      " threads; set it before the first placement is created");
  context.options = std::move(changed);
}

pnpbs_status create_context(pnpbs_context* handle, const auto& make_communicator) {
  return guarded([&] {
    require_pointer(handle, "context");
    *handle = nullptr;
    const std::shared_ptr<Communicator> communicator = make_communicator();
    pnpbs_context added = nullptr;
    try {
      collective_try(*communicator, [&] {
        auto context = std::make_shared<Context>();
        context->communicator = communicator;
        added = contexts().add(std::move(context));
      });
    } catch (...) {
      if (added) contexts().remove(added);
      throw;
    }
    *handle = added;
    return PNPBS_OK;
  });
}

}  // namespace

void copy_point(const NamedPoint& point, double* output) noexcept {
  if (!output) return;
  for (std::size_t k = 0; k < 3; ++k)
    output[k] = static_cast<int>(k) < point.dimension ? point.x[k] : std::nan("");
}

pnpbs_status status_of(ErrorKind kind) noexcept {
  switch (kind) {
    case ErrorKind::stopped:
      return PNPBS_STOPPED;
    case ErrorKind::argument:
      return PNPBS_ERROR_ARGUMENT;
    case ErrorKind::handle:
      return PNPBS_ERROR_HANDLE;
    case ErrorKind::state:
      return PNPBS_ERROR_STATE;
    case ErrorKind::domain:
      return PNPBS_ERROR_DOMAIN;
    case ErrorKind::spacing:
      return PNPBS_ERROR_SPACING;
    case ErrorKind::key:
      return PNPBS_ERROR_KEY;
    case ErrorKind::capacity:
      return PNPBS_ERROR_CAPACITY;
    case ErrorKind::file:
      return PNPBS_ERROR_FILE;
    case ErrorKind::callback:
      return PNPBS_ERROR_CALLBACK;
    case ErrorKind::memory:
      return PNPBS_ERROR_MEMORY;
    case ErrorKind::mpi:
      return PNPBS_ERROR_MPI;
    case ErrorKind::kokkos:
      return PNPBS_ERROR_KOKKOS;
    case ErrorKind::unsupported:
      return PNPBS_ERROR_UNSUPPORTED;
    case ErrorKind::internal:
      return PNPBS_ERROR_INTERNAL;
  }
  return PNPBS_ERROR_INTERNAL;
}

pnpbs_status report_failure(Context* context) noexcept {
  try {
    throw;
  } catch (const Error& error) {
    keep_error(context, error.message(), error.reason());
    return status_of(error.kind());
  } catch (const std::bad_alloc&) {
    keep_error(context, kOutOfMemory);
    return PNPBS_ERROR_MEMORY;
  } catch (const std::length_error&) {
    keep_error(context, kArrayTooLong);
    return PNPBS_ERROR_MEMORY;
  } catch (const std::exception& error) {
    keep_error(context, error.what());
    return PNPBS_ERROR_INTERNAL;
  } catch (...) {
    keep_error(context, kForeignException);
    return PNPBS_ERROR_CALLBACK;
  }
}

}  // namespace pnpbs::api

using namespace pnpbs;
using namespace pnpbs::api;

const char* pnpbs_status_string(pnpbs_status status) {
  // C programs may pass any number. Reading it as a pnpbs_status outside the list would be
  // undefined behaviour in C++.
  int number = 0;
  static_assert(sizeof number == sizeof status);
  std::memcpy(&number, &status, sizeof number);
  switch (number) {
#define PNPBS_STATUS_CASE(name, value, text) \
  case name:                                 \
    return text;
    PNPBS_STATUS_LIST(PNPBS_STATUS_CASE)
#undef PNPBS_STATUS_CASE
  }
  return "unknown status";
}

const char* pnpbs_last_error(pnpbs_context context) {
  try {
    const auto object = contexts().find(context);
    if (object) {
      object->returned_text = object->last_error.message.text();
      return object->returned_text.c_str();
    }
  } catch (...) {
  }
  return thread_error().message.text().c_str();
}

// These two functions do not change the last error.
pnpbs_status pnpbs_last_error_data(pnpbs_context context, int32_t* reason, int32_t* points) {
  const LastError error = last_error_of(context);
  if (reason) *reason = static_cast<int32_t>(error.reason);
  if (points) *points = static_cast<int32_t>(error.message.points().size());
  return PNPBS_OK;
}

pnpbs_status pnpbs_last_error_point(pnpbs_context context, int32_t index, double* point,
                                    int64_t* begin, int64_t* end) {
  const LastError error = last_error_of(context);
  const std::vector<NamedPoint>& points = error.message.points();
  if (index < 0 || index >= std::ssize(points)) return PNPBS_ERROR_ARGUMENT;
  const NamedPoint& named = points[static_cast<std::size_t>(index)];
  copy_point(named, point);
  if (begin) *begin = static_cast<int64_t>(named.begin);
  if (end) *end = static_cast<int64_t>(named.end);
  return PNPBS_OK;
}

pnpbs_status pnpbs_version(int32_t* major, int32_t* minor, int32_t* patch) {
  if (major) *major = PNPBS_VERSION_MAJOR;
  if (minor) *minor = PNPBS_VERSION_MINOR;
  if (patch) *patch = PNPBS_VERSION_PATCH;
  return PNPBS_OK;
}

const char* pnpbs_build_info(void) {
  static const std::string text =
      std::string("version: ") + PNPBS_VERSION_STRING + "\ncompiler: " + PNPBS_BUILD_COMPILER +
      "\nbuild: " + PNPBS_BUILD_TYPE + build_level() + "\nKokkos: " + PNPBS_KOKKOS_VERSION_TEXT +
      "\nKokkos back end: " + Exec::name() + "\nKokkos linkage: " + PNPBS_KOKKOS_LINKAGE +
      "\nMPI: " + (PNPBS_HAVE_MPI ? PNPBS_MPI_LIBRARY_TEXT : "none") +
      "\nHDF5: " + (PNPBS_HAVE_HDF5 ? PNPBS_HDF5_TEXT : "none") + "\n";
  return text.c_str();
}

const char* pnpbs_mpi_library(void) { return PNPBS_HAVE_MPI ? PNPBS_MPI_LIBRARY_TEXT : ""; }

pnpbs_status pnpbs_context_create_serial(pnpbs_context* context) {
  return create_context(context, [] { return serial_communicator(); });
}

pnpbs_status pnpbs_context_create_f(int32_t comm, pnpbs_context* context) {
  return create_context(context, [&] { return mpi_communicator(comm); });
}

pnpbs_status pnpbs_context_create_checked_f(int32_t comm, const char* library,
                                            pnpbs_context* context) {
  return create_context(context, [&] {
    require_pointer(library, "library");
    require_our_mpi(library);
    return mpi_communicator(comm);
  });
}

pnpbs_status pnpbs_context_destroy(pnpbs_context* context) { return destroy(context, contexts); }

pnpbs_status pnpbs_finalize(void) {
  try {
    require_threads();  // a forked process would wait forever for the calls of other threads
    run_between_calls([] { end_kokkos(); });
    return PNPBS_OK;
  } catch (...) {
    return report_failure(nullptr);
  }
}

pnpbs_status pnpbs_context_set(pnpbs_context context, const char* key, const char* value) {
  return guarded(context, [&](Context& object) {
    require_pointer(value, "value");
    set_context_option(object, key, [&](Options& o) { o.set(key, value); });
    return PNPBS_OK;
  });
}

pnpbs_status pnpbs_context_set_int64(pnpbs_context context, const char* key, int64_t value) {
  return guarded(context, [&](Context& object) {
    set_context_option(object, key, [&](Options& o) { o.set_integer(key, value); });
    return PNPBS_OK;
  });
}

pnpbs_status pnpbs_context_set_double(pnpbs_context context, const char* key, double value) {
  return guarded(context, [&](Context& object) {
    set_context_option(object, key, [&](Options& o) { o.set_real(key, value); });
    return PNPBS_OK;
  });
}
