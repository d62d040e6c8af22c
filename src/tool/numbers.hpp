// SPDX-License-Identifier: BSD-3-Clause
// Numbers for people.
#pragma once

#include <cstdint>
#include <string>

namespace pnpbs::tool {

std::string grouped(std::int64_t count);                 // 103 214
std::string short_number(double value, int digits = 3);  // significant digits
std::string size_in_bytes(double bytes);                 // 131 MiB
std::string duration(double seconds);                    // 0.94 s, 12 s, 3 min 20 s, 2 h 5 min

}  // namespace pnpbs::tool
