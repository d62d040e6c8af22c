// SPDX-License-Identifier: BSD-3-Clause
#include "io/formats.hpp"

#include <algorithm>
#include <array>
#include <filesystem>

#include "base/extension.hpp"
#include "base/small_letters.hpp"
#include "io/particle_fields.hpp"

namespace pnpbs::io {
namespace {

constexpr std::array kVolumes{kVolumeField};
constexpr std::span<const std::string_view> no_fields{};
constexpr std::array kMatter{kVolumeField, kDensityField};

constexpr std::array table{
    Format{"vtu", "VTK unstructured grid: nodes, elements, id, tag, spacing, quality", true,
           Elements::grid, Of::anything, false, write_vtu, no_fields, nullptr, true},
    Format{"pvtu", "the same as one .vtu piece per rank beside it", false, Elements::grid,
           Of::anything, false, nullptr},
    Format{"vtkhdf", "the same as one VTKHDF file; needs HDF5", true, Elements::grid, Of::anything,
           true, write_vtkhdf, no_fields, nullptr, true},
    Format{"xdmf", "the same as XDMF 3 with its arrays in a .h5 file beside it; needs HDF5", false,
           Elements::grid, Of::anything, true, write_xdmf},
    Format{"msh", "Gmsh's format 4.1: nodes, elements, facets of the boundary; named groups", false,
           Elements::on_request, Of::anything, false, write_msh, no_fields, nullptr, true},
    Format{"msh2", "Gmsh's format 2.2, for programs that do not read 4.1", false,
           Elements::on_request, Of::anything, false, write_msh2, no_fields, nullptr, true},
    Format{"node", "Triangle's and TetGen's node file, numbered from 1, with boundary markers",
           false, Elements::beside, Of::anything, false, write_node},
    Format{"ele", "Triangle's and TetGen's element file for the .node file", false,
           Elements::always, Of::anything, false, write_ele},
    Format{"face", "TetGen's file of a body's surface triangles for the .node file", false,
           Elements::always, Of::bodies, false, write_face},
    Format{"gr3", "SCHISM's and ADCIRC's grid: nodes, triangles, open and land boundaries", false,
           Elements::always, Of::triangles, false, write_gr3},
    Format{"2dm", "SMS' 2DM mesh: triangles with materials, nodes, node strings of the boundary",
           false, Elements::always, Of::triangles, false, write_2dm},
    Format{"ugrid", "UGRID's mesh as NetCDF: nodes, triangles, edges of the boundary, fields", true,
           Elements::always, Of::triangles, false, write_ugrid},
    Format{"csv", "id,x,y,tag,spacing, of bodies id,x,y,z,tag,spacing", false, Elements::never,
           Of::anything, false, write_csv},
    Format{"peridigm", "Peridigm's text of particles of a body: x y z block volume", false,
           Elements::regions, Of::bodies, false, write_peridigm, kVolumes},
    Format{"lammps", "LAMMPS' data file of a body, atom_style peri: volumes and densities", false,
           Elements::regions, Of::bodies, false, write_lammps, kMatter},
    Format{"hdf5", "initial conditions of SWIFT and Gadget: particles of gas at rest; needs HDF5",
           true, Elements::never, Of::anything, true, write_gadget, kMatter},
    Format{"mpas", "MPAS grid of a sphere: Voronoi cells, edges, vertices and weights as NetCDF",
           true, Elements::always, Of::spheres, false, nullptr, no_fields, write_mpas},
    Format{"graph", "graph of these cells for gpmetis, MPAS' graph.info", false, Elements::always,
           Of::spheres, false, nullptr, no_fields, write_cell_graph},
};

constexpr Format heavy_data{
    "h5", "arrays of a .xdmf file", true, Elements::on_request, Of::anything,
    true, write_heavy_data};

const std::string kFacets = "_facets";

}  // namespace

std::span<const Format> formats() { return table; }

const Format& heavy_data_format() { return heavy_data; }

std::string facets_path(const std::string& path) {
  const std::filesystem::path whole(path);
  return (whole.parent_path() / (whole.stem().string() + kFacets + whole.extension().string()))
      .string();
}

std::string list_of_formats() {
  std::string list;
  for (const Format& format : table) list += (list.empty() ? "" : ", ") + std::string(format.name);
  return list;
}

const Format* format_by_name(std::string_view name) {
  const std::string small = to_lower_case(name);
  const auto found = std::ranges::find_if(table, [&](const Format& f) { return f.name == small; });
  return found == table.end() ? nullptr : &*found;
}

const Format* format_by_extension(std::string_view path) {
  return format_by_name(extension_of(path));
}

}  // namespace pnpbs::io
