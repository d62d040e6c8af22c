// SPDX-License-Identifier: BSD-3-Clause
// What bounds and divides the domain of a mesh from Gmsh: lines in the plane, triangles and
// quadrangles in space.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "base/error.hpp"
#include "formats/msh_mesh.hpp"

namespace pnpbs {

enum class MshSides {
  one_inside,   // it bounds the domain
  both_inside,  // it lies in it
  unknown       // the file does not tell
};

struct MshFacet {
  std::array<std::int32_t, 4> corners;  // nodes of the mesh
  std::int32_t corner_count;
  std::int32_t tag;
  MshSides sides;

  std::span<const std::int32_t> nodes() const {
    return {corners.data(), static_cast<std::size_t>(corner_count)};
  }
};

// Those of a domain of this dimension. The elements that fill it tell on which side it is; else, in
// version 4.1, the entities that they bound. Where elements fill the domain, facets that the file
// leaves out are added: those of one element, and those between elements of different regions, with
// the least tag that is free. Throws Error(ErrorKind::file).
std::vector<MshFacet> facets_of(const MshMesh& mesh, int dimension);

// Curves of lines that follow one another: each through nodes where two lines meet that are alike
// and that are not in `stops`. From their ends on, closed ones from their first line on.
struct MshLine {
  std::array<std::int32_t, 2> ends;  // nodes of the mesh
  std::int32_t tag;
  bool inner;
};
struct MshCurve {
  std::vector<std::int32_t> nodes;  // of a closed one the first is not repeated
  bool closed;
  std::int32_t tag;
  bool inner;
};
std::vector<MshCurve> curves_of(const std::vector<MshLine>& lines,
                                const std::vector<std::int32_t>& stops);

// Runs work that adds what the mesh holds to a domain: what is wrong with it is the file's fault.
template <class Work>
void as_of_file(const MshMesh& mesh, const Work& work) {
  try {
    work();
  } catch (const Error& error) {
    if (error.kind() != ErrorKind::argument) throw;
    throw Error(ErrorKind::file, mesh.name + ": " + error.what());
  }
}

// Of the regions that fill a domain of this dimension: it is one, whatever they are called.
void warn_of_joined_regions(const MshMesh& mesh, int dimension, std::vector<std::string>& warnings);

}  // namespace pnpbs
