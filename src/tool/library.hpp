// SPDX-License-Identifier: BSD-3-Clause
// Wrappers of the C interface with owned handles, which turn errors into exceptions.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "pnpbs/pnpbs.h"
#include "tool/exit.hpp"

namespace pnpbs::tool {

template <typename Handle, pnpbs_status (*destroy)(Handle*)>
class Owned {
 public:
  Owned() = default;
  ~Owned() { destroy(&handle_); }
  Owned(const Owned&) = delete;
  Owned& operator=(const Owned&) = delete;
  operator Handle() const { return handle_; }
  Handle* out() { return &handle_; }

 private:
  Handle handle_ = nullptr;
};

using Context = Owned<pnpbs_context, pnpbs_context_destroy>;
using Domain = Owned<pnpbs_domain, pnpbs_domain_destroy>;
using Placement = Owned<pnpbs_placement, pnpbs_placement_destroy>;
using Voronoi = Owned<pnpbs_voronoi, pnpbs_voronoi_destroy>;
using Particles = Owned<pnpbs_particles, pnpbs_particles_destroy>;

// Returns the exit code for an error of the library.
ExitCode exit_code_of(pnpbs_status error);

// Throws Failure with the library's message if status is an error; otherwise returns the status.
pnpbs_status check(pnpbs_status status, pnpbs_context context);

struct LibraryOption {
  std::string name, type, default_value, range, help;
};
std::vector<LibraryOption> library_options();

struct LibraryStatistic {
  std::string name, type, help;
};
std::vector<LibraryStatistic> library_statistics();

struct LibraryFormat {
  std::string name, help;
  bool binary, elements;  // elements: whether they are written on request
};
std::vector<LibraryFormat> library_formats();

struct GroupName {
  std::int32_t dimension, tag;
  std::string name;
};
std::vector<GroupName> group_names(pnpbs_domain domain, pnpbs_context context);

struct Warning {
  std::int32_t code;  // PNPBS_WARNING_...
  std::string text;
};
std::vector<Warning> warnings_of(pnpbs_context context, pnpbs_placement placement);

}  // namespace pnpbs::tool
