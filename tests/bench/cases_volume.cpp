// SPDX-License-Identifier: BSD-3-Clause
#include "cases_volume.hpp"

namespace pnpbs_bench {

namespace {

bool in_box(const Place& x) {
  for (const double along : x)
    if (along < 0 || along > 1) return false;
  return true;
}

Inside inside_of_box(const std::string&) { return in_box; }
Inside inside_of_l_block(const std::string&) {
  return [](const Place& x) { return in_box(x) && (x[0] <= 0.5 || x[1] <= 0.5); };
}
Inside inside_of_ball(const std::string&) {
  return [](const Place& x) { return x[0] * x[0] + x[1] * x[1] + x[2] * x[2] <= 1; };
}
Inside inside_of_bracket(const std::string& data) { return inside_of_file(data + "/bracket.stl"); }
Inside inside_of_eros(const std::string& data) { return inside_of_file(data + "/eros.off"); }
Inside inside_of_kleopatra(const std::string& data) {
  return inside_of_file(data + "/kleopatra.obj");
}

}  // namespace

volume_spacing VolumeCase::scaled(double factor) const {
  volume_spacing s = spacing;
  s.constant *= factor;
  s.slope *= factor;
  return s;
}

std::vector<VolumeCase> volume_cases() {
  return {
      {"volume-cube", volume_unit_box, VOLUME_CONSTANT(0.0285), inside_of_box},
      {"volume-ball", volume_unit_ball, VOLUME_CONSTANT(0.0455), inside_of_ball},
      {"volume-l-block", volume_l_block, VOLUME_CONSTANT(0.0258), inside_of_l_block},
      {"volume-cube-graded", volume_unit_box,
       VOLUME_GRADED(0.0098, 4 * 0.0098 / 0.866, 0.5, 0.5, 0.5), inside_of_box},
      {"volume-bracket", volume_bracket, VOLUME_GRADED(0.53 * 0.8, 0.53 * 0.05, 62, 14, NAN),
       inside_of_bracket},
      {"volume-eros", volume_eros, VOLUME_CONSTANT(0.0187), inside_of_eros},
      {"volume-eros-graded", volume_eros, VOLUME_GRADED(0.009, 0.018, -0.8, NAN, NAN),
       inside_of_eros},
      {"volume-kleopatra", volume_kleopatra, VOLUME_CONSTANT(2.53), inside_of_kleopatra},
      {"volume-kleopatra-graded", volume_kleopatra, VOLUME_GRADED(1.3, 0.02, -110, NAN, NAN),
       inside_of_kleopatra},
  };
}

}  // namespace pnpbs_bench
