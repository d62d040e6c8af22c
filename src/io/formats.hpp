// SPDX-License-Identifier: BSD-3-Clause
// The table of file formats and one writer for each.
#pragma once

#include <span>
#include <string>
#include <string_view>

#include "cgrid/sphere_grid.hpp"
#include "io/node_source.hpp"
#include "io/shared_file.hpp"

namespace pnpbs::io {

// regions: never, but nodes have the tags of regions that elements have. beside: in files beside.
// grid: in the file, and the facets in one beside it.
enum class Elements { never, regions, on_request, grid, beside, always };

// Of what a format has files: anything, bodies, triangles of the plane and of spheres, or the cells
// of spheres.
enum class Of { anything, bodies, triangles, spheres };

struct Format {
  const char* name;  // also the extension, without its dot
  const char* help;
  bool binary;  // not for terminals
  Elements elements;
  Of of;
  bool by_hdf5;  // in part at least: a file of its own, no stream
  // Collective. nullptr: in pieces, which is not one file's business, or of cells.
  void (*write)(const NodeSource& nodes, SharedFile& file);
  std::span<const std::string_view> fields{};  // of the caller's, that it cannot do without
  // Instead, of spheres. Collective.
  void (*write_cells)(const SphereGrid& grid, SharedFile& file) = nullptr;

  bool in_pieces() const { return !write && !write_cells; }
};

std::span<const Format> formats();
std::string list_of_formats();

// Of the file of arrays beside a .xdmf file, which nobody asks for by itself.
const Format& heavy_data_format();
std::string heavy_data_path(const std::string& path);  // of the .xdmf file
std::string facets_path(const std::string& path);      // of the file of facets beside a grid's

// nullptr if there is none.
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

// The file that names the pieces. Collective. like: what any of them holds.
void write_pvtu(const std::vector<std::string>& pieces, const Contents& like, SharedFile& file);

// Grids of the Model for Prediction Across Scales, the Voronoi cells of nodes on a sphere: in
// NetCDF's 64-bit data format, with all that MPAS reads (MPAS mesh specification 1.0,
// mpas-dev.github.io, and mesh quality as its converter writes it). Collective.
void write_mpas(const SphereGrid& grid, SharedFile& file);

// The graph of the cells, for gpmetis: graph.info. Collective.
void write_cell_graph(const SphereGrid& grid, SharedFile& file);

}  // namespace pnpbs::io
