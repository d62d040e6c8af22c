// SPDX-License-Identifier: BSD-3-Clause
// The table of output formats and the writer of each.
#pragma once

#include <span>
#include <string>
#include <string_view>

#include "cgrid/sphere_grid.hpp"
#include "io/node_source.hpp"
#include "io/shared_file.hpp"

namespace pnpbs::io {

// Where a format stores elements. never: nowhere. regions: nowhere, but nodes have the tags of the
// regions that elements have. on_request: in the file. grid: in the file, with facets in a second
// file. beside: in a second file. always: in the file.
enum class Elements { never, regions, on_request, grid, beside, always };

// The kinds of results that a format can store: any, bodies, triangles of the plane and of spheres,
// or Voronoi cells of spheres.
enum class Of { anything, bodies, triangles, spheres };

// An output format.
struct Format {
  const char* name;  // also the file extension, without its dot
  const char* help;
  bool binary;  // must not be written to a terminal
  Elements elements;
  Of of;
  bool by_hdf5;  // written by HDF5, at least in part, so it must be a regular file
  // Writes one file. nullptr for files in pieces and for cells. Collective.
  void (*write)(const NodeSource& nodes, SharedFile& file);
  std::span<const std::string_view> fields{};  // output fields that the format requires
  // Writes the Voronoi cells of a sphere, instead of `write`. Collective.
  void (*write_cells)(const SphereGrid& grid, SharedFile& file) = nullptr;

  bool second_order = false;  // can contain elements of second order

  bool in_pieces() const { return !write && !write_cells; }
};

std::span<const Format> formats();
std::string list_of_formats();

// Returns the format of the file of arrays that belongs to a .xdmf file. Users cannot select it.
const Format& heavy_data_format();
std::string heavy_data_path(const std::string& path);  // path: of the .xdmf file
std::string facets_path(const std::string& path);      // file of the facets that belongs to a grid

// Return nullptr if none exists.
const Format* format_by_name(std::string_view name);
const Format* format_by_extension(std::string_view path);

void write_vtu(const NodeSource& nodes, SharedFile& file);
void write_vtkhdf(const NodeSource& nodes, SharedFile& file);
void write_xdmf(const NodeSource& nodes, SharedFile& file);
void write_heavy_data(const NodeSource& nodes, SharedFile& file);
void write_node(const NodeSource& nodes, SharedFile& file);
void write_ele(const NodeSource& nodes, SharedFile& file);
void write_face(const NodeSource& nodes, SharedFile& file);
void write_msh(const NodeSource& nodes, SharedFile& file);
void write_msh2(const NodeSource& nodes, SharedFile& file);
void write_gr3(const NodeSource& nodes, SharedFile& file);
void write_2dm(const NodeSource& nodes, SharedFile& file);
void write_ugrid(const NodeSource& nodes, SharedFile& file);
void write_csv(const NodeSource& nodes, SharedFile& file);
void write_peridigm(const NodeSource& nodes, SharedFile& file);
void write_lammps(const NodeSource& nodes, SharedFile& file);
void write_gadget(const NodeSource& nodes, SharedFile& file);

// Writes the file that lists the pieces. `like` has the contents of any of them. Collective.
void write_pvtu(const std::vector<std::string>& pieces, const Contents& like, SharedFile& file);

// Writes the grid of the Model for Prediction Across Scales: the Voronoi cells of nodes on a sphere
// in NetCDF's 64-bit data format, with all variables that MPAS reads (MPAS mesh specification 1.0,
// mpas-dev.github.io) and the mesh quality that its converter adds. Collective.
void write_mpas(const SphereGrid& grid, SharedFile& file);

// Writes the graph of the cells for gpmetis, graph.info. Collective.
void write_cell_graph(const SphereGrid& grid, SharedFile& file);

}  // namespace pnpbs::io
