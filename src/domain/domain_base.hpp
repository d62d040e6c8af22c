// SPDX-License-Identifier: BSD-3-Clause
// The part of a user's domain that is the same in the plane and in space: fixed nodes, holes,
// region points and names of groups.
#pragma once

#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "base/periodic_cell.hpp"
#include "base/types.hpp"
#include "base/warning.hpp"
#include "formats/group_names.hpp"

namespace pnpbs {

// A node that the user prescribes and that does not move.
template <int Dim>
struct FixedNode {
  Point<Dim> position;
  std::int32_t tag;
  std::string name;  // for messages, such as "fixed node 3"
};

// A point inside a region, which extends up to the next curves or surfaces. A hole removes that
// region from the domain; any other region point gives it a tag.
template <int Dim>
struct RegionPoint {
  Point<Dim> point;
  std::string name;      // for messages, such as "hole 0" or "region 2"
  std::int32_t tag = 0;  // 0 for holes
  // True if the point was read from a file. If such a point lies outside the domain, or in a region
  // that has another tag, it is ignored with a warning. For other points this is an error.
  bool from_file = false;

  bool is_hole() const { return tag == 0; }
};

// Stores what the user gives; check() of the derived class resolves it.
template <int Dim>
class DomainBase {
 public:
  // The add functions throw Error(ErrorKind::argument), with the argument and its value, and then
  // leave the domain unchanged. If `tags` is null, all tags are 1.
  void add_fixed_nodes(std::int64_t n, const double* coordinates, const std::int32_t* tags);
  // Removes the region around the point, up to the next curves or surfaces.
  void add_hole(const Point<Dim>& point);
  // Gives `tag` to the region around the point, up to the next curves or surfaces.
  void add_region(const Point<Dim>& point, std::int32_t tag);
  // Add a point that was read from a file; `name` appears in messages (see RegionPoint).
  void add_hole_of_file(const Point<Dim>& point, std::string name);
  void add_region_of_file(const Point<Dim>& point, std::int32_t tag, std::string name);
  // Stores a warning that check() passes on with those of its own.
  void add_warning(Warning warning) {
    given_warnings_.push_back(std::move(warning));
    checked_ = false;
  }
  GroupNames& names() { return names_; }
  const GroupNames& names() const { return names_; }

  bool is_checked() const { return checked_; }
  // Makes the domain the box, and periodic along these axes. The curves and surfaces that are given
  // lie in the box or cross its periodic sides, and stand for all their translated copies. The
  // other sides of the box are boundaries, with tags in the order low x, high x, low y and so on;
  // null means that all are 1. No element crosses the sides across axes with `flat`, which are
  // among the periodic ones.
  void set_periodic(const Box<Dim>& box, const std::array<bool, Dim>& periodic,
                    const std::array<bool, Dim>& flat, const std::int32_t* tags);
  bool is_flat(std::size_t axis) const { return flat_[axis]; }
  std::int32_t side_tag(std::size_t axis, bool high) const { return side_tags_[2 * axis + high]; }
  // Returns the cell of a periodic domain.
  const PeriodicCell<Dim>& cell() const { return cell_; }
  // Resolves the images of a periodic domain within this distance of its cell. Images of nodes have
  // positions there, so it must be as far as the computations at a node reach.
  void set_reach(double reach) {
    checked_ = checked_ && reach == reach_;
    reach_ = reach;
  }

 protected:
  std::vector<FixedNode<Dim>> given_nodes_;
  std::vector<RegionPoint<Dim>> region_points_;
  std::vector<Warning> given_warnings_;
  bool checked_ = false;
  // The cell of a periodic domain, the tags of its sides (low x, high x, low y and so on), which of
  // its axes have flat sides, and the distance from it up to which check() resolves images.
  PeriodicCell<Dim> cell_;
  std::array<std::int32_t, 2 * Dim> side_tags_{};
  std::array<bool, Dim> flat_{};
  double reach_ = 0;

 private:
  GroupNames names_;
  std::int64_t holes_given_ = 0, regions_given_ = 0;  // those added one by one, not from files
};

}  // namespace pnpbs
