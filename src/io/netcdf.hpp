// SPDX-License-Identifier: BSD-3-Clause
// Headers of NetCDF files in 64-bit data format (CDF-5, which NetCDF 4.4 and PnetCDF read), without
// record variables (The NetCDF classic format specification, docs.unidata.ucar.edu/netcdf-c). The
// arrays of the variables follow the header without gaps, in big-endian byte order.
#pragma once

#include <cstdint>
#include <string>
#include <variant>
#include <vector>

#include "io/number_type.hpp"

namespace pnpbs::io {

struct NetcdfDimension {
  std::string name;
  std::int64_t size;
};

struct NetcdfAttribute {
  std::string name;
  std::variant<std::string, double, std::int32_t> value;
};

struct NetcdfVariable {
  std::string name;
  NumberType type;                      // int32, real or real32
  std::vector<std::size_t> dimensions;  // indices in the list of dimensions
  std::vector<NetcdfAttribute> attributes;
};

struct NetcdfContents {
  std::vector<NetcdfDimension> dimensions;
  std::vector<NetcdfAttribute> attributes;
  std::vector<NetcdfVariable> variables;
};

// Returns the header.
std::string netcdf_head(const NetcdfContents& contents);

// Reverse the bytes of each value on a little-endian processor.
void make_big_endian(std::vector<std::int32_t>& values);
void make_big_endian(std::vector<double>& values);
void make_big_endian(std::vector<float>& values);

}  // namespace pnpbs::io
