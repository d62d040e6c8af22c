// SPDX-License-Identifier: BSD-3-Clause
// Files by HDF5, as one process lays them out and finds its way in them. The rows of large arrays
// are not written or read here: an array lies in one piece in the file, and its place is told, so
// that every rank can write or read its own rows by itself. No function here communicates.
//
// Every function throws Error(ErrorKind::file) if the file is at fault, and
// Error(ErrorKind::unsupported) if there is no HDF5.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "io/number_type.hpp"

namespace pnpbs::io::hdf5 {

using Type = NumberType;

// An array of rows; with 0 columns it has one dimension, otherwise two.
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
// Throws unless a regular file is there that begins as HDF5 files do.
void require_signature(const std::string& path, const std::string& name);

// A file in the making, in place of one that is there. What it is made of decides its bytes, and
// not the time.
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
  // Room for an array; returns where in the file it begins, of one without rows 0.
  std::int64_t add(const Array& array);
  void add(const std::string& path, const std::vector<std::int64_t>& values);
  void add_reals(const std::string& path, const std::vector<double>& values);
  void close();

 private:
  std::string name_;
  std::int64_t file_ = -1;
};

class OldFile {
 public:
  OldFile(const std::string& path, const std::string& name);
  OldFile(const OldFile&) = delete;
  OldFile& operator=(const OldFile&) = delete;
  ~OldFile();

  bool has(const std::string& path) const;
  void get(const std::string& object, const std::string& attribute, std::int64_t& value) const;
  void get(const std::string& object, const std::string& attribute, double& value) const;
  void get(const std::string& object, const std::string& attribute, std::string& text) const;
  // Where in the file the array begins, if it is just this one.
  std::int64_t place_of(const Array& array) const;
  // Of an array with one dimension.
  std::int64_t rows_of(const std::string& path) const;

 private:
  std::string name_;
  std::int64_t file_ = -1, size_ = 0;
};

}  // namespace pnpbs::io::hdf5
