// SPDX-License-Identifier: BSD-3-Clause
//
// Bodies from level sets that add or subtract capsules, boxes and balls, and bodies from primitives
// of the library: bars, rods, cavities, inner sheets, and two separate bodies.
#include <algorithm>
#include <cmath>

#include "body.hpp"

namespace hunt {

namespace {

Point random_point(Random& random, double reach) {
  return {random.between(-reach, reach), random.between(-reach, reach),
          random.between(-reach, reach)};
}

Solid random_solid(Random& random, const Point& at) {
  Solid solid;
  const int kind = random.pick(0, 3);
  if (kind == 0) {
    solid.is_box = true;
    const Point half{random.scale(0.3, 6), random.scale(0.3, 3), random.scale(0.3, 3)};
    solid.a = at - half;
    solid.b = at + half;
    solid.radius = random.chance(0.3) ? random.between(0.1, 0.5) : 0;
  } else {
    solid.a = at;
    solid.b = kind == 1 ? at : at + random_point(random, 7);
    solid.radius = kind == 1 ? random.scale(0.6, 3.5) : random.scale(0.3, 1.5);
  }
  return solid;
}

// Returns a point near a solid of the union, so that the next solid usually touches it.
Point near(Random& random, const Solid& solid) {
  const double at = random.unit();
  return solid.a + at * (solid.b - solid.a) + random_point(random, 0.7 * solid.radius);
}

void find_box(Body& body) {
  body.low = {1e300, 1e300, 1e300};
  body.high = {-1e300, -1e300, -1e300};
  for (const Solid& solid : body.solids)
    for (int k = 0; k < 3; ++k) {
      body.low[k] = std::min(body.low[k], std::min(solid.a[k], solid.b[k]) - solid.radius - 1.13);
      body.high[k] = std::max(body.high[k], std::max(solid.a[k], solid.b[k]) + solid.radius + 1.21);
    }
}

}  // namespace

Body random_level_set(Random& random, double) {
  Body body;
  body.name = "level-set";
  body.solids.push_back(random_solid(random, random_point(random, 1)));
  const int joined = random.pick(0, 4), taken = random.chance(0.5) ? random.pick(1, 2) : 0;
  for (int k = 0; k < joined; ++k) {
    const auto& before = body.solids[static_cast<std::size_t>(random.pick(0, k))];
    body.solids.push_back(random_solid(random, near(random, before)));
  }
  for (int k = 0; k < taken; ++k) {
    Solid solid = random_solid(random, near(random, body.solids[0]));
    solid.taken_away = true;
    solid.radius *= 0.7;
    body.solids.push_back(solid);
  }
  body.resolution = random.scale(0.3, 0.9);
  find_box(body);
  return body;
}

Body random_blocks(Random& random, double nodes) {
  Body body;
  const int kind = random.pick(0, 4);
  const char* names[] = {"bar", "rod", "two-bars", "cavity", "sheet-inside"};
  body.name = std::string("blocks/") + names[kind];
  const double a = random.scale(0.4, 5), b = random.scale(0.4, 5);
  const double along = std::max(2.0, nodes / nodes_of(2 * (a + b), a * b));
  const Point high{a, b, along};
  if (kind == 1) {
    body.radii = {a / 2};
    body.cylinders.push_back({Point{0, 0, 0}, random.chance(0.5)
                                                  ? Point{0, 0, along}
                                                  : along * unit(random_point(random, 1))});
    return body;
  }
  body.boxes.push_back({Point{0, 0, 0}, high});
  if (kind == 2) {
    const double gap = random.scale(0.1, 1.5);
    body.boxes[0][1][2] /= 2;
    body.boxes.push_back({Point{a + gap, random.between(-0.5, 0.5) * b, 0},
                          Point{2 * a + gap, 1.5 * b, along / 2 + random.between(-0.3, 0.3)}});
  } else if (kind == 3) {
    const double wall = random.scale(0.25, 1) * std::min({a, b, along}) / 2.2;
    body.boxes.push_back(
        {Point{wall, wall, wall}, Point{a - wall, b - wall, along - wall * random.between(1, 2)}});
  } else if (kind == 4) {
    const double at = along * random.between(0.3, 0.7);
    Mesh sheet;
    sheet.role = PNPBS_INNER;
    const double x = a * random.between(0.05, 0.3), tilt = along * random.between(0, 0.2);
    sheet.points = {{x, 0.1 * b, at},
                    {0.9 * a, 0.1 * b, at},
                    {0.9 * a, 0.9 * b, at + tilt},
                    {x, 0.9 * b, at + tilt}};
    sheet.triangles = {{0, 1, 2}, {0, 2, 3}};
    body.meshes.push_back(std::move(sheet));
  }
  return body;
}

}  // namespace hunt
