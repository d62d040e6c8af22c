// SPDX-License-Identifier: BSD-3-Clause
#include "picture/colour_scale.hpp"

#include <algorithm>
#include <cmath>

namespace pnpbs::picture {
namespace {

constexpr double room = 0.14;        // minimum distance of two ticks. [length of the bar]
constexpr double max_intervals = 4;  // largest number of intervals between ticks of a linear scale

// Returns the smallest of 1, 2, 5 times a power of ten that is at least `value`.
double round_above(double value) {
  const double power = std::pow(10, std::floor(std::log10(value)));
  // The factor absorbs rounding errors of round numbers.
  const double digit = value / power * (1 - 1e-9);
  return power * (digit <= 1 ? 1 : digit <= 2 ? 2 : digit <= 5 ? 5 : 10);
}

std::vector<double> round_numbers(const ColourScale& scale) {
  std::vector<double> numbers;
  if (scale.logarithmic) {
    const bool powers_only = scale.high > 200 * scale.low;  // room for powers of ten only
    for (double power = std::pow(10, std::floor(std::log10(scale.low))); power < scale.high;
         power *= 10) {
      numbers.push_back(power);
      if (!powers_only) numbers.insert(numbers.end(), {2 * power, 5 * power});
    }
  } else {
    const double step = round_above((scale.high - scale.low) / max_intervals);
    for (double k = std::ceil(scale.low / step); k * step < scale.high; ++k)
      numbers.push_back(k * step);
  }
  return numbers;
}

}  // namespace

double ColourScale::fraction(double value) const {
  if (uniform()) return 0.5;
  const double part =
      logarithmic ? std::log(value / low) / std::log(high / low) : (value - low) / (high - low);
  return std::clamp(part, 0.0, 1.0);
}

int ColourScale::class_of(double value) const {
  return std::min(static_cast<int>(fraction(value) * colour_classes), colour_classes - 1);
}

std::vector<double> ColourScale::ticks() const {
  std::vector<double> ticks{low};
  if (uniform()) return ticks;
  double last = 0;
  for (const double number : round_numbers(*this)) {
    const double place = fraction(number);
    if (place < last + room || place > 1 - room) continue;
    ticks.push_back(number);
    last = place;
  }
  ticks.push_back(high);
  return ticks;
}

}  // namespace pnpbs::picture
