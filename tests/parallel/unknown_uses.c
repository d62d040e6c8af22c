/* SPDX-License-Identifier: BSD-3-Clause
 *
 * Tests, in builds with PNPBS_COUNT_UNKNOWN_USES, that a rank never decides by values that it does
 * not know exactly, over steps, events and sweeps; and that such uses are counted and reported if
 * the ghost layer is too thin.
 * usage: unknown_uses [thin]  (thin: linked with the library of thin_halo.cpp) */
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

#include "rank_program.h"

static int warns_of_ranks(pnpbs_placement placement) {
  const char* text = "";
  int32_t count = 0, k;
  int found = 0;
  pnpbs_placement_warning_count(placement, &count);
  for (k = 0; k < count; ++k) {
    pnpbs_placement_get_warning(placement, k, &text);
    found |= strstr(text, "the nodes may depend on the number of ranks") != NULL;
  }
  return found;
}

/* Runs a placement and returns how often a rank used values that it does not know exactly.
 * `options` are pairs of key and value, terminated by NULL. */
static int64_t uses_in(int32_t dim, const char* const* options) {
  double finest = dim == 2 ? 0.01 : 0.065;
  pnpbs_domain domain = unit_domain(dim);
  pnpbs_placement placement;
  int64_t uses = -1;
  expect(pnpbs_placement_create(context, domain, &placement) == PNPBS_OK, "placement");
  for (; *options; options += 2)
    expect(pnpbs_placement_set(placement, options[0], options[1]) == PNPBS_OK, options[0]);
  pnpbs_placement_set_spacing_callback(placement, growing_spacing, &finest);
  expect(pnpbs_placement_run(placement) >= 0, "run");
  expect(pnpbs_placement_get_int64(placement, "unknown_uses", &uses) == PNPBS_OK, "statistic");
  expect(warns_of_ranks(placement) == (uses > 0), "there is a warning where uses are counted");
  pnpbs_placement_destroy(&placement);
  pnpbs_domain_destroy(&domain);
  return uses;
}

static void check_all(void) {
  static const char* const enough[][3] = {{"exchange_interval", "8", NULL},
                                          {"method", "paper", NULL}};
  static const char* const seldom[] = {"exchange_interval", "8", NULL};
  int32_t dim;
  size_t k;
  for (dim = 2; dim <= 3; ++dim) {
    if (arguments[0])
      expect(uses_in(dim, seldom) > 0, "thin layers of ghosts are found out");
    else
      for (k = 0; k < sizeof enough / sizeof enough[0]; ++k)
        expect(uses_in(dim, enough[k]) == 0, "what decides is known");
  }
}

int main(int argc, char** argv) { return run_in_groups(argc, argv, check_all); }
