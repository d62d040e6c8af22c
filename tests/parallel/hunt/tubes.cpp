// SPDX-License-Identifier: BSD-3-Clause
//
// Tubes along smooth curves whose strands come near each other: knots, springs, loops and snakes.
#include <algorithm>
#include <cmath>
#include <numbers>

#include "body.hpp"

namespace hunt {

namespace {

using std::numbers::pi;

struct Line {
  std::vector<Point> points;
  bool closed = true;
};

double length_of(const Line& line) {
  double sum = 0;
  for (std::size_t i = line.closed ? 0 : 1; i < line.points.size(); ++i)
    sum += length(line.points[i] - line.points[i ? i - 1 : line.points.size() - 1]);
  return sum;
}

Line knot(Random& random, int samples) {
  const int knots[][2] = {{2, 3}, {3, 2}, {2, 5}, {3, 4}, {1, 3}, {1, 5}, {3, 5}, {1, 0}};
  const auto [p, q] = knots[random.pick(0, 7)];
  const double inner = random.between(0.25, 0.6), height = random.between(0.7, 1.3);
  Line line;
  for (int i = 0; i < samples; ++i) {
    const double t = 2 * pi * i / samples, across = 1 + inner * std::cos(q * t);
    line.points.push_back(
        {across * std::cos(p * t), across * std::sin(p * t), height * inner * std::sin(q * t)});
  }
  return line;
}

Line spring(Random& random, int samples) {
  const double turns = random.between(1.5, 7), pitch = random.between(0.15, 1.2),
               taper = random.between(-0.08, 0.08);
  Line line;
  line.closed = false;
  for (int i = 0; i < samples; ++i) {
    const double turn = turns * i / (samples - 1), radius = 1 + taper * turn;
    line.points.push_back(
        {radius * std::cos(2 * pi * turn), radius * std::sin(2 * pi * turn), pitch * turn});
  }
  return line;
}

// Returns a curve with a few waves in every direction.
Line loop(Random& random, int samples) {
  double wave[3][4][2];
  for (auto& direction : wave)
    for (int k = 0; k < 4; ++k)
      for (double& part : direction[k]) part = random.between(-1, 1) / (1 + k * k * 0.5);
  Line line;
  for (int i = 0; i < samples; ++i) {
    Point at{};
    for (int x = 0; x < 3; ++x)
      for (int k = 0; k < 4; ++k)
        at[x] += wave[x][k][0] * std::cos(2 * pi * (k + 1) * i / samples) +
                 wave[x][k][1] * std::sin(2 * pi * (k + 1) * i / samples);
    line.points.push_back(at);
  }
  return line;
}

Line snake(Random& random, int samples) {
  const double waves = random.between(0.3, 4), height = random.between(0.1, 1.5),
               lift = random.between(0, 0.3);
  Line line;
  line.closed = false;
  for (int i = 0; i < samples; ++i) {
    const double t = i / (samples - 1.0);
    line.points.push_back(
        {4 * t, height * std::sin(2 * pi * waves * t), lift * std::cos(2 * pi * 1.7 * waves * t)});
  }
  return line;
}

// Returns the largest radius of a tube about the line: less than the radius of curvature, and than
// half the distance of strands minus a gap.
double room_of(const Line& line, double gap) {
  const auto n = static_cast<int>(line.points.size());
  const double step = length_of(line) / n;
  double room = 1e300;
  for (int i = 0; i < n; ++i)
    for (int j = i + 1; j < n; ++j) {
      const double along = step * (line.closed ? std::min(j - i, n - j + i) : j - i);
      const double away = length(line.points[i] - line.points[j]);
      // The chord is much shorter than the arc, so it connects different strands.
      if (away < 0.6 * along) room = std::min(room, (away - gap) / 2);
    }
  for (int i = line.closed ? 0 : 1; i < (line.closed ? n : n - 1); ++i) {
    const Point &a = line.points[(i + n - 1) % n], &b = line.points[i],
                &c = line.points[(i + 1) % n];
    const double area = length(cross(b - a, c - a));
    if (area > 0)
      room = std::min(room, 0.85 * length(b - a) * length(c - b) * length(c - a) / (2 * area));
  }
  return room;
}

Line resampled(const Line& line, int count) {
  const auto n = static_cast<int>(line.points.size());
  const int pieces = line.closed ? n : n - 1;
  const double step = length_of(line) / (line.closed ? count : count - 1);
  Line even;
  even.closed = line.closed;
  double done = 0, next = 0;
  for (int i = 0; i < pieces; ++i) {
    const Point &a = line.points[i], &b = line.points[(i + 1) % n];
    const double piece = length(b - a);
    while (next <= done + piece && static_cast<int>(even.points.size()) < count) {
      even.points.push_back(a + ((next - done) / piece) * (b - a));
      next += step;
    }
    done += piece;
  }
  while (static_cast<int>(even.points.size()) < count) even.points.push_back(line.points.back());
  return even;
}

// Returns rings about the line, without twist except as needed to close it.
Mesh tube(const Line& line, double radius, int around) {
  const auto n = static_cast<int>(line.points.size());
  std::vector<Point> along(n), side(n);
  for (int i = 0; i < n; ++i)
    along[i] = unit(line.points[line.closed ? (i + 1) % n : std::min(i + 1, n - 1)] -
                    line.points[line.closed ? (i + n - 1) % n : std::max(i - 1, 0)]);
  const Point start = std::fabs(along[0][0]) < 0.7 ? Point{1, 0, 0} : Point{0, 1, 0};
  side[0] = unit(start - dot(start, along[0]) * along[0]);
  for (int i = 1; i < n; ++i) side[i] = unit(side[i - 1] - dot(side[i - 1], along[i]) * along[i]);
  double twist = 0;
  if (line.closed) {
    const Point end = unit(side[n - 1] - dot(side[n - 1], along[0]) * along[0]);
    twist = std::atan2(dot(cross(end, side[0]), along[0]), dot(end, side[0]));
  }
  Mesh mesh;
  for (int i = 0; i < n; ++i)
    for (int k = 0; k < around; ++k) {
      const double angle = 2 * pi * k / around + twist * i / n;
      mesh.points.push_back(line.points[i] + (radius * std::cos(angle)) * side[i] +
                            (radius * std::sin(angle)) * cross(along[i], side[i]));
    }
  for (int i = 0; i < (line.closed ? n : n - 1); ++i)
    for (int k = 0; k < around; ++k) {
      const std::int64_t a = i * around + k, b = i * around + (k + 1) % around;
      const std::int64_t c = (i + 1) % n * around + k, d = (i + 1) % n * around + (k + 1) % around;
      mesh.triangles.insert(mesh.triangles.end(), {{a, b, d}, {a, d, c}});
    }
  if (line.closed) return mesh;
  for (const int end : {0, n - 1}) {
    const auto middle = static_cast<std::int64_t>(mesh.points.size());
    mesh.points.push_back(line.points[end]);
    for (int k = 0; k < around; ++k) {
      const std::int64_t a = end * around + k, b = end * around + (k + 1) % around;
      if (end == 0)
        mesh.triangles.push_back({middle, b, a});
      else
        mesh.triangles.push_back({middle, a, b});
    }
  }
  return mesh;
}

}  // namespace

Body random_tube(Random& random, double nodes) {
  const char* names[] = {"knot", "spring", "loop", "snake"};
  const int kind = random.pick(0, 3);
  constexpr int kSamples = 240;
  Line line = kind == 0   ? knot(random, kSamples)
              : kind == 1 ? spring(random, kSamples)
              : kind == 2 ? loop(random, kSamples)
                          : snake(random, kSamples);
  double radius = random.scale(0.25, 2.5);
  const double gap = random.scale(0.3, 2);
  // The length follows from the number of nodes. If the curve has too little room, the radius is
  // reduced.
  for (int round = 0; round < 20; ++round) {
    const double wanted = nodes / (nodes_of(2 * pi * radius, pi * radius * radius));
    const double factor = wanted / length_of(line);
    for (Point& point : line.points) point = factor * point;
    const double room = room_of(line, gap);
    if (room >= radius) break;
    radius = std::max(0.85 * radius, 0.12);
  }
  const double fineness = random.scale(0.2, 2.5), stretch = random.scale(0.6, 2);
  const int around = std::clamp(static_cast<int>(2 * pi * radius / fineness), 4, 30);
  const int along =
      std::clamp(static_cast<int>(length_of(line) / (fineness * stretch)), 16, 3000 / around);
  Body body;
  body.name = std::string("tube/") + names[kind];
  body.meshes.push_back(tube(resampled(line, along), radius, around));
  return body;
}

}  // namespace hunt
