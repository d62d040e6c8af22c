// SPDX-License-Identifier: BSD-3-Clause
// Bodies and spacings of pnpbs-bench in space.
#pragma once

#include <string>
#include <vector>

#include "evaluate_volume.hpp"
#include "volume_bodies.h"

namespace pnpbs_bench {

struct VolumeCase {
  std::string name;
  volume_body body;
  volume_spacing spacing;  // for about 70 000 nodes
  Inside (*inside)(const std::string& data);

  bool constant() const { return spacing.slope == 0; }
  volume_spacing scaled(double factor) const;
};

std::vector<VolumeCase> volume_cases();

}  // namespace pnpbs_bench
