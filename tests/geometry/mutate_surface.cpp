// SPDX-License-Identifier: BSD-3-Clause
// Damages thousands of surface files. Reading each must return triangles of its vertices, or fail
// with a message. It must not crash, hang or allocate memory for data that the file does not have.
//
// The bytes under test are kept in mutate_surface.bytes in the working folder in case of a crash.
// More mutations by hand, of each format or of files: PNPBS_MUTATIONS=40000 PNPBS_SEED=7
// mutate_surface [file]...
#include <algorithm>
#include <chrono>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <iterator>
#include <optional>
#include <string>
#include <vector>

#include "base/error.hpp"
#include "base/limits.hpp"
#include "damage.hpp"
#include "domain/from_files.hpp"
#include "formats/surface_formats.hpp"
#include "largest_request.hpp"
#include "msh_files.hpp"
#include "surface_files.hpp"

namespace {

using pnpbs::SurfaceFormat;
using pnpbs::SurfaceTriangles;

struct Sample {
  std::string name;
  std::optional<SurfaceFormat> format;  // none: Gmsh's format
  std::string bytes;
};

// A file with nonconvex polygons, names, markers and a hole.
const char* const prism_off = R"(OFF
12 8 0
0 0 0
2 0 0
2 1 0
1 1 0
1 2 0
0 2 0
0 0 1
2 0 1
2 1 1
1 1 1
1 2 1
0 2 1
6 0 5 4 3 2 1
6 6 7 8 9 10 11 255 0 0
4 0 1 7 6
4 1 2 8 7
4 2 3 9 8
4 3 4 10 9
4 4 5 11 10
4 5 0 6 11
)";

const char* const pyramid_obj = R"(mtllib pyramid.mtl
o pyramid
v 0 0 0
v 1 0 0
v 1 1 0 1.0
v 0 1 0
v 0.5 0.5 1
g base
usemtl stone
f 4/1 3/2 2/3 1/4
g sides
f 1//1 2//1 5//1
f 2/1/1 3/2/1 5/3/1
f -3 -2 -1
usemtl sand
f 4 1 \
 5
)";

const char* const tetrahedra_poly = R"(# one in the other
8 3 1 1
1 0 0 0 7.5 0
2 9 0 0 1.5 0
3 0 9 0 0 0
4 0 0 9 0 0
5 1 1 1 0 0
6 2 1 1 0 0
7 1 2 1 0 0
8 1 1 2 0 0
7 1
1 0 5
3 1 3 2
1 0 0
3 1 2 4
1 0 -6
3 2 3 4
1 0 7
3 3 1
  4
2 0 8
3 5 6 7
3 5 8 6
1 0 8
3 6 8 7
1 0 8
3 7 8 5
1
1 1.1 1.2 1.3
1
1 5 5 5 17 0.1
)";

const char* const triangle_ply = R"(ply
format ascii 1.0
comment all that there may be
element material 2
property list uchar double v
property float e
element vertex 4
property uchar red
property double z
property float y
property list ushort char names
property float x
element face 2
property float area
property list int uint vertex_index
end_header
2 0.5 0.25 1
0 7
255 -1 0 0 0
255 -1 0 2 65 66 2.5
0 300 0.5 0 0
0 300 0.5 1 67 0.5
0.1 3 2 1 0
0.2 4 0 1 3 2
)";

std::optional<SurfaceFormat> format_of(const std::string& path) {
  if (pnpbs::is_msh(path)) return std::nullopt;
  return pnpbs::surface_format(path);
}

// Adds a tetrahedron in a cube with a curve and a point, and a square with a hole.
void add_meshes(std::vector<Sample>& samples) {
  using msh_files::Kind;
  msh_files::Mesh body = msh_files::cube();
  body.elements.push_back({1, 21, 31, {1, 8}});
  body.elements.push_back({15, 22, 32, {8}});
  body.elements.push_back({4, 23, 33, {1, 2, 3, 5}});
  auto entities = msh_files::sides_of_cube();
  entities.push_back({3, 33, 23, {1, 2, 3, 4, 5, 6}});
  msh_files::Mesh square;
  for (const double size : {3.0, 1.0})
    for (int i = 0; i < 4; ++i)
      square.nodes.push_back({(i % 3 == 0 ? -1 : 1) * size, (i < 2 ? -1 : 1) * size, 0});
  square.names = "1 5 \"rim\"\n";
  square.first_node = 7;
  square.step = 3;
  for (std::int32_t i = 1; i < 5; ++i) {
    const std::int32_t next = i % 4 + 1;
    square.elements.push_back({1, 5, 5, {i, next}});
    square.elements.push_back({3, 6, 6, {i, next, next + 4, i + 4}});
  }
  const std::vector<msh_files::Entity> plane{{1, 5, 5, {}}, {2, 6, 6, {5}}};
  for (const Kind kind : {Kind::text, Kind::little_endian, Kind::big_endian}) {
    const std::string name = kind == Kind::text ? "text" : "binary";
    samples.push_back({"4.1, body, " + name, {}, version_41(body, entities, kind)});
    samples.push_back({"2.2, body, " + name, {}, version_22(body, kind)});
    samples.push_back({"4.1, square, " + name, {}, version_41(square, plane, kind)});
    samples.push_back({"2.2, square, " + name, {}, version_22(square, kind)});
  }
}

std::vector<Sample> samples(int count, char** paths) {
  std::vector<Sample> result;
  for (int i = 0; i < count; ++i) {
    std::ifstream file(paths[i], std::ios::binary);
    result.push_back({paths[i], format_of(paths[i]), {std::istreambuf_iterator<char>(file), {}}});
  }
  if (!result.empty()) return result;
  for (auto& [format, bytes] : surface_files::all(surface_files::box()))
    result.push_back({"box", format, std::move(bytes)});
  result.push_back({"prism.off", SurfaceFormat::off, prism_off});
  result.push_back({"pyramid.obj", SurfaceFormat::obj, pyramid_obj});
  result.push_back({"tetrahedra.poly", SurfaceFormat::poly, tetrahedra_poly});
  result.push_back({"triangle.ply", SurfaceFormat::ply, triangle_ply});
  add_meshes(result);
  return result;
}

// Returns what is wrong with a surface that was read, or nullptr.
const char* fault_of(const SurfaceTriangles& surface) {
  const auto count = static_cast<std::int32_t>(surface.vertices.size());
  if (surface.triangles.empty()) return "no triangles";
  if (surface.tags.size() != surface.triangles.size()) return "tags of other triangles";
  for (const auto& triangle : surface.triangles)
    for (const std::int32_t i : triangle)
      if (i < 0 || i >= count) return "a corner that is no vertex";
  for (const auto* points : {&surface.vertices, &surface.holes})
    for (const auto& point : *points)
      for (const double x : point)
        if (!pnpbs::is_usable(x)) return "an unusable coordinate";
  for (const auto& [tag, name] : surface.tag_names)
    if (tag < 1 || name.empty()) return "a name that is none";
  return nullptr;
}

// Returns what is wrong with a mesh that was read, or with the domain built from it, or nullptr.
const char* fault_of(const pnpbs::MshMesh& mesh) {
  for (std::size_t shape = 0; shape < pnpbs::kMshShapes; ++shape) {
    const pnpbs::MshCells& cells = mesh.cells[shape];
    if (cells.corners.size() != cells.count() * static_cast<std::size_t>(pnpbs::kMshCorners[shape]))
      return "corners of other elements";
    for (const std::int32_t i : cells.corners)
      if (i < 0 || i >= std::ssize(mesh.nodes)) return "a corner that is no node";
    for (const std::int32_t i : cells.regions)
      if (i < 0 || i >= std::ssize(mesh.regions)) return "an element of no region";
  }
  for (const auto& point : mesh.nodes)
    for (const double x : point)
      if (!pnpbs::is_usable(x)) return "an unusable coordinate";
  if (mesh.dimension() == 2) {
    pnpbs::PlaneDomain plane;
    add_msh(plane, mesh, 40);
  } else {
    pnpbs::VolumeDomain body;
    add_msh(body, mesh, 40);
  }
  return nullptr;
}

struct Tally {
  std::uint64_t read = 0, refused = 0;
  double slowest = 0;
};

// Reads the bytes. Prints what is wrong and returns false if the result is invalid.
bool examine(const Sample& sample, const std::string& bytes, Tally& tally) {
  const auto begin = std::chrono::steady_clock::now();
  largest_request = 0;
  const char* fault = nullptr;
  std::string message;
  try {
    fault = sample.format
                ? fault_of(pnpbs::parse_surface(bytes, "mutated", *sample.format, nullptr))
                : fault_of(pnpbs::parse_msh(bytes, "mutated"));
    ++tally.read;
  } catch (const pnpbs::Error& error) {
    message = error.what();
    if (error.kind() != pnpbs::ErrorKind::file || !message.starts_with("mutated:"))
      fault = "not a file's error";
    ++tally.refused;
  } catch (const std::exception& error) {
    message = error.what();
    fault = "not an error of ours";
  }
  const std::chrono::duration<double> time = std::chrono::steady_clock::now() - begin;
  tally.slowest = std::max(tally.slowest, time.count());
  if (largest_request > 100 * bytes.size() + 10000) fault = "more memory than bytes account for";
  if (time.count() > 20) fault = "too slow";
  if (fault) std::printf("%s: %s: %s\n", sample.name.c_str(), fault, message.c_str());
  return fault == nullptr;
}

bool examine_mutations(const Sample& sample, std::uint64_t mutations, std::uint64_t seed) {
  Damage damage(seed);
  Tally tally;
  if (!examine(sample, sample.bytes, tally) || tally.read != 1) {
    std::printf("%s: not read undamaged\n", sample.name.c_str());
    return false;
  }
  for (std::uint64_t i = 0; i < mutations; ++i) {
    const std::string bytes = i % 2 == 0 ? damage.to(sample.bytes) : damage.to_bytes(sample.bytes);
    std::ofstream(PNPBS_TEST_WORK_DIR "/mutate_surface.bytes", std::ios::binary) << bytes;
    if (!examine(sample, bytes, tally)) return false;
  }
  std::printf("%s: %llu read, %llu refused, at most %.3f s\n", sample.name.c_str(),
              static_cast<unsigned long long>(tally.read),
              static_cast<unsigned long long>(tally.refused), tally.slowest);
  // Some mutations must leave files readable and some must break them. Otherwise the test has no
  // effect.
  return mutations < 50 || (tally.read > mutations / 50 && tally.refused > mutations / 50);
}

}  // namespace

int main(int argc, char** argv) {
  const std::vector<Sample> all = samples(argc - 1, argv + 1);
  const std::uint64_t mutations = from_environment("PNPBS_MUTATIONS", 100);
  std::uint64_t seed = from_environment("PNPBS_SEED", 0);
  bool good = true;
  for (const Sample& sample : all) good = examine_mutations(sample, mutations, ++seed) && good;
  return good ? EXIT_SUCCESS : EXIT_FAILURE;
}
