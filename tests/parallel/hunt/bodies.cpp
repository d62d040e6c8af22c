// SPDX-License-Identifier: BSD-3-Clause
//
// Chooses the kind of a case's body and its position in space.
#include <cmath>
#include <fstream>
#include <numbers>
#include <stdexcept>

#include "body.hpp"

namespace hunt {

namespace {

std::array<Point, 3> random_rotation(Random& random, int dim) {
  if (dim == 2) {
    const double angle = random.between(0, 2 * std::numbers::pi);
    return {
        {{std::cos(angle), -std::sin(angle), 0}, {std::sin(angle), std::cos(angle), 0}, {0, 0, 1}}};
  }
  const auto direction = [&] {
    for (;;) {
      const Point p{random.between(-1, 1), random.between(-1, 1), random.between(-1, 1)};
      if (length(p) > 0.1 && length(p) < 1) return unit(p);
    }
  };
  const Point a = direction();
  Point b;
  do b = direction();
  while (std::fabs(dot(a, b)) > 0.9);
  b = unit(b - dot(a, b) * a);
  return {a, b, cross(a, b)};
}

bool may_turn(const Body& body) { return body.boxes.empty() && body.cylinders.empty(); }

// Removes triangles, so that a closed surface becomes open.
void cut_open(Random& random, Mesh& mesh) {
  const auto all = static_cast<double>(mesh.triangles.size());
  const auto kept = static_cast<std::size_t>(all * random.between(0.5, 0.95));
  if (kept > 3) mesh.triangles.resize(kept);
  if (!mesh.tags.empty()) mesh.tags.resize(mesh.triangles.size());
}

Body random_kind(Random& random, double nodes, const std::vector<std::string>& files) {
  const double which = random.unit();
  if (which < 0.32) return random_tube(random, nodes);
  if (which < 0.52) return random_profile(random, nodes);
  if (which < 0.65) return random_scan(random, nodes);
  if (which < 0.82) return random_level_set(random, nodes);
  if (which < 0.98 || files.empty()) return random_blocks(random, nodes);
  return random_file(random, files);
}

}  // namespace

Body file_body(const std::string& path) {
  Body body;
  body.file = path;
  std::int32_t dim = 3;
  if (!std::ifstream(path).good() || pnpbs_file_dimension(path.c_str(), &dim) < 0)
    throw std::runtime_error(path + ": the file of the body cannot be read.");
  body.dim = dim;
  body.name = "file/" + path.substr(path.find_last_of('/') + 1);
  return body;
}

Body random_file(Random& random, const std::vector<std::string>& files) {
  return file_body(
      files[static_cast<std::size_t>(random.pick(0, static_cast<int>(files.size()) - 1))]);
}

Body random_body(Random& random, int dim, double nodes, const std::vector<std::string>& files) {
  Body body = dim == 2 ? random_plane_body(random, nodes) : random_kind(random, nodes, files);
  if (!body.file.empty()) return body;
  if (dim == 3 && !body.meshes.empty() && body.boxes.empty() && random.chance(0.15)) {
    body.filled = false;
    body.name += "/alone";
    if (random.chance(0.3)) cut_open(random, body.meshes[0]);
  }
  if (random.chance(0.7) && may_turn(body)) body.frame.rotation = random_rotation(random, dim);
  if (random.chance(0.5)) body.frame.scale = random.scale(1e-3, 1e3);
  if (random.chance(0.5))
    for (int k = 0; k < dim; ++k) body.frame.offset[k] = body.frame.scale * random.between(-50, 50);
  return body;
}

}  // namespace hunt
