// SPDX-License-Identifier: BSD-3-Clause
// Initial conditions of Gadget and SWIFT by HDF5 (https://swift.strw.leidenuniv.nl/docs, "Initial
// Conditions"). All particles are gas, at rest and cold. The file has no group of units, so numbers
// are in the internal units of the program.
#include <algorithm>
#include <array>
#include <cmath>
#include <functional>

#include "io/formats.hpp"
#include "io/grid_arrays.hpp"
#include "io/hdf5_grid.hpp"
#include "io/particle_fields.hpp"

namespace pnpbs::io {

namespace {

constexpr std::size_t kTypes = 6;  // number of particle types; gas is the first

// First guess of SWIFT's smoothing length. [distance of particles]
constexpr double kResolution = 1.2348;

// Returns an array of values that follow from the volume and density of each particle.
GridArray computed_array(const Contents& all,
                         const std::function<double(double volume, double density)>& value) {
  const auto write = [value](const NodeSource& nodes, SharedFile& file) {
    const std::vector<double> densities = particle_values(nodes, kDensityField);
    const std::size_t volume = particle_field(*nodes.contents().fields, kVolumeField);
    std::size_t before = 0;  // particles of earlier windows
    nodes.for_field(volume, [&](const FieldRows& rows) {
      file.append([&](Sink& sink) {
        for (std::size_t i = 0; i < rows.values.size(); ++i) {
          const double number = value(rows.values[i], densities[before + i]);
          sink.bytes(&number, sizeof number);
        }
      });
      before += rows.values.size();
    });
  };
  return {"", NumberType::real, all.nodes, 1, write};
}

std::vector<PlacedArray> gas_arrays(const Contents& all) {
  const double dimension = all.dimension;
  const std::string gas = "/PartType0/";
  return {{gas + "Coordinates", point_array(all)},
          {gas + "Velocities", zero_array(all, 3)},
          {gas + "Masses", computed_array(all, [](double v, double rho) { return rho * v; })},
          {gas + "Density", computed_array(all, [](double, double rho) { return rho; })},
          {gas + "SmoothingLength",
           computed_array(
               all, [=](double v, double) { return kResolution * std::pow(v, 1 / dimension); })},
          {gas + "InternalEnergy", zero_array(all, 1)},
          {gas + "ParticleIDs", number_array(all)}};
}

std::vector<std::int64_t> of_types(std::int64_t gas) {
  std::vector<std::int64_t> numbers(kTypes, 0);
  numbers[0] = gas;
  return numbers;
}

// Returns the sides of a box from 0, where the programs' boxes begin. Along an axis with negative
// coordinates, the box has room for the particles after a shift.
std::vector<double> box_size(const ParticleExtent& extent) {
  std::vector<double> sizes;
  for (std::size_t k = 0; k < 3; ++k) {
    const double below = extent.box.low[k] < 0 ? extent.size - extent.box.low[k] : 0;
    sizes.push_back(below + extent.box.high[k] + extent.size);
  }
  return sizes;
}

void add_header(hdf5::NewFile& made, const Contents& all, const std::vector<double>& size) {
  const std::string header = "/Header";
  constexpr std::int64_t word = std::int64_t{1} << 32;  // counts are split into words of 32 bits
  made.add_group(header);
  made.set(header, "NumPart_ThisFile", of_types(all.nodes));
  made.set(header, "NumPart_Total", of_types(all.nodes % word));
  made.set(header, "NumPart_Total_HighWord", of_types(all.nodes / word));
  made.set(header, "MassTable", std::vector<double>(kTypes, 0));
  made.set(header, "BoxSize", size);
  made.set(header, "Dimension", std::int64_t{all.dimension});
  made.set(header, "NumFilesPerSnapshot", std::int64_t{1});
  made.set(header, "Flag_Entropy_ICs", std::int64_t{0});
  made.set(header, "Time", 0.0);
}

}  // namespace

void write_gadget(const NodeSource& nodes, SharedFile& file) {
  const Contents& all = nodes.contents();
  const std::vector<double> size =
      box_size(extent_of_particles(nodes, particle_values(nodes, kVolumeField), file.ranks()));
  write_by_hdf5(nodes, file, gas_arrays(all), [&](hdf5::NewFile& made) {
    add_header(made, all, size);
    made.add_group("/RuntimePars");
    made.set("/RuntimePars", "PeriodicBoundariesOn", std::int64_t{0});
    made.add_group("/PartType0");
  });
}

}  // namespace pnpbs::io
