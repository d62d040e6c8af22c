/* SPDX-License-Identifier: BSD-3-Clause
 *
 * Bodies of each kind, and spacings in them, that the tests of placements in space share. */
#ifndef PNPBS_VOLUME_BODIES_H
#define PNPBS_VOLUME_BODIES_H

#include <math.h>
#include <stdio.h>

#include "pnpbs/pnpbs.h"

/* ---------------------------------------------------------------- bodies ---------------- */

/* Adds a body to the domain. `data` is the folder of the examples' bodies. */
typedef pnpbs_status (*volume_body)(pnpbs_domain domain, const char* data);

enum { VOLUME_MAX_TRIANGLES = 64 };

/* Adds quadrilaterals with four corners each, counter-clockwise seen from outside. A triangle
 * repeats its first corner as the fourth. */
static inline pnpbs_status volume_add_quads(pnpbs_domain domain, int32_t role, int64_t vertices,
                                            const double* xyz, int quads, const int (*corners)[4]) {
  int64_t triangles[VOLUME_MAX_TRIANGLES][3];
  int64_t n = 0;
  int q, half;
  for (q = 0; q < quads; ++q)
    for (half = 0; half < (corners[q][3] == corners[q][0] ? 1 : 2); ++half, ++n) {
      triangles[n][0] = corners[q][0];
      triangles[n][1] = corners[q][1 + half];
      triangles[n][2] = corners[q][2 + half];
    }
  return pnpbs_domain_add_surface(domain, role, vertices, xyz, n, triangles[0], NULL, 40);
}

static inline pnpbs_status volume_unit_box(pnpbs_domain domain, const char* data) {
  const double low[] = {0, 0, 0}, high[] = {1, 1, 1};
  (void)data;
  return pnpbs_domain_add_box(domain, low, high, 1);
}

/* The unit box around a thin cavity. */
static inline pnpbs_status volume_slotted(pnpbs_domain domain, const char* data) {
  const double low[] = {0.48, 0.3, 0.3}, high[] = {0.52, 0.7, 0.7};
  const pnpbs_status status = volume_unit_box(domain, data);
  return status < 0 ? status : pnpbs_domain_add_box(domain, low, high, 2);
}

static inline pnpbs_status volume_unit_ball(pnpbs_domain domain, const char* data) {
  const double centre[] = {0, 0, 0};
  (void)data;
  return pnpbs_domain_add_ball(domain, centre, 1, 3);
}

enum { GLOBE_ROWS = 12, GLOBE_TRIANGLES = 8 * GLOBE_ROWS * GLOBE_ROWS };

/* Computes the point of the sphere above point (i, j) of a side of an octahedron. */
static inline void volume_globe_corner(const double* centre, double radius, int octant, int i,
                                       int j, double* xyz) {
  const double side[] = {(double)i, (double)j, (double)(GLOBE_ROWS - i - j)};
  const double length = sqrt(side[0] * side[0] + side[1] * side[1] + side[2] * side[2]);
  int k;
  for (k = 0; k < 3; ++k)
    xyz[k] = centre[k] + (octant >> k & 1 ? -1 : 1) * radius * side[k] / length;
}

/* Adds a coarse globe: an octahedron whose sides are divided into small triangles. The lower half
 * has a tag of its own. */
static inline pnpbs_status volume_add_halves(pnpbs_domain domain, const double* centre,
                                             double radius, int32_t upper, int32_t lower) {
  static double xyz[3 * GLOBE_TRIANGLES][3];
  static int64_t corners[GLOBE_TRIANGLES][3];
  static int32_t tags[GLOBE_TRIANGLES];
  int octant, i, j, up;
  int64_t n = 0, k;
  for (octant = 0; octant < 8; ++octant)
    for (i = 0; i < GLOBE_ROWS; ++i)
      for (j = 0; i + j < GLOBE_ROWS; ++j)
        for (up = 0; up < (i + j + 1 < GLOBE_ROWS ? 2 : 1); ++up, ++n) {
          volume_globe_corner(centre, radius, octant, i + up, j + up, xyz[3 * n]);
          volume_globe_corner(centre, radius, octant, i + 1, j, xyz[3 * n + 1]);
          volume_globe_corner(centre, radius, octant, i, j + 1, xyz[3 * n + 2]);
          tags[n] = octant >> 2 & 1 ? lower : upper;
        }
  for (k = 0; k < 3 * n; ++k) corners[k / 3][k % 3] = k;
  return pnpbs_domain_add_surface(domain, PNPBS_BOUNDARY, 3 * n, xyz[0], n, corners[0], tags, 40);
}

static inline pnpbs_status volume_add_globe(pnpbs_domain domain, const double* centre,
                                            double radius) {
  return volume_add_halves(domain, centre, radius, 1, 1);
}

static inline pnpbs_status volume_globe(pnpbs_domain domain, const char* data) {
  const double centre[] = {0, 0, 0};
  (void)data;
  return volume_add_globe(domain, centre, 1);
}

/* Computes the corners of the triangles of a globe with bumps and dents, whose depth and number
 * grow with the first two arguments. Returns the number of corners. xyz has room for 3 *
 * GLOBE_TRIANGLES. */
static inline int64_t volume_rough_globe_corners(double depth, double waves, double (*xyz)[3]) {
  static const double centre[] = {0, 0, 0};
  int octant, i, j, up, k;
  int64_t n = 0, c;
  for (octant = 0; octant < 8; ++octant)
    for (i = 0; i < GLOBE_ROWS; ++i)
      for (j = 0; i + j < GLOBE_ROWS; ++j)
        for (up = 0; up < (i + j + 1 < GLOBE_ROWS ? 2 : 1); ++up, ++n) {
          volume_globe_corner(centre, 1, octant, i + up, j + up, xyz[3 * n]);
          volume_globe_corner(centre, 1, octant, i + 1, j, xyz[3 * n + 1]);
          volume_globe_corner(centre, 1, octant, i, j + 1, xyz[3 * n + 2]);
        }
  for (c = 0; c < 3 * n; ++c) {
    double* x = xyz[c];
    const double r = 1 + depth * sin(waves * x[0]) * sin(waves * x[1] + 1) * sin(waves * x[2] + 2);
    for (k = 0; k < 3; ++k) x[k] *= r;
  }
  return 3 * n;
}

static inline pnpbs_status volume_add_rough_globe(pnpbs_domain domain, double depth, double waves) {
  static double xyz[3 * GLOBE_TRIANGLES][3];
  static int64_t corners[GLOBE_TRIANGLES][3];
  const int64_t n = volume_rough_globe_corners(depth, waves, xyz);
  int64_t c;
  for (c = 0; c < n; ++c) corners[c / 3][c % 3] = c;
  return pnpbs_domain_add_surface(domain, PNPBS_BOUNDARY, n, xyz[0], n / 3, corners[0], NULL, 40);
}

/* A globe with small angles nearly everywhere at d = 0.4. */
static inline pnpbs_status volume_rough_globe(pnpbs_domain domain, const char* data) {
  (void)data;
  return volume_add_rough_globe(domain, 0.5, 8);
}

/* The unit box without a quarter: the union of three boxes of half its size and height 1. */
static inline pnpbs_status volume_l_block(pnpbs_domain domain, const char* data) {
  const double outline[6][2] = {{0, 0}, {1, 0}, {1, 0.5}, {0.5, 0.5}, {0.5, 1}, {0, 1}};
  const int sides[14][4] = {{0, 1, 7, 6},   {1, 2, 8, 7},  {2, 3, 9, 8}, {3, 4, 10, 9},
                            {4, 5, 11, 10}, {5, 0, 6, 11}, {0, 2, 1, 0}, {0, 3, 2, 0},
                            {0, 4, 3, 0},   {0, 5, 4, 0},  {6, 7, 8, 6}, {6, 8, 9, 6},
                            {6, 9, 10, 6},  {6, 10, 11, 6}};
  double xyz[12][3];
  int k;
  (void)data;
  for (k = 0; k < 12; ++k) {
    xyz[k][0] = outline[k % 6][0];
    xyz[k][1] = outline[k % 6][1];
    xyz[k][2] = k / 6;
  }
  return volume_add_quads(domain, PNPBS_BOUNDARY, 12, xyz[0], 14, sides);
}

/* The unit box around a spherical cavity. */
static inline pnpbs_status volume_cavity(pnpbs_domain domain, const char* data) {
  const double centre[] = {0.45, 0.5, 0.55};
  const pnpbs_status status = volume_unit_box(domain, data);
  return status < 0 ? status : volume_add_globe(domain, centre, 0.25);
}

/* Two unit boxes side by side with the wall between them. */
static inline pnpbs_status volume_two_halves(pnpbs_domain domain, const char* data) {
  const double around[4][2] = {{0, 0}, {1, 0}, {1, 1}, {0, 1}};
  const int sides[10][4] = {{0, 1, 5, 4}, {1, 2, 6, 5},  {2, 3, 7, 6},   {3, 0, 4, 7},
                            {4, 5, 9, 8}, {5, 6, 10, 9}, {6, 7, 11, 10}, {7, 4, 8, 11},
                            {3, 2, 1, 0}, {8, 9, 10, 11}};
  const int wall[1][4] = {{0, 1, 2, 3}};
  double xyz[12][3];
  pnpbs_status status;
  int k;
  (void)data;
  for (k = 0; k < 12; ++k) {
    xyz[k][0] = k / 4;
    xyz[k][1] = around[k % 4][0];
    xyz[k][2] = around[k % 4][1];
  }
  status = volume_add_quads(domain, PNPBS_BOUNDARY, 12, xyz[0], 10, sides);
  return status < 0 ? status : volume_add_quads(domain, PNPBS_INNER, 4, xyz[4], 1, wall);
}

/* A ring about the z axis as a level set of the distance to it. The planes of its box are not
 * lattice planes. */
static inline int32_t volume_ring_at(int64_t n, int32_t dim, const double* x, double* f,
                                     void* user) {
  int64_t i;
  (void)user;
  for (i = 0; i < n; ++i) {
    const double* at = x + dim * i;
    const double across = sqrt(at[0] * at[0] + at[1] * at[1]) - 1;
    f[i] = sqrt(across * across + at[2] * at[2]) - 0.4;
  }
  return 0;
}

static inline pnpbs_status volume_ring(pnpbs_domain domain, const char* data) {
  const double low[] = {-1.5, -1.53, -0.5}, high[] = {1.6, 1.5, 0.51};
  (void)data;
  return pnpbs_domain_add_level_set(domain, volume_ring_at, NULL, low, high, 0.1, 5);
}

static inline pnpbs_status volume_read(pnpbs_domain domain, const char* data, const char* name) {
  char path[4200];
  snprintf(path, sizeof path, "%s/%s", data, name);
  return pnpbs_domain_read_surface(domain, PNPBS_BOUNDARY, path, 40);
}

static inline pnpbs_status volume_bracket(pnpbs_domain domain, const char* data) {
  return volume_read(domain, data, "bracket.stl");
}
static inline pnpbs_status volume_kleopatra(pnpbs_domain domain, const char* data) {
  return volume_read(domain, data, "kleopatra.obj");
}
static inline pnpbs_status volume_eros(pnpbs_domain domain, const char* data) {
  return volume_read(domain, data, "eros.off");
}

/* ---------------------------------------------------------------- surfaces alone -------- */

/* A sphere as a surface of two halves. Nodes lie on the equator, where the tags meet. */
static inline pnpbs_status surface_halves(pnpbs_domain domain, const char* data) {
  const double centre[] = {0, 0, 0};
  const pnpbs_status status = pnpbs_domain_set_filled(domain, 0);
  (void)data;
  return status < 0 ? status : volume_add_halves(domain, centre, 1, 1, 2);
}

static inline double terrain_height(double x, double y) {
  return 0.6 * x * (1 - x * x) * (1 - 0.5 * y * y) + 0.25 * y * y * (1 - y) - 0.1 * x * y;
}

enum { TERRAIN_ROWS = 40 };

/* Hills and valleys over the square from (-1, -1) to (1, 1): an open surface with a border. */
static inline pnpbs_status surface_terrain(pnpbs_domain domain, const char* data) {
  static double xyz[(TERRAIN_ROWS + 1) * (TERRAIN_ROWS + 1)][3];
  static int64_t corners[2 * TERRAIN_ROWS * TERRAIN_ROWS][3];
  const pnpbs_status status = pnpbs_domain_set_filled(domain, 0);
  int64_t n = 0, vertices = 0;
  int i, j, half;
  (void)data;
  for (j = 0; j <= TERRAIN_ROWS; ++j)
    for (i = 0; i <= TERRAIN_ROWS; ++i, ++vertices) {
      xyz[vertices][0] = 2.0 * i / (double)TERRAIN_ROWS - 1;
      xyz[vertices][1] = 2.0 * j / (double)TERRAIN_ROWS - 1;
      xyz[vertices][2] = terrain_height(xyz[vertices][0], xyz[vertices][1]);
    }
  for (j = 0; j < TERRAIN_ROWS; ++j)
    for (i = 0; i < TERRAIN_ROWS; ++i)
      for (half = 0; half < 2; ++half, ++n) {
        const int64_t low = j * (TERRAIN_ROWS + 1) + i, high = low + TERRAIN_ROWS + 2;
        corners[n][0] = low;
        corners[n][1] = half ? high : low + 1;
        corners[n][2] = half ? high - 1 : high;
      }
  if (status < 0) return status;
  return pnpbs_domain_add_surface(domain, PNPBS_BOUNDARY, vertices, xyz[0], n, corners[0], NULL,
                                  40);
}

/* The surface of the L-shaped block, with creases. */
static inline pnpbs_status surface_l_block(pnpbs_domain domain, const char* data) {
  const pnpbs_status status = pnpbs_domain_set_filled(domain, 0);
  return status < 0 ? status : volume_l_block(domain, data);
}
static inline pnpbs_status surface_kleopatra(pnpbs_domain domain, const char* data) {
  const pnpbs_status status = pnpbs_domain_set_filled(domain, 0);
  return status < 0 ? status : volume_kleopatra(domain, data);
}

/* ---------------------------------------------------------------- spacings -------------- */

/* A spacing that grows from a point, a line or a plane: Coordinates of `from` that are nan do not
 * count. Beyond an x it has another value. It uses only + - * / and square roots, which have the
 * same bits everywhere. */
struct volume_spacing {
  double constant, slope, from[3];
  double beyond_x, there;
};

#define VOLUME_CONSTANT(d) \
  { d, 0, {0, 0, 0}, HUGE_VAL, 0 }
#define VOLUME_GRADED(d, slope, x, y, z) \
  { d, slope, {x, y, z}, HUGE_VAL, 0 }

static inline int32_t volume_spacing_at(int64_t n, int32_t dim, const double* x, double* d,
                                        void* user) {
  const struct volume_spacing* s = (const struct volume_spacing*)user;
  int64_t i;
  int k;
  for (i = 0; i < n; ++i) {
    double square = 0;
    for (k = 0; k < dim; ++k) {
      const double away = isnan(s->from[k]) ? 0 : x[dim * i + k] - s->from[k];
      square += away * away;
    }
    d[i] = x[dim * i] > s->beyond_x ? s->there : s->constant + s->slope * sqrt(square);
  }
  return 0;
}

#endif
