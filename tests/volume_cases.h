/* SPDX-License-Identifier: BSD-3-Clause
 *
 * Small placements in space that the tests share: bodies of each kind, with constant and graded
 * spacing. */
#ifndef PNPBS_VOLUME_CASES_H
#define PNPBS_VOLUME_CASES_H

#include "volume_bodies.h"

struct volume_case {
  const char* name;
  volume_body body;
  struct volume_spacing spacing;
};

/* Each case has up to about 10 000 nodes. d of the graded ones varies by a factor of 5. */
static const struct volume_case volume_cases[] = {
    {"box", volume_unit_box, VOLUME_CONSTANT(0.07)},
    {"box-graded", volume_unit_box, VOLUME_GRADED(0.022, 0.1, 0.5, 0.5, 0.5)},
    {"box-layer", volume_unit_box, VOLUME_GRADED(0.03, 0.2, NAN, 0.5, NAN)},
    {"box-jump", volume_unit_box, {0.16, 0, {0, 0, 0}, 0.52, 0.045}},
    {"ball", volume_unit_ball, VOLUME_CONSTANT(0.13)},
    {"globe", volume_globe, VOLUME_CONSTANT(0.11)},
    {"ring", volume_ring, VOLUME_CONSTANT(0.12)},
    {"ring-graded", volume_ring, VOLUME_GRADED(0.06, 0.06, 1, 0, 0)},
    {"l-block", volume_l_block, VOLUME_CONSTANT(0.06)},
    {"l-block-graded", volume_l_block, VOLUME_GRADED(0.02, 0.12, 0.5, 0.5, NAN)},
    {"cavity", volume_cavity, VOLUME_CONSTANT(0.07)},
    {"two-halves", volume_two_halves, VOLUME_CONSTANT(0.09)},
    {"bracket", volume_bracket, VOLUME_CONSTANT(2.7)},
    {"kleopatra", volume_kleopatra, VOLUME_CONSTANT(6)},
    {"kleopatra-graded", volume_kleopatra, VOLUME_GRADED(2, 0.08, 100, 0, 0)},
    {"eros", volume_eros, VOLUME_CONSTANT(0.05)},
    {"eros-graded", volume_eros, VOLUME_GRADED(0.018, 0.08, 0, 0.1, 0)},
    {"slotted", volume_slotted, VOLUME_CONSTANT(0.12)}, /* d is larger than the width of the slot */
    {"surface-halves", surface_halves, VOLUME_CONSTANT(0.05)},
    {"surface-terrain", surface_terrain, VOLUME_GRADED(0.02, 0.03, 0.5, 0, 0)},
    {"surface-l-block", surface_l_block, VOLUME_CONSTANT(0.05)},
    {"surface-kleopatra", surface_kleopatra, VOLUME_GRADED(2, 0.03, 100, 0, 0)},
};

enum { VOLUME_CASES = sizeof volume_cases / sizeof volume_cases[0] };

#endif
