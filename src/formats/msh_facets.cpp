// SPDX-License-Identifier: BSD-3-Clause
#include "formats/msh_facets.hpp"

#include <algorithm>
#include <string>

#include "base/error.hpp"
#include "formats/msh_sides.hpp"

namespace pnpbs {

using namespace msh_sides;

namespace {

// A facet of elements that fill the domain.
struct Face {
  Key key, corners;
  std::int32_t region;  // tag of an element's that has it
  int elements = 1;
  bool divides = false;  // elements of different regions
  bool given = false;    // as an element itself
};

std::vector<Face> faces_of_cells(const MshMesh& mesh, int dimension) {
  const std::vector<std::int32_t> tags = tags_of_regions(mesh, dimension);
  std::vector<Face> all;
  for_cells(mesh, dimension,
            [&](MshShape shape, std::span<const std::int32_t> corners, std::size_t region) {
              for (const std::array<int, 4>& side : sides_of(shape)) {
                Key face{kNone, kNone, kNone, kNone};
                for (std::size_t k = 0; k < 4; ++k)
                  if (side[k] >= 0) face[k] = corners[static_cast<std::size_t>(side[k])];
                all.push_back({key_of(face), face, tags[region]});
              }
            });
  std::stable_sort(all.begin(), all.end(),
                   [](const Face& a, const Face& b) { return a.key < b.key; });
  std::vector<Face> faces;
  for (const Face& face : all) {
    if (faces.empty() || faces.back().key != face.key) {
      faces.push_back(face);
      continue;
    }
    ++faces.back().elements;
    if (faces.back().region != face.region) faces.back().divides = true;
  }
  return faces;
}

std::string nodes_text(const MshMesh& mesh, const Key& corners) {
  std::string text;
  for (std::int32_t k = 0; k < count_of(corners); ++k)
    text += (k > 0 ? ", " : "") +
            std::to_string(
                mesh.node_tags[static_cast<std::size_t>(corners[static_cast<std::size_t>(k)])]);
  return text;
}

// By the entities that these regions bound; unknown if none bounds a single one.
std::vector<MshSides> sides_of_regions(const MshMesh& mesh, int dimension) {
  const bool told = std::ranges::any_of(mesh.regions, [&](const MshRegion& region) {
    return region.dimension == dimension && region.bounds == 1;
  });
  std::vector<MshSides> sides;
  for (const MshRegion& region : mesh.regions)
    sides.push_back(!told                ? MshSides::unknown
                    : region.bounds == 1 ? MshSides::one_inside
                                         : MshSides::both_inside);
  return sides;
}

const char* what_is_missing(int dimension) {
  return dimension == 2 ? "holds no lines, triangles or quadrangles, expected a domain or its "
                          "boundary"
                        : "holds no triangles, quadrangles or elements of volumes, expected a body "
                          "or its surface";
}

}  // namespace

std::vector<MshFacet> facets_of(const MshMesh& mesh, int dimension) {
  std::vector<Face> faces = faces_of_cells(mesh, dimension);
  for (const Face& face : faces)
    if (face.elements > 2)
      throw Error(ErrorKind::file, mesh.name + ": " + std::to_string(face.elements) +
                                       " elements share the nodes " +
                                       nodes_text(mesh, face.corners) + ", expected two at most");
  const std::vector<std::int32_t> tags = tags_of_regions(mesh, dimension - 1);
  const std::vector<MshSides> by_region = sides_of_regions(mesh, dimension - 1);
  std::vector<MshFacet> facets;
  for_cells(mesh, dimension - 1,
            [&](MshShape, std::span<const std::int32_t> corners, std::size_t region) {
              Key all{kNone, kNone, kNone, kNone};
              std::copy(corners.begin(), corners.end(), all.begin());
              MshSides sides = by_region[region];
              if (!faces.empty()) {
                const Key key = key_of(all);
                const auto face = std::ranges::lower_bound(faces, key, {}, &Face::key);
                const bool found = face != faces.end() && face->key == key;
                if (found) face->given = true;
                sides = found && face->elements == 1 ? MshSides::one_inside : MshSides::both_inside;
              }
              facets.push_back({all, count_of(all), tags[region], sides});
            });
  const std::int32_t other = free_tag(mesh);
  for (const Face& face : faces)
    if (!face.given && (face.elements == 1 || face.divides))
      facets.push_back({face.corners, count_of(face.corners), other,
                        face.divides ? MshSides::both_inside : MshSides::one_inside});
  if (facets.empty()) throw Error(ErrorKind::file, mesh.name + ": " + what_is_missing(dimension));
  return facets;
}

}  // namespace pnpbs
