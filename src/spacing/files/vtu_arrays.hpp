// SPDX-License-Identifier: BSD-3-Clause
// Reader of the arrays of a VTK XML file, which are found by name and read one by one. They may be
// text, base64 or raw bytes, inline or appended, compressed by zlib or not (VTK file formats,
// https://docs.vtk.org/en/latest/design_documents/VTKFileFormats.html).
#pragma once

#include <bit>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "base/error.hpp"

namespace pnpbs {

class ByteSource;
class XmlTags;

// The description of an array, and its content if that is inline.
struct VtuArray {
  std::string section, name, type;  // section: "Points", "Cells" or "PointData"
  std::int64_t components = 1;
  std::string format;
  std::uint64_t offset = 0;
  std::string_view content;
};

// A piece of an unstructured grid.
struct VtuPiece {
  std::int64_t points = 0, cells = 0;
  std::vector<VtuArray> arrays;
};

// A parsed VTK XML file of an unstructured grid.
class VtuFile {
 public:
  // Parses the file. `bytes` must outlive this object. Throws Error(ErrorKind::file).
  VtuFile(std::string_view bytes, std::string name);

  const std::vector<VtuPiece>& pieces() const { return pieces_; }

  // Returns the array, or null if the piece has none with this section and name.
  const VtuArray* find(const VtuPiece& piece, std::string_view section,
                       std::string_view name) const;
  // Returns the numbers of an array with this number of tuples, converted to double from any type.
  // Integers are exact up to 2^53. Throws Error(ErrorKind::file).
  std::vector<double> read(const VtuArray& array, std::int64_t tuples) const;

  [[noreturn]] void fail(const std::string& message) const {
    throw Error(ErrorKind::file, name_ + ": " + message);
  }

 private:
  void take_header(const XmlTags& xml);
  static VtuArray array_of(const XmlTags& xml, const std::string& section);
  void take_appended(const XmlTags& xml);
  std::vector<double> read_text(const VtuArray& array, std::size_t count) const;
  std::string read_bytes(const VtuArray& array, std::size_t bytes) const;
  std::string read_plain(const VtuArray& array, ByteSource& source, std::size_t bytes) const;
  std::string read_packed(const VtuArray& array, ByteSource& source, std::size_t bytes) const;
  std::uint64_t word(ByteSource& source, const VtuArray& array) const;
  std::string called(const VtuArray& array) const;

  std::string name_;
  std::vector<VtuPiece> pieces_;
  std::endian order_ = std::endian::little;
  std::size_t word_size_ = 4;  // bytes of a number in headers
  bool packed_ = false, appended_raw_ = true;
  std::string_view appended_;
};

}  // namespace pnpbs
