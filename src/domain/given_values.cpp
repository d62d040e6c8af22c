// SPDX-License-Identifier: BSD-3-Clause
#include "domain/given_values.hpp"

namespace pnpbs::given_values {

void reject(const MessageText& message) { throw Error(ErrorKind::argument, message); }

std::string indexed(const std::string& name, std::int64_t index) {
  return name + "[" + std::to_string(index) + "]";
}

void require_number(const std::string& name, double value) {
  if (is_usable(value)) return;
  reject(name + " is " + number_text(value) + ", expected a number between -1e60 and 1e60");
}

void require_array(const char* name, const void* array, std::int64_t n) {
  if (n > 0 && array == nullptr) reject(std::string(name) + " is NULL");
}

void require_count(const char* name, std::int64_t value, std::int64_t min) {
  if (value >= min && value < (std::int64_t{1} << 31) - 1) return;
  reject(std::string(name) + " is " + std::to_string(value) + ", expected at least " +
         std::to_string(min) + " and less than 2^31 - 1");
}

void require_tag(const std::string& name, std::int32_t tag) {
  if (tag == 0) reject(name + " is 0, expected a nonzero tag (0 marks inner nodes)");
}

void require_radius(double radius) {
  if (radius > 0 && is_usable(radius)) return;
  reject("radius is " + number_text(radius) + ", expected a positive number up to 1e60");
}

void require_angle(const char* name, double degrees) {
  if (degrees >= 0 && degrees <= 180) return;
  reject(std::string(name) + " is " + number_text(degrees) + ", expected 0 to 180 degrees");
}

std::vector<std::int32_t> read_tags(const char* name, std::int64_t n, const std::int32_t* tags) {
  if (tags == nullptr) return std::vector<std::int32_t>(static_cast<std::size_t>(n), 1);
  for (std::int64_t i = 0; i < n; ++i)
    if (tags[i] == 0) require_tag(indexed(name, i), 0);
  return {tags, tags + n};
}

}  // namespace pnpbs::given_values
