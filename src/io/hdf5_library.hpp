// SPDX-License-Identifier: BSD-3-Clause
// Access to the HDF5 library, which is opened at run time: its functions, a lock for one thread at
// a time, and owners of its objects. Only in builds with HDF5.
#pragma once

#include <hdf5.h>

#include <array>
#include <mutex>
#include <string>

#include "base/error.hpp"
#include "io/hdf5.hpp"

// HDF5's macros for constants call H5open() and H5check(), to which the library is not linked.
#undef H5OPEN
#define H5OPEN
#undef H5CHECK
#define H5CHECK

namespace pnpbs::io::hdf5 {

#define PNPBS_HDF5_FUNCTIONS(X) \
  X(H5open)                     \
  X(H5get_libversion)           \
  X(H5Eget_auto2)               \
  X(H5Eset_auto2)               \
  X(H5Fcreate)                  \
  X(H5Fopen)                    \
  X(H5Fclose)                   \
  X(H5Pcreate)                  \
  X(H5Pclose)                   \
  X(H5Pset_libver_bounds)       \
  X(H5Pset_obj_track_times)     \
  X(H5Pset_alloc_time)          \
  X(H5Pset_fill_time)           \
  X(H5Pget_layout)              \
  X(H5Pget_external_count)      \
  X(H5Gcreate2)                 \
  X(H5Gclose)                   \
  X(H5Lexists)                  \
  X(H5Screate)                  \
  X(H5Screate_simple)           \
  X(H5Sclose)                   \
  X(H5Sget_simple_extent_type)  \
  X(H5Sget_simple_extent_ndims) \
  X(H5Sget_simple_extent_dims)  \
  X(H5Dcreate2)                 \
  X(H5Dopen2)                   \
  X(H5Dclose)                   \
  X(H5Dwrite)                   \
  X(H5Dget_offset)              \
  X(H5Dget_space)               \
  X(H5Dget_type)                \
  X(H5Dget_create_plist)        \
  X(H5Dget_storage_size)        \
  X(H5Acreate_by_name)          \
  X(H5Aopen_by_name)            \
  X(H5Aclose)                   \
  X(H5Awrite)                   \
  X(H5Aread)                    \
  X(H5Aget_type)                \
  X(H5Aget_space)               \
  X(H5Tcopy)                    \
  X(H5Tclose)                   \
  X(H5Tequal)                   \
  X(H5Tset_size)                \
  X(H5Tget_size)                \
  X(H5Tget_class)               \
  X(H5Tis_variable_str)

// The functions and identifiers of the opened library.
struct Library {
#define PNPBS_HDF5_MEMBER(name) decltype(&::name) name;
  PNPBS_HDF5_FUNCTIONS(PNPBS_HDF5_MEMBER)
#undef PNPBS_HDF5_MEMBER
  std::array<hid_t, 6> types;  // indexed by Type
  hid_t text, file_access, file_creation, group_creation, dataset_creation;
};

// Exclusive use of HDF5 by one thread, since few builds are thread-safe. Errors are reported by
// return values. The error handler, which prints, is disabled, and restored in the end for a host
// program that uses the same library.
class Use {
 public:
  Use() : lock_(mutex()), h_(library()) {
    h_.H5Eget_auto2(H5E_DEFAULT, &handler_, &data_);
    h_.H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr);
  }
  Use(const Use&) = delete;
  Use& operator=(const Use&) = delete;
  ~Use() { h_.H5Eset_auto2(H5E_DEFAULT, handler_, data_); }
  const Library* operator->() const { return &h_; }

 private:
  static std::mutex& mutex();
  static const Library& library();

  std::lock_guard<std::mutex> lock_;
  const Library& h_;
  H5E_auto2_t handler_ = nullptr;
  void* data_ = nullptr;
};

// An HDF5 object that is closed with this object. The constructor throws if the identifier is
// invalid.
class Owned {
 public:
  Owned(hid_t id, herr_t (*close)(hid_t), const std::string& failure) : id_(id), close_(close) {
    if (id < 0) throw Error(ErrorKind::file, failure);
  }
  Owned(const Owned&) = delete;
  Owned& operator=(const Owned&) = delete;
  ~Owned() { close_(id_); }
  operator hid_t() const { return id_; }

 private:
  hid_t id_;
  herr_t (*close_)(hid_t);
};

inline void require(herr_t code, const std::string& failure) {
  if (code < 0) throw Error(ErrorKind::file, failure);
}

inline hid_t type_of(const Use& use, Type type) {
  return use->types[static_cast<std::size_t>(type)];
}

}  // namespace pnpbs::io::hdf5
