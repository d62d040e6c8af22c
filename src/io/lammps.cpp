// SPDX-License-Identifier: BSD-3-Clause
// Writer of LAMMPS' data file (https://docs.lammps.org/read_data.html) with atom_style peri: "id
// type volume density x y z", one line for each particle of a body. Ids start at 1. Types run from
// 1 to the largest tag of a region.
#include "base/error.hpp"
#include "io/formats.hpp"
#include "io/particle_fields.hpp"

namespace pnpbs::io {

namespace {

// Returns the header. The box has a margin around the particles, since it need not be periodic.
std::string header(const Contents& all, std::int32_t types, const ParticleExtent& extent) {
  std::string text = "particles placed by pnpbs\n\n" + std::to_string(all.nodes) + " atoms\n" +
                     std::to_string(types) + " atom types\n\n";
  for (std::size_t k = 0; k < 3; ++k) {
    const std::string axis(1, "xyz"[k]);
    text += number_text(extent.box.low[k] - extent.size) + " " +
            number_text(extent.box.high[k] + extent.size) + " " + axis + "lo " + axis + "hi\n";
  }
  return text + "\nAtoms # peri\n\n";
}

}  // namespace

void write_lammps(const NodeSource& nodes, SharedFile& file) {
  const std::vector<double> volumes = particle_values(nodes, kVolumeField);
  const std::vector<double> densities = particle_values(nodes, kDensityField);
  const ParticleExtent extent = extent_of_particles(nodes, volumes, file.ranks());
  file.append_text(header(nodes.contents(), largest_block(nodes, "lammps"), extent));
  std::size_t before = 0;  // nodes of earlier windows
  nodes.for_nodes([&](const NodeRows& rows) {
    file.append([&](Sink& sink) {
      std::int64_t id = rows.first;
      for (std::size_t i = 0; i < rows.ids.size(); ++i) {
        sink.number(++id);
        sink.text(" ");
        sink.number(block_of(rows, i));
        for (const double value : {volumes[before + i], densities[before + i]}) {
          sink.text(" ");
          sink.number(value);
        }
        for (std::size_t k = 0; k < 3; ++k) {
          sink.text(" ");
          sink.number(rows.x[3 * i + k]);
        }
        sink.text("\n");
      }
    });
    before += rows.ids.size();
  });
}

}  // namespace pnpbs::io
