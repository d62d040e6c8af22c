// SPDX-License-Identifier: BSD-3-Clause
// HDF5 files, used by one process. It creates and finds arrays, but does not write or read the rows
// of large ones: an array is contiguous, and its offset in the file is returned, so that every rank
// can access its own rows directly. No function here communicates.
//
// Every function throws Error(ErrorKind::file) if the file has an error, and
// Error(ErrorKind::unsupported) if HDF5 is not available.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "io/number_type.hpp"

namespace pnpbs::io::hdf5 {

using Type = NumberType;

// An array in the file. It is one-dimensional if columns is 0, else two-dimensional.
struct Array {
  std::string path;
  Type type;
  std::int64_t rows;
  std::int64_t columns = 0;

  std::int64_t row_size() const {
    return static_cast<std::int64_t>(size_of(type)) * (columns > 0 ? columns : 1);
  }
};

void require_hdf5();
// Throws unless `path` is a regular file that begins with the signature of HDF5. `name` is its name
// in messages.
void require_signature(const std::string& path, const std::string& name);

// A new file, which replaces an existing one. Its bytes depend on its contents only, not on the
// time.
class NewFile {
 public:
  NewFile(const std::string& path, const std::string& name);  // name: for messages
  NewFile(const NewFile&) = delete;
  NewFile& operator=(const NewFile&) = delete;
  ~NewFile();

  void add_group(const std::string& path);
  void set(const std::string& object, const std::string& attribute, std::int64_t value);
  void set(const std::string& object, const std::string& attribute, double value);
  void set(const std::string& object, const std::string& attribute, const std::string& text);
  void set(const std::string& object, const std::string& attribute,
           const std::vector<std::int64_t>& values);
  void set(const std::string& object, const std::string& attribute,
           const std::vector<double>& values);
  // Allocates an array. Returns its offset in the file, or 0 if it has no rows. [bytes]
  std::int64_t add(const Array& array);
  void add(const std::string& path, const std::vector<std::int64_t>& values);
  void add_reals(const std::string& path, const std::vector<double>& values);
  void close();

 private:
  std::string name_;
  std::int64_t file_ = -1;
};

// An existing file, opened for reading.
class ExistingFile {
 public:
  ExistingFile(const std::string& path, const std::string& name);
  ExistingFile(const ExistingFile&) = delete;
  ExistingFile& operator=(const ExistingFile&) = delete;
  ~ExistingFile();

  bool has(const std::string& path) const;
  void get(const std::string& object, const std::string& attribute, std::int64_t& value) const;
  void get(const std::string& object, const std::string& attribute, double& value) const;
  void get(const std::string& object, const std::string& attribute, std::string& text) const;
  // Returns the offset of the array in the file. Throws unless its type and shape are as given.
  // [bytes]
  std::int64_t place_of(const Array& array) const;
  // Returns the number of rows of a one-dimensional array.
  std::int64_t rows_of(const std::string& path) const;

 private:
  std::string name_;
  std::int64_t file_ = -1, size_ = 0;
};

}  // namespace pnpbs::io::hdf5
