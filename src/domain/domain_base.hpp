// SPDX-License-Identifier: BSD-3-Clause
// What users give of a domain in the plane and in space alike, and whether it has been checked
// since.
#pragma once

#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "base/types.hpp"
#include "base/warning.hpp"
#include "formats/group_names.hpp"

namespace pnpbs {

template <int Dim>
struct FixedNode {
  Point<Dim> position;
  std::int32_t tag;
  std::string name;  // for messages: "fixed node 3"
};

// A point that stands for the region around it, up to the next curves or surfaces: which is taken
// out, or gets a tag.
template <int Dim>
struct RegionPoint {
  Point<Dim> point;
  std::string name;      // for messages: "hole 0", "region 2"
  std::int32_t tag = 0;  // 0 of holes
  // A file's: where it lies in no region of the domain, or in one with another tag, it does not
  // count, with a warning. Others are errors then.
  bool from_file = false;

  bool is_hole() const { return tag == 0; }
};

template <int Dim>
class DomainBase {
 public:
  // They throw Error(ErrorKind::argument) naming the argument and its value, and leave the domain
  // as it was. Without tags (null), all are 1.
  void add_fixed_nodes(std::int64_t n, const double* coordinates, const std::int32_t* tags);
  // Takes out what lies around the point, up to the next curves or surfaces.
  void add_hole(const Point<Dim>& point);
  // Gives a tag to the same.
  void add_region(const Point<Dim>& point, std::int32_t tag);
  // Add points of a file, with a name for messages: see RegionPoint.
  void add_hole_of_file(const Point<Dim>& point, std::string name);
  void add_region_of_file(const Point<Dim>& point, std::int32_t tag, std::string name);
  // To be told with those that check() finds.
  void add_warning(Warning warning) {
    given_warnings_.push_back(std::move(warning));
    checked_ = false;
  }
  GroupNames& names() { return names_; }
  const GroupNames& names() const { return names_; }

  bool is_checked() const { return checked_; }

 protected:
  std::vector<FixedNode<Dim>> given_nodes_;
  std::vector<RegionPoint<Dim>> region_points_;
  std::vector<Warning> given_warnings_;
  bool checked_ = false;

 private:
  GroupNames names_;
  std::int64_t holes_given_ = 0, regions_given_ = 0;  // one by one
};

}  // namespace pnpbs
