// SPDX-License-Identifier: BSD-3-Clause
// Damages hundreds of files with values at points. Reading each must return values from which a
// spacing can be built, or fail with a message. It must not crash, hang or allocate memory for data
// that the file does not have.
//
// The bytes under test are kept in mutate_field.bytes in the working folder in case of a crash.
// More mutations by hand: PNPBS_MUTATIONS=40000 PNPBS_SEED=7 mutate_field
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <string>
#include <vector>

#include "base/error.hpp"
#include "damage.hpp"
#include "largest_request.hpp"
#include "spacing/files/field_file.hpp"
#include "spacing/files/inflate.hpp"

namespace {

using Parse = pnpbs::FileField (*)(std::string_view, const std::string&, const std::string&);

struct Sample {
  const char* name;
  Parse parse;
  std::string bytes;
};

const char* const table = R"(x,y,z,id,spacing
0,0,0,1,0.1
1,0,0,2,0.2
1,1,0.5,3,0.1
0,1,0.5,4,0.3
0.5,0.5,0.25,5,0.15
)";

const char* const mesh_22 = R"($MeshFormat
2.2 0 8
$EndMeshFormat
$Nodes
5
1 0 0 0
2 1 0 0
3 0 1 0
4 0 0 1
5 1 1 1
$EndNodes
$Elements
4
1 2 2 0 1 1 2 3
2 4 2 0 1 1 2 3 4
3 4 2 0 1 2 3 4 5
4 3 2 0 1 1 2 5 3
$EndElements
$NodeData
1
"spacing"
1
0.0
3
0
1
5
1 0.1
2 0.2
3 0.1
4 0.3
5 0.2
$EndNodeData
)";

const char* const grid_text = R"(<?xml version="1.0"?>
<VTKFile type="UnstructuredGrid" version="0.1" byte_order="LittleEndian">
<!-- a comment -->
<UnstructuredGrid>
<Piece NumberOfPoints="5" NumberOfCells="3">
<PointData Scalars="spacing">
<DataArray type="Float64" Name="spacing" format="ascii">
0.1 0.2 0.1 0.3 0.2
<InformationKey name="L2_NORM_RANGE" location="vtkDataArray" length="2">
<Value index="0">0.1</Value></InformationKey>
</DataArray>
</PointData>
<Points>
<DataArray type="Float32" Name="Points" NumberOfComponents="3" format="ascii">
0 0 0 1 0 0 0 1 0 0 0 1 1 1 1
</DataArray>
</Points>
<Cells>
<DataArray type="Int64" Name="connectivity" format="ascii">0 1 2 3 1 2 3 4 0 1 2</DataArray>
<DataArray type="Int64" Name="offsets" format="ascii">4 8 11</DataArray>
<DataArray type="UInt8" Name="types" format="ascii">10 10 5</DataArray>
</Cells>
</Piece>
</UnstructuredGrid>
</VTKFile>
)";

template <class Number>
std::string bytes_of(const std::vector<Number>& numbers) {
  return {reinterpret_cast<const char*>(numbers.data()), numbers.size() * sizeof(Number)};
}

// Returns the bytes in zlib's format without compression.
std::string stored(const std::string& bytes) {
  std::uint32_t a = 1, b = 0;
  for (const char c : bytes) {
    a = (a + static_cast<unsigned char>(c)) % 65521;
    b = (b + a) % 65521;
  }
  const auto size = static_cast<std::uint16_t>(bytes.size());
  std::string packed("\x78\x01\x01", 3);
  packed += bytes_of(std::vector<std::uint16_t>{size, static_cast<std::uint16_t>(~size)}) + bytes;
  for (const std::uint32_t sum : {b, a}) {
    packed += static_cast<char>(sum >> 8);
    packed += static_cast<char>(sum & 255);
  }
  return packed;
}

// Returns the same grid with its arrays appended as raw bytes.
std::string grid_appended(bool packed) {
  const std::vector<std::string> arrays{
      bytes_of(std::vector<double>{0.1, 0.2, 0.1, 0.3, 0.2}),
      bytes_of(std::vector<float>{0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1, 1, 1, 1}),
      bytes_of(std::vector<std::int64_t>{0, 1, 2, 3, 1, 2, 3, 4, 0, 1, 2}),
      bytes_of(std::vector<std::int64_t>{4, 8, 11}),
      bytes_of(std::vector<std::uint8_t>{10, 10, 5})};
  std::string data;
  std::vector<std::size_t> offsets;
  for (const std::string& array : arrays) {
    offsets.push_back(data.size());
    const std::string body = packed ? stored(array) : array;
    std::vector<std::uint64_t> header{array.size()};
    if (packed) header = {1, array.size(), 0, body.size()};
    data += bytes_of(header) + body;
  }
  const auto array = [&](const char* type, const char* name, std::size_t k) {
    return std::string("<DataArray type=\"") + type + "\" Name=\"" + name +
           (k == 1 ? "\" NumberOfComponents=\"3" : "") + "\" format=\"appended\" offset=\"" +
           std::to_string(offsets[k]) + "\"/>\n";
  };
  return std::string("<VTKFile type=\"UnstructuredGrid\" header_type=\"UInt64\"") +
         (packed ? " compressor=\"vtkZLibDataCompressor\"" : "") +
         ">\n<UnstructuredGrid>\n<Piece NumberOfPoints=\"5\" NumberOfCells=\"3\">\n<PointData>" +
         array("Float64", "spacing", 0) + "</PointData>\n<Points>" + array("Float32", "Points", 1) +
         "</Points>\n<Cells>" + array("Int64", "connectivity", 2) + array("Int64", "offsets", 3) +
         array("UInt8", "types", 4) +
         "</Cells>\n</Piece>\n</UnstructuredGrid>\n<AppendedData encoding=\"raw\">\n_" + data +
         "\n</AppendedData>\n</VTKFile>\n";
}

// Returns what is wrong with values that were read, or nullptr.
template <int Dim>
const char* fault_in(const pnpbs::FileField& file) {
  const pnpbs::GivenField<Dim> field = pnpbs::given_field<pnpbs::GivenField<Dim>>(file, "mutated");
  if (field.values.size() != field.points.size()) return "values of other points";
  for (const auto& element : field.elements)
    for (const std::int32_t corner : element)
      if (corner < 0 || corner >= std::ssize(field.points)) return "a corner that is no point";
  pnpbs::Box<Dim> box;
  box.low.fill(0), box.high.fill(1);
  const auto spacing = pnpbs::spacing_from_field(field, box);
  return spacing ? nullptr : "no spacing";
}

struct Tally {
  std::uint64_t read = 0, refused = 0;
};

// Reads the bytes. Prints what is wrong and returns false if the result is invalid.
bool examine(const Sample& sample, const std::string& bytes, Tally& tally) {
  const char* fault = nullptr;
  std::string message;
  largest_request = 0;
  try {
    const pnpbs::FileField file = sample.parse(bytes, "mutated", "");
    fault = fault_in<3>(file);
    if (!fault) fault = fault_in<2>(file);
    ++tally.read;
  } catch (const pnpbs::Error& error) {
    message = error.what();
    const bool of_file =
        error.kind() == pnpbs::ErrorKind::file || error.kind() == pnpbs::ErrorKind::spacing;
    if (!of_file || !message.starts_with("mutated:")) fault = "not a file's error";
    ++tally.refused;
  } catch (const std::exception& error) {
    message = error.what();
    fault = "not an error of ours";
  }
  if (largest_request > 1100 * bytes.size() + 10000) fault = "more memory than bytes account for";
  if (fault) std::printf("%s: %s: %s\n", sample.name, fault, message.c_str());
  return fault == nullptr;
}

bool examine_mutations(const Sample& sample, std::uint64_t mutations, std::uint64_t seed) {
  Damage damage(seed);
  Tally tally;
  if (!examine(sample, sample.bytes, tally) || tally.read != 1) {
    std::printf("%s: not read undamaged\n", sample.name);
    return false;
  }
  for (std::uint64_t i = 0; i < mutations; ++i) {
    const std::string bytes = i % 2 == 0 ? damage.to(sample.bytes) : damage.to_bytes(sample.bytes);
    std::ofstream(PNPBS_TEST_WORK_DIR "/mutate_field.bytes", std::ios::binary) << bytes;
    if (!examine(sample, bytes, tally)) return false;
  }
  std::printf("%s: %llu read, %llu refused\n", sample.name,
              static_cast<unsigned long long>(tally.read),
              static_cast<unsigned long long>(tally.refused));
  return mutations < 50 || (tally.read > mutations / 50 && tally.refused > mutations / 50);
}

// Checks data compressed by zlib with dynamic codes and back references.
bool unpacks() {
  // python3 -c "import zlib; print(zlib.compress(bytes(i * i % 251 for i in range(60)) * 20, 9))"
  static const unsigned char packed[] = {
      0x78, 0xda, 0x63, 0x60, 0x64, 0xe1, 0x14, 0x90, 0x54, 0x31, 0x74, 0x08, 0x4c, 0xa9,
      0x9c, 0xb0, 0xf2, 0xc8, 0x43, 0x56, 0x35, 0xcf, 0xbc, 0xa9, 0xfb, 0x5e, 0x4a, 0x7b,
      0x55, 0xaf, 0x7b, 0x2c, 0x1f, 0x31, 0xf9, 0x82, 0x48, 0xe8, 0x8c, 0xbb, 0x9a, 0x45,
      0x7b, 0xf9, 0xe3, 0xd6, 0xb3, 0xc7, 0x6c, 0x16, 0xcc, 0x39, 0xa9, 0xdb, 0xf7, 0x31,
      0xfa, 0x90, 0xc1, 0x6c, 0xde, 0x9a, 0xb7, 0xa9, 0xb7, 0x18, 0x46, 0xf5, 0x8e, 0xea,
      0x1d, 0xd5, 0x3b, 0xaa, 0x97, 0x8e, 0x7a, 0x01, 0xac, 0x21, 0xf8, 0x70};
  const std::string_view bytes(reinterpret_cast<const char*>(packed), sizeof packed);
  std::string expected;
  for (int k = 0; k < 20; ++k)
    for (int i = 0; i < 60; ++i) expected += static_cast<char>(i * i % 251);
  if (pnpbs::inflated(bytes, expected.size()) != expected) return false;
  if (pnpbs::inflated(bytes, expected.size() - 1) || pnpbs::inflated(bytes, expected.size() + 1))
    return false;
  // Damage must be detected, at the latest by the checksum at the end.
  for (std::size_t i = 0; i < sizeof packed; ++i) {
    std::string damaged(bytes);
    damaged[i] = static_cast<char>(damaged[i] ^ 4);
    const auto result = pnpbs::inflated(damaged, expected.size());
    if (result && *result != expected) return false;
  }
  return true;
}

}  // namespace

int main() {
  const std::vector<Sample> all{{".csv", pnpbs::parse_csv_field, table},
                                {".msh", pnpbs::parse_msh_field, mesh_22},
                                {".vtu, text", pnpbs::parse_vtu_field, grid_text},
                                {".vtu, raw", pnpbs::parse_vtu_field, grid_appended(false)},
                                {".vtu, packed", pnpbs::parse_vtu_field, grid_appended(true)}};
  const std::uint64_t mutations = from_environment("PNPBS_MUTATIONS", 400);
  std::uint64_t seed = from_environment("PNPBS_SEED", 0);
  bool good = unpacks();
  if (!good) std::printf("what zlib packed does not unpack\n");
  for (const Sample& sample : all) good = examine_mutations(sample, mutations, ++seed) && good;
  return good ? EXIT_SUCCESS : EXIT_FAILURE;
}
