// SPDX-License-Identifier: BSD-3-Clause
#include "tool/summary.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <vector>

#include "base/space_vectors.hpp"
#include "tool/numbers.hpp"
#include "tool/own_elements.hpp"

namespace pnpbs::tool {
namespace {

// Returns positions by local index: owned nodes first, then ghosts.
std::vector<Point<3>> local_positions(pnpbs_placement placement, pnpbs_context context) {
  std::int64_t own = 0, ghosts = 0;
  check(pnpbs_placement_count(placement, &own), context);
  check(pnpbs_placement_ghost_count(placement, &ghosts), context);
  // One element more than needed, so that positions[0] exists.
  std::vector<Point<3>> positions(static_cast<std::size_t>(own + ghosts + 1));
  check(pnpbs_placement_get_nodes(placement, own, positions[0].data(), nullptr, nullptr, nullptr),
        context);
  check(
      pnpbs_placement_get_ghosts(placement, ghosts, positions[static_cast<std::size_t>(own)].data(),
                                 nullptr, nullptr, nullptr, nullptr),
      context);
  return positions;
}

}  // namespace

BodyFigures body_figures(pnpbs_domain domain, bool filled, pnpbs_context context) {
  Box<3> box{};
  BodyFigures figures{};
  check(pnpbs_domain_bounds(domain, box.low.data(), box.high.data()), context);
  double measure = 0;
  check(pnpbs_domain_measure(domain, &measure), context);
  if (filled)
    figures.volume = measure;
  else
    figures.area = measure;
  figures.extent = difference(box.high, box.low);
  return figures;
}

double boundary_area(pnpbs_placement placement, pnpbs_context context, const Ranks& ranks) {
  const std::vector<Point<3>> x = local_positions(placement, context);
  const auto at = [&x](std::int64_t node) { return x[static_cast<std::size_t>(node)]; };
  double area = 0;
  for (const auto& [a, b, c] : own_boundary(placement, context)) {
    const Point<3> normal = cross(difference(at(b), at(a)), difference(at(c), at(a)));
    area += 0.5 * std::sqrt(dot(normal, normal));
  }
  const std::vector<double> areas = ranks.gather(std::vector<double>{area});
  return std::accumulate(areas.begin(), areas.end(), 0.0);
}

namespace {

std::string nodes_line(const Statistics& statistics) {
  const auto* nodes = statistics.find<std::int64_t>("nodes");
  const auto* boundary = statistics.find<std::int64_t>("boundary_nodes");
  const auto* seconds = statistics.find<double>("seconds.total");
  if (!nodes) return "";
  std::string line = "nodes    " + grouped(*nodes);
  if (boundary) line += ", " + grouped(*boundary) + " of them on the boundary";
  if (seconds) line += ", in " + duration(*seconds);
  return line + "\n";
}

std::string particles_line(const Statistics& statistics, const ParticleFigures& particles) {
  const auto* seconds = statistics.find<double>("seconds.total");
  std::string line =
      "nodes    " + grouped(particles.count) + " particles, " + grouped(particles.outermost) +
      (particles.of_wall ? " of them in the first or last layer" : " of them outermost");
  if (seconds) line += ", in " + duration(*seconds);
  return line + "\n";
}

std::string spacing_of_particles_line(const ParticleFigures& particles) {
  std::string line = "spacing  ";
  if (std::isfinite(particles.closest))
    line += "closest pair at " + short_number(particles.closest, 3) + " d; ";
  return line + "too close to others and left out: " + grouped(particles.left_out) +
         ", pushed apart: " + grouped(particles.moved) + "\n";
}

std::string spacing_line(const Statistics& statistics) {
  const auto* mean = statistics.find<double>("d_error.mean");
  const auto* deviation = statistics.find<double>("d_error.deviation");
  const auto* min = statistics.find<double>("d_error.least");
  if (!mean || !deviation) return "";
  std::string line = "spacing  nearest neighbour at " + short_number(*mean, 4) + " d +- " +
                     short_number(*deviation, 2);
  if (min) line += ", least " + short_number(*min, 2) + " d";
  return line + "\n";
}

std::string body_line(const Statistics* statistics, const std::optional<BodyFigures>& body) {
  if (!body) return "";
  const Point<3>& size = body->extent;
  std::string line = "body     " + short_number(size[0], 4) + " x " + short_number(size[1], 4) +
                     " x " + short_number(size[2], 4);
  if (body->volume > 0) line += ", volume " + measure(body->volume);
  const auto* filled = statistics ? statistics->find<double>("volume.elements") : nullptr;
  if (filled && *filled > 0) line += ", elements fill " + measure(*filled);
  if (body->area) line += ", surface " + measure(*body->area);
  return line + "\n";
}

std::string quality_line(const Statistics& statistics, bool tetrahedra) {
  const auto* mean = statistics.find<double>("quality.mean");
  const auto* one_percent = statistics.find<double>("quality.one_percent");
  const auto* min = statistics.find<double>("quality.min");
  const auto* angle = statistics.find<double>("quality.min_angle");
  if (!mean || !one_percent || !min || !angle) return "";
  return "quality  " + short_number(*mean, 4) + " in the mean, 99 % above " +
         short_number(*one_percent, 3) + ", least " + short_number(*min, 3) + "; smallest " +
         (tetrahedra ? "dihedral angle " : "angle ") + short_number(*angle, 3) + " degrees\n";
}

std::string edge_line(const Statistics& statistics) {
  const auto* mean = statistics.find<double>("edge.mean");
  const auto* deviation = statistics.find<double>("edge.deviation");
  if (!mean || !deviation) return "";
  std::string line = "edges    " + short_number(*mean, 4) + " d +- " + short_number(*deviation, 2);
  const std::vector<EdgeBand>& bands = statistics.edge_bands();
  if (bands.size() > 1) {
    const auto [shortest, longest] = std::ranges::minmax_element(bands, {}, &EdgeBand::mean);
    line += "; by bands of d " + short_number(shortest->mean, 3) + " to " +
            short_number(longest->mean, 3) + " d";
  }
  return line + "\n";
}

std::string region_lines(const std::vector<RegionRow>& regions, const std::string& what) {
  constexpr std::size_t kMany = 12;
  std::string lines;
  for (std::size_t k = 0; k < std::min(regions.size(), kMany); ++k) {
    const RegionRow& region = regions[k];
    lines += "region   " + std::to_string(region.tag) +
             (region.name.empty() ? "" : " '" + region.name + "'") + ": " + grouped(region.nodes) +
             " nodes, " + grouped(region.elements) + " elements, " + what +
             measure(region.measure) + "\n";
  }
  if (regions.size() > kMany)
    lines += "region   " + grouped(std::ssize(regions) - static_cast<std::int64_t>(kMany)) +
             " more: write a report (--report) to have them all\n";
  return lines;
}

std::string volume_line(const std::optional<VolumeFigures>& volumes) {
  if (!volumes) return "";
  std::string line = "volumes  " + measure(volumes->total) + " in all";
  const std::string unit = volumes->dimension == 2 ? " d^2" : " d^3";
  if (std::isfinite(volumes->mean))  // there are nodes
    line += "; of a node " + short_number(volumes->mean, 3) + unit + " in the mean, " +
            short_number(volumes->min, 3) + " to " + short_number(volumes->max, 3) + unit;
  return line + "\n";
}

std::string mass_line(const std::optional<VolumeFigures>& volumes) {
  if (!volumes || !volumes->mass) return "";
  return "mass     " + measure(*volumes->mass) + " in all\n";
}

// Translates the library's reason for the end of the run.
std::string in_words(const std::string& reason) {
  if (reason == "rest") return "the bubbles rest";
  if (reason == "step limit") return "the step limit, before the bubbles rested";
  return reason;
}

std::string stop_line(const Statistics& statistics) {
  const auto* steps = statistics.find<std::int64_t>("steps");
  const auto* reason = statistics.find<std::string>("stop_reason");
  if (!reason) return "";
  std::string line = "stopped  ";
  if (steps) line += "after " + grouped(*steps) + " steps: ";
  return line + in_words(*reason) + "\n";
}

std::string memory_line(const Statistics& statistics) {
  const auto* bytes = statistics.find<std::int64_t>("memory.max_peak_bytes");
  const auto* ranks = statistics.find<std::int64_t>("ranks");
  if (!bytes) return "";
  std::string line = "memory   " + size_in_bytes(static_cast<double>(*bytes)) + " at most";
  if (ranks && *ranks > 1) line += " in each of " + grouped(*ranks) + " processes";
  return line + "\n";
}

std::string files_line(const std::vector<std::string>& files) {
  if (files.empty()) return "wrote    nothing: name files with --output\n";
  std::string line;
  for (const std::string& file : files) line += (line.empty() ? "wrote    " : ", ") + file;
  return line + "\n";
}

}  // namespace

std::string estimate_text(const RunEstimate& run) {
  // Measured with a million nodes in the plane and with 100 000 in space.
  const double picture_bytes_per_node = run.body ? 340 : 115;
  const double nodes = static_cast<double>(run.nodes);
  std::string text = body_line(nullptr, run.body) + "nodes    about " + grouped(run.nodes) +
                     "\nmemory   about " + size_in_bytes(static_cast<double>(run.bytes));
  if (run.processes > 1) text += " in each of " + grouped(run.processes) + " processes";
  if (run.picture)
    text += ", and " + size_in_bytes(picture_bytes_per_node * nodes) + " for the picture" +
            (run.processes > 1 ? " in the first one" : "");
  text += "\ntime     roughly " + duration(run.seconds);
  if (nodes > 0 && run.seconds > 0)
    text += ", if " +
            grouped(1000 * static_cast<std::int64_t>(std::round(nodes / run.seconds / 1000))) +
            " nodes are placed per second";
  return text + "\n";
}

std::string summary_text(const Statistics& statistics, const std::optional<BodyFigures>& body,
                         const std::vector<RegionRow>& regions,
                         const std::optional<VolumeFigures>& volumes,
                         const std::optional<ParticleFigures>& particles,
                         const std::vector<std::string>& files) {
  std::string nodes;
  if (particles)  // particles have no elements
    nodes = particles_line(statistics, *particles) + spacing_of_particles_line(*particles);
  else
    nodes = nodes_line(statistics) + spacing_line(statistics) + edge_line(statistics) +
            quality_line(statistics, body && body->volume > 0);
  return body_line(particles ? nullptr : &statistics, body) + nodes +
         region_lines(regions, body && body->volume > 0 ? "volume " : "area ") +
         volume_line(volumes) + mass_line(volumes) + stop_line(statistics) +
         memory_line(statistics) + files_line(files);
}

}  // namespace pnpbs::tool
