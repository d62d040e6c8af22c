// SPDX-License-Identifier: BSD-3-Clause
#include "tool/gathered_picture.hpp"

#include <algorithm>
#include <array>

#include "base/small_letters.hpp"
#include "picture/body.hpp"
#include "picture/node_set.hpp"
#include "tool/cut.hpp"
#include "tool/library.hpp"
#include "tool/own_elements.hpp"
#include "tool/ranks.hpp"

namespace pnpbs::tool {
namespace {

template <int Dim>
struct Node {
  std::int64_t id;
  Point<Dim> position;
  double spacing;
  std::int64_t tag;
};

template <int Dim>
std::vector<Node<Dim>> own_nodes(pnpbs_placement placement, pnpbs_context context) {
  std::int64_t count = 0;
  check(pnpbs_placement_count(placement, &count), context);
  const auto size = static_cast<std::size_t>(count);
  std::vector<Point<Dim>> positions(size);
  std::vector<double> spacing(size);
  std::vector<std::int64_t> ids(size);
  std::vector<std::int32_t> tags(size);
  check(
      pnpbs_placement_get_nodes(placement, count, positions.empty() ? nullptr : positions[0].data(),
                                ids.data(), tags.data(), spacing.data()),
      context);
  std::vector<Node<Dim>> nodes(size);
  for (std::size_t i = 0; i < size; ++i) nodes[i] = {ids[i], positions[i], spacing[i], tags[i]};
  return nodes;
}

// Gathers the owned nodes of all ranks in the order of their ids.
template <int Dim>
std::vector<Node<Dim>> all_nodes(std::vector<Node<Dim>> own, const Ranks& ranks) {
  std::vector<Node<Dim>> nodes = ranks.gather(std::move(own));
  std::ranges::sort(nodes, {}, &Node<Dim>::id);
  return nodes;
}

// Replaces the local indices of corners by ids.
template <int Dim, std::size_t Size>
void name_corners(std::vector<Corners<Size>>& elements, const std::vector<Node<Dim>>& nodes,
                  const std::vector<std::int64_t>& ghosts) {
  for (Corners<Size>& corners : elements)
    for (std::int64_t& corner : corners) {
      const auto i = static_cast<std::size_t>(corner);
      corner = i < nodes.size() ? nodes[i].id : ghosts[i - nodes.size()];
    }
}

// Gathers the elements of all ranks in the order of the ids of their corners. Their corners become
// indices into `ids`.
template <std::size_t Size>
std::vector<Corners<Size>> all_elements(std::vector<Corners<Size>> own,
                                        const std::vector<std::int64_t>& ids, const Ranks& ranks) {
  std::vector<Corners<Size>> elements = ranks.gather(std::move(own));
  std::ranges::sort(elements);
  for (Corners<Size>& corners : elements)
    for (std::int64_t& corner : corners)
      corner = std::ranges::lower_bound(ids, corner) - ids.begin();
  return elements;
}

void take(const std::vector<Node<2>>& nodes, picture::NodeSet& set) {
  set.xy.reserve(2 * nodes.size());
  set.ids.reserve(nodes.size());
  set.tags.reserve(nodes.size());
  set.spacing.reserve(nodes.size());
  for (const Node<2>& node : nodes) {
    set.xy.insert(set.xy.end(), node.position.begin(), node.position.end());
    set.ids.push_back(node.id);
    set.tags.push_back(static_cast<std::int32_t>(node.tag));
    set.spacing.push_back(node.spacing);
  }
}

// Appends the nodes to the body and returns their ids.
std::vector<std::int64_t> take(const std::vector<Node<3>>& nodes, picture::Body& body) {
  std::vector<std::int64_t> ids;
  ids.reserve(nodes.size());
  body.positions.reserve(nodes.size());
  body.spacing.reserve(nodes.size());
  for (const Node<3>& node : nodes) {
    ids.push_back(node.id);
    body.positions.push_back(node.position);
    body.spacing.push_back(node.spacing);
  }
  return ids;
}

// Gathers nodes in the order of their ids and elements in the order of the ids of their corners.
// The result is empty on all ranks but the first. Collective.
picture::NodeSet gathered_nodes(pnpbs_placement placement, pnpbs_context context,
                                const Ranks& ranks) {
  std::vector<Node<2>> own;
  ranks.collective_try([&] { own = own_nodes<2>(placement, context); });
  std::vector<Corners<3>> triangles = own_triangles(placement, context);
  name_corners(triangles, own, ghost_ids(placement, context));
  picture::NodeSet set;
  take(all_nodes(std::move(own), ranks), set);
  set.triangles = all_elements(std::move(triangles), set.ids, ranks);
  return set;
}

picture::Body gathered_body(pnpbs_placement placement, pnpbs_context context, const Ranks& ranks) {
  std::vector<Node<3>> own;
  ranks.collective_try([&] { own = own_nodes<3>(placement, context); });
  const std::vector<std::int64_t> ghosts = ghost_ids(placement, context);
  std::vector<Corners<4>> tetrahedra = own_tetrahedra(placement, context);
  std::vector<Corners<3>> boundary = own_boundary(placement, context);
  name_corners(tetrahedra, own, ghosts);
  name_corners(boundary, own, ghosts);
  picture::Body body;
  const std::vector<std::int64_t> ids = take(all_nodes(std::move(own), ranks), body);
  body.tetrahedra = all_elements(std::move(tetrahedra), ids, ranks);
  body.boundary = all_elements(std::move(boundary), ids, ranks);
  return body;
}

// Adds the curves of the domain. As in files of SCHISM, a curve is open if the name of its tag
// begins with "open".
void add_outline(pnpbs_domain domain, pnpbs_context context, picture::NodeSet& set) {
  std::int64_t count = 0;
  check(pnpbs_domain_get_segments(domain, 0, &count, nullptr, nullptr), context);
  set.outline.resize(4 * static_cast<std::size_t>(count));
  std::vector<std::int32_t> tags(static_cast<std::size_t>(count));
  check(pnpbs_domain_get_segments(domain, count, &count, set.outline.data(), tags.data()), context);
  std::vector<std::int32_t> open;
  for (const GroupName& group : group_names(domain, context))
    if (group.dimension == 1 && to_lower_case(group.name).starts_with("open"))
      open.push_back(group.tag);
  for (const std::int32_t tag : tags)
    set.open.push_back(std::ranges::find(open, tag) != open.end());
}

// Returns the default view, from above the point opposite to the centre of projection, around which
// the domain lies.
picture::SphereView view_of(const Arguments& arguments) {
  const SphereRequest& sphere = *arguments.sphere;
  if (!arguments.view) return {sphere.radius, false, {sphere.outside[0] + 180, -sphere.outside[1]}};
  return {sphere.radius, arguments.view->as_map, arguments.view->from};
}

}  // namespace

PictureLook look_of(const Arguments& arguments, int dimension, const std::string& unit,
                    pnpbs_domain domain, pnpbs_context context) {
  using picture::ElementColour;
  const bool is_body = dimension == 3 && !arguments.sphere;
  const ElementColour default_colour = is_body ? ElementColour::quality : ElementColour::none;
  PictureLook look{{arguments.bubbles, arguments.colour.value_or(default_colour), unit}};
  if (arguments.sphere) look.sphere = view_of(arguments);
  if (is_body) look.cut = cut_plane_for(arguments.cut, domain, context);
  return look;
}

GatheredPicture::GatheredPicture(pnpbs_placement placement, pnpbs_domain domain,
                                 pnpbs_context context, const Ranks& ranks, const PictureLook& look)
    : look_(look) {
  if (look.cut || look.sphere) {
    body_ = gathered_body(placement, context, ranks);
    return;
  }
  nodes_ = gathered_nodes(placement, context, ranks);
  ranks.collective_try([&] {
    if (ranks.is_first()) add_outline(domain, context, nodes_);
  });
}

picture::Drawing GatheredPicture::drawing() const {
  if (look_.sphere) return picture::drawing_of(body_, *look_.sphere, look_.style);
  if (look_.cut) return picture::drawing_of(body_, *look_.cut, look_.style);
  return picture::drawing_of(nodes_, look_.style);
}

}  // namespace pnpbs::tool
