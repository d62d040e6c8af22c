// SPDX-License-Identifier: BSD-3-Clause
#include "surfaces/arrangement.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <limits>
#include <map>
#include <numeric>
#include <set>
#include <span>
#include <unordered_map>
#include <utility>

#include "base/error.hpp"
#include "base/index.hpp"
#include "base/limits.hpp"
#include "base/mixed_hash.hpp"
#include "base/point_text.hpp"
#include "base/space_vectors.hpp"
#include "base/union_find.hpp"
#include "geometry/volume/triangle_contacts.hpp"
#include "geometry/volume/triangles.hpp"
#include "geometry/volume/welding.hpp"
#include "predicates/bit_range.hpp"
#include "predicates/space.hpp"
#include "surfaces/exact_points.hpp"
#include "surfaces/near_contacts.hpp"
#include "surfaces/plane_graph.hpp"
#include "surfaces/plane_triangulation.hpp"
#include "surfaces/thin_triangles.hpp"
#include "tree/box_tree.hpp"

namespace pnpbs {

namespace {

using Corners = std::array<std::int32_t, 3>;
using Segment = std::array<std::int32_t, 2>;

// Most rounds in which triangles are split. Mostly one suffices. Where surfaces lie on each other
// up to rounding, the pieces can cross again in shorter edges.
constexpr int kMostRounds = 40;

// Smallest tolerance for coordinates with few digits: far from the origin, or of single precision.
// [unit of the last digit] Vertices then lie on a triangle within four units of the last digit.
constexpr double kLastDigits = 64;

Corners sorted(Corners vertices) {
  std::sort(vertices.begin(), vertices.end());
  return vertices;
}

void turn_around(Corners& vertices) { std::swap(vertices[1], vertices[2]); }

// Sets of given triangles that contain a piece. A member is twice the index of the triangle, plus 1
// if its orientation is the opposite one.
class ParentSets {
 public:
  explicit ParentSets(std::size_t triangles) : single_(triangles) {
    for (std::size_t t = 0; t < triangles; ++t) single_[t] = static_cast<std::int32_t>(2 * t);
  }

  // Set t contains triangle t alone.
  std::span<const std::int32_t> members(std::int32_t set) const {
    if (index(set) < single_.size()) return {&single_[index(set)], 1};
    return sets_[index(set) - single_.size()];
  }

  // Returns the union of two sets, which can be empty. The orientations of `other` are reversed if
  // `turned` is true.
  std::int32_t united(std::int32_t set, std::int32_t other, bool turned) {
    const std::span<const std::int32_t> own = members(set), others = members(other);
    std::vector<std::int32_t> all(own.begin(), own.end());
    for (const std::int32_t member : others) all.push_back(member ^ (turned ? 1 : 0));
    std::sort(all.begin(), all.end());
    all.erase(std::unique(all.begin(), all.end()), all.end());
    // Parts of a triangle that rounding folds onto each other cancel, so that surfaces stay closed.
    for (std::size_t i = 0; i + 1 < all.size();) {
      if (all[i] / 2 == all[i + 1] / 2) {
        const auto at = all.begin() + static_cast<std::ptrdiff_t>(i);
        all.erase(at, at + 2);
      } else {
        ++i;
      }
    }
    if (std::ranges::equal(all, own)) return set;
    const auto [entry, is_new] =
        known_.try_emplace(all, static_cast<std::int32_t>(single_.size() + sets_.size()));
    if (is_new) sets_.push_back(all);
    return entry->second;
  }

 private:
  std::vector<std::int32_t> single_;
  std::vector<std::vector<std::int32_t>> sets_;
  std::map<std::vector<std::int32_t>, std::int32_t> known_;
};

// A triangle or a part of one.
struct Piece {
  Corners vertices;
  std::int32_t parents;  // index of a set
  bool is_new;           // whether it is a part or was moved in the last round
  std::int32_t before;   // its index in the last round if it is not new
};

FacetCorners<3> corners_of(const std::vector<Point<3>>& positions, const Corners& vertices) {
  return {positions[index(vertices[0])], positions[index(vertices[1])],
          positions[index(vertices[2])]};
}

// Unites pieces with the same vertices: the first stays and gets the parents of all.
void unite_equal(std::vector<Piece>& pieces, ParentSets& parents) {
  std::vector<std::pair<Corners, std::size_t>> order(pieces.size());
  for (std::size_t p = 0; p < pieces.size(); ++p) order[p] = {sorted(pieces[p].vertices), p};
  std::sort(order.begin(), order.end());
  std::vector<char> gone(pieces.size(), 0);
  bool any = false;
  for (std::size_t i = 1, first = 0; i < order.size(); ++i) {
    if (order[i].first != order[first].first) {
      first = i;
      continue;
    }
    Piece& stays = pieces[order[first].second];
    const Piece& other = pieces[order[i].second];
    const bool turned = !same_turn(stays.vertices, other.vertices);
    stays.parents = parents.united(stays.parents, other.parents, turned);
    gone[order[i].second] = 1;
    any = true;
  }
  if (!any) return;
  std::size_t kept = 0;
  for (std::size_t p = 0; p < pieces.size(); ++p)
    if (gone[p] == 0 && !parents.members(pieces[p].parents).empty()) pieces[kept++] = pieces[p];
  pieces.resize(kept);
}

using MeetingPair = std::array<std::int32_t, 2>;  // the lower index first

// Contacts other than in common vertices and edges, in order.
struct Meetings {
  NearContacts near;                 // up to rounding
  std::vector<MeetingPair> exact;    // of pieces
  std::vector<MeetingPair> through;  // a segment of a curve and a piece that it goes through
};

template <class Item>
void sort_unique(std::vector<Item>& items) {
  std::sort(items.begin(), items.end());
  items.erase(std::unique(items.begin(), items.end()), items.end());
}

// Finds where segments of curves meet pieces and each other. `tree` has the boxes of the pieces.
void find_meetings_of_curves(const std::vector<Point<3>>& positions,
                             const std::vector<Piece>& pieces, const BoxTree<3>& tree,
                             const std::vector<ArrangedSegment>& curves, double reach,
                             NearContactSearch& search, std::vector<MeetingPair>& through) {
  std::vector<Box<3>> boxes;
  for (const ArrangedSegment& segment : curves) {
    Box<3> box = empty_box<3>();
    for (const std::int32_t v : segment.ends) include(box, positions[index(v)]);
    boxes.push_back(widened(box, reach / 2));
  }
  const BoxTree<3> tree_of_curves(boxes);
  for (std::int32_t s = 0; s < static_cast<std::int32_t>(curves.size()); ++s) {
    const std::int32_t a = curves[index(s)].ends[0], b = curves[index(s)].ends[1];
    const Segment ends = edge_between(a, b);
    tree.for_meeting(boxes[index(s)], [&](std::int32_t p) {
      const Corners& corners = pieces[index(p)].vertices;
      if (search.add_contacts(p, corners, ends) &&
          segment_meets(positions[index(a)], positions[index(b)], corners_of(positions, corners)))
        through.push_back({s, p});
    });
    tree_of_curves.for_meeting(boxes[index(s)], [&](std::int32_t t) {
      const auto& other = curves[index(t)].ends;
      if (t > s) search.add_contacts(ends, edge_between(other[0], other[1]));
    });
  }
}

// Finds where new pieces meet others, and where curves meet any piece. The tree has the new pieces
// only, which are few after the first round.
Meetings find_meetings(const std::vector<Point<3>>& positions, const std::vector<Piece>& pieces,
                       const std::vector<ArrangedSegment>& curves, double reach) {
  const auto box_of = [&](const Piece& piece) {
    Box<3> box = empty_box<3>();
    for (const std::int32_t v : piece.vertices) include(box, positions[index(v)]);
    return widened(box, reach / 2);
  };
  const auto count = static_cast<std::int32_t>(pieces.size());
  std::vector<std::int32_t> in_tree;
  std::vector<Box<3>> boxes;
  for (std::int32_t p = 0; p < count; ++p)
    if (pieces[index(p)].is_new) {
      in_tree.push_back(p);
      boxes.push_back(box_of(pieces[index(p)]));
    }
  const BoxTree<3> tree(std::move(boxes));
  Meetings meetings;
  NearContactSearch search(positions, reach);
  for (std::int32_t p = 0; p < count; ++p) {
    const Piece& piece = pieces[index(p)];
    tree.for_meeting(box_of(piece), [&](std::int32_t k) {
      const std::int32_t q = in_tree[index(k)];
      const Piece& other = pieces[index(q)];
      if (q == p || (piece.is_new && q < p)) return;
      if (!search.add_contacts(p, piece.vertices, q, other.vertices)) return;
      if (triangles_meet(corners_of(positions, piece.vertices), piece.vertices,
                         corners_of(positions, other.vertices), other.vertices))
        meetings.exact.push_back({std::min(p, q), std::max(p, q)});
    });
  }
  if (!curves.empty()) {
    std::vector<Box<3>> of_all;
    for (const Piece& piece : pieces) of_all.push_back(box_of(piece));
    find_meetings_of_curves(positions, pieces, BoxTree<3>(std::move(of_all)), curves, reach, search,
                            meetings.through);
  }
  meetings.near = std::move(search.contacts());
  sort_unique(meetings.near.in_plane);
  sort_unique(meetings.near.on_edges);
  sort_unique(meetings.near.crossings);
  sort_unique(meetings.near.on_triangles);
  sort_unique(meetings.exact);
  sort_unique(meetings.through);
  return meetings;
}

// Vertices within edges, in the order of the edges and from the lower end to the higher.
using EdgeVertices = std::vector<std::pair<Segment, std::vector<std::int32_t>>>;

// Splits pieces once, where they meet.
class Splitting {
 public:
  Splitting(const std::vector<Point<3>>& positions, const std::vector<Piece>& pieces, double reach)
      : points_(positions),
        pieces_(pieces),
        reach_(reach),
        in_plane_(pieces.size()),
        split_(pieces.size(), 0) {}

  // Splits where pairs of pieces meet exactly, and where segments go through pieces.
  void run(const std::vector<MeetingPair>& pairs, const std::vector<MeetingPair>& through,
           const std::vector<ArrangedSegment>& curves) {
    for (const MeetingPair& pair : pairs)
      for (const std::int32_t p : pair)
        for (const std::int32_t v : vertices(p)) points_.use(v);
    for (const auto& [s, p] : through) {
      for (const std::int32_t v : vertices(p)) points_.use(v);
      for (const std::int32_t v : curves[index(s)].ends) points_.use(v);
    }
    for (const MeetingPair& pair : pairs) find_contact(pair[0], pair[1]);
    for (const auto& [s, p] : through) {
      const auto& [a, b] = curves[index(s)].ends;
      const std::int32_t x = crossing(a, b, p);
      cuts_.push_back({p, {x, x}});
      on_curves_.emplace_back(s, x);
    }
    split_planes();
  }

  // Splits at vertices that lie on pieces up to rounding, and at edges between such vertices.
  void run(const NearContacts& contacts, EdgeVertices within) {
    for (const auto& [p, q] : contacts.in_plane) join(p, q);
    within_edges_ = std::move(within);
    for (std::int32_t p = 0; p < static_cast<std::int32_t>(pieces_.size()); ++p)
      for (std::size_t i = 0; i < 3; ++i)
        if (within_edge(edge(p, i)) != nullptr) grouped_.push_back(p);
    for (const auto& [p, ends] : contacts.on_triangles) cuts_.push_back({p, ends});
    for (const auto& [ends, inside] : within_edges_)
      for (const std::int32_t v : inside) points_.use(v);
    for (const Cut& cut : cuts_)
      for (const std::int32_t v : cut.ends) points_.use(v);
    for (const std::int32_t p : grouped_)
      for (const std::int32_t v : vertices(p)) points_.use(v);
    for (const Cut& cut : cuts_)
      for (const std::int32_t v : vertices(cut.piece)) points_.use(v);
    split_planes();
  }

  // Returns the parts of curves between the points that were found within them.
  std::vector<ArrangedSegment> parts_of(const std::vector<ArrangedSegment>& curves) const {
    std::vector<std::vector<std::int32_t>> within(curves.size());
    for (const auto& [s, x] : on_curves_) within[index(s)].push_back(x);
    std::vector<ArrangedSegment> parts;
    for (std::size_t s = 0; s < curves.size(); ++s) {
      const std::int32_t a = curves[s].ends[0], b = curves[s].ends[1];
      if (const auto* inside = within_edge(edge_between(a, b)))
        within[s].insert(within[s].end(), inside->begin(), inside->end());
      const Point<3> along = difference(position(b), position(a));
      const auto from_a = [&](std::int32_t v) {
        return std::pair(dot(difference(position(v), position(a)), along), v);
      };
      std::ranges::sort(within[s], {}, from_a);
      std::int32_t last = a;
      for (const std::int32_t v : within[s]) {
        parts.push_back({{last, v}, curves[s].number});
        last = v;
      }
      parts.push_back({{last, b}, curves[s].number});
    }
    return parts;
  }

  const ExactPoints& points() const { return points_; }
  // The pieces that were split are replaced by their parts.
  std::vector<Piece> result() && {
    std::vector<Piece> all;
    for (std::size_t p = 0; p < pieces_.size(); ++p)
      if (split_[p] == 0) {
        all.push_back(pieces_[p]);
        all.back().is_new = false;
        all.back().before = static_cast<std::int32_t>(p);
      }
    all.insert(all.end(), parts_.begin(), parts_.end());
    return all;
  }

 private:
  // A segment, or a point if both ends are equal, at which a piece is to be split.
  struct Cut {
    std::int32_t piece;
    Segment ends;
    bool operator<(const Cut& other) const {
      return piece != other.piece ? piece < other.piece : ends < other.ends;
    }
  };

  const Corners& vertices(std::int32_t p) const { return pieces_[index(p)].vertices; }
  const Point<3>& position(std::int32_t v) const { return points_.position(v); }
  Segment edge(std::int32_t p, std::size_t i) const {
    return edge_between(vertices(p)[i], vertices(p)[(i + 1) % 3]);
  }
  // Returns the vertices within an edge, or null if there are none.
  const std::vector<std::int32_t>* within_edge(const Segment& ends) const {
    const auto entry =
        std::lower_bound(within_edges_.begin(), within_edges_.end(), ends,
                         [](const auto& edge, const Segment& other) { return edge.first < other; });
    return entry != within_edges_.end() && entry->first == ends ? &entry->second : nullptr;
  }

  // ------------------------------------------------------------ contacts
  // Stores that two pieces lie in one plane and are to be split together.
  void join(std::int32_t p, std::int32_t q) {
    in_plane_.join(p, q);
    grouped_.push_back(p);
    grouped_.push_back(q);
  }

  void find_contact(std::int32_t p, std::int32_t q) {
    const std::array<int, 3> sides_p = sides(p, q), sides_q = sides(q, p);
    if (sides_p == std::array{0, 0, 0}) {
      join(p, q);
      return;
    }
    // Two triangles in different planes meet in one segment, the ends of which are found.
    std::vector<std::int32_t> ends;
    find_ends(p, sides_p, q, ends);
    find_ends(q, sides_q, p, ends);
    std::sort(ends.begin(), ends.end());
    ends.erase(std::unique(ends.begin(), ends.end()), ends.end());
    if (ends.empty()) return;
    add_cut(p, {ends.front(), ends.back()});
    add_cut(q, {ends.front(), ends.back()});
  }

  // Returns on which sides of the plane of q the vertices of p lie.
  std::array<int, 3> sides(std::int32_t p, std::int32_t q) const {
    const auto& [a, b, c] = vertices(q);
    std::array<int, 3> sides{};
    for (std::size_t k = 0; k < 3; ++k) {
      const std::int32_t v = vertices(p)[k];
      if (v != a && v != b && v != c)
        sides[k] = orientation(position(a), position(b), position(c), position(v));
    }
    return sides;
  }

  // Finds the points at which edges of p cross q, and the vertices of p on q.
  void find_ends(std::int32_t p, const std::array<int, 3>& sides, std::int32_t q,
                 std::vector<std::int32_t>& ends) {
    const Corners &from = vertices(p), &plane = vertices(q);
    const FacetCorners<3> triangle{position(plane[0]), position(plane[1]), position(plane[2])};
    for (std::size_t k = 0; k < 3; ++k) {
      const std::int32_t a = from[k], b = from[(k + 1) % 3];
      if (sides[k] == 0) {
        if (std::find(plane.begin(), plane.end(), a) != plane.end() ||
            on_facet(triangle, position(a)))
          ends.push_back(a);
      } else if (sides[k] * sides[(k + 1) % 3] < 0 &&
                 segment_meets(position(a), position(b), triangle)) {
        ends.push_back(crossing(a, b, q));
      }
    }
  }

  std::int32_t crossing(std::int32_t a, std::int32_t b, std::int32_t q) {
    const auto [entry, is_new] = crossings_.try_emplace({std::min(a, b), std::max(a, b), q}, -1);
    if (is_new) entry->second = points_.on_plane(a, b, vertices(q));
    return entry->second;
  }

  // Vertices and edges of the piece are no cuts.
  void add_cut(std::int32_t p, const Segment& ends) {
    const Corners& corners = vertices(p);
    const auto is_corner = [&](std::int32_t v) {
      return std::find(corners.begin(), corners.end(), v) != corners.end();
    };
    if (!is_corner(ends[0]) || !is_corner(ends[1])) cuts_.push_back({p, ends});
  }

  // ------------------------------------------------------------ planes
  // Splits the pieces that have cuts, those that lie on each other together.
  void split_planes() {
    std::vector<std::pair<std::int32_t, std::int32_t>> members;  // a root and a piece
    for (const std::int32_t p : grouped_) members.emplace_back(in_plane_.root(p), p);
    for (const Cut& cut : cuts_) members.emplace_back(in_plane_.root(cut.piece), cut.piece);
    std::sort(members.begin(), members.end());
    members.erase(std::unique(members.begin(), members.end()), members.end());
    std::sort(cuts_.begin(), cuts_.end());
    std::vector<std::int32_t> group;
    for (std::size_t m = 0; m < members.size(); ++m) {
      group.push_back(members[m].second);
      if (m + 1 < members.size() && members[m + 1].first == members[m].first) continue;
      split_group(group);
      group.clear();
    }
  }

  void split_group(const std::vector<std::int32_t>& group) {
    const int k = axis(group[0]);
    std::vector<Segment> segments;
    for (const std::int32_t p : group) {
      split_[index(p)] = 1;
      for (std::size_t i = 0; i < 3; ++i) {
        const Segment ends = edge(p, i);
        std::int32_t last = ends[0];
        if (const auto* inside = within_edge(ends))
          for (const std::int32_t v : *inside) {
            segments.push_back({last, v});
            last = v;
          }
        segments.push_back({last, ends[1]});
      }
      for (auto cut = std::lower_bound(cuts_.begin(), cuts_.end(), Cut{p, {-1, -1}});
           cut != cuts_.end() && cut->piece == p; ++cut)
        segments.push_back(cut->ends);
    }
    const PlaneGraph graph = split_segments(points_, k, std::move(segments));
    std::vector<Corners> triangles = triangulate(points_, k, graph);
    for (Corners& triangle : triangles)
      for (std::int32_t& v : triangle) v = graph.points[index(v)];
    if (group.size() == 1) {
      add_parts(group[0], k, triangles);
    } else {
      add_parts_of_several(group, k, triangles);
    }
  }

  // Returns an axis along which the projection of the piece has an area, the one along which it is
  // largest if rounding allows.
  int axis(std::int32_t p) const {
    const auto& [a, b, c] = vertices(p);
    const Point<3> normal =
        cross(difference(position(b), position(a)), difference(position(c), position(a)));
    std::array<int, 3> axes{0, 1, 2};
    std::sort(axes.begin(), axes.end(), [&](int i, int j) {
      return std::fabs(normal[static_cast<std::size_t>(i)]) >
             std::fabs(normal[static_cast<std::size_t>(j)]);
    });
    for (const int k : axes)
      if (points_.orientation(k, a, b, c) != 0) return k;
    return axes[0];
  }

  // Adds parts that are counter-clockwise in the projection.
  void add_parts(std::int32_t p, int k, const std::vector<Corners>& triangles) {
    const auto& [a, b, c] = vertices(p);
    const bool turned = points_.orientation(k, a, b, c) < 0;
    for (Corners part : triangles) {
      if (turned) turn_around(part);
      parts_.push_back({part, pieces_[index(p)].parents, true, -1});
    }
  }

  // Adds the parts within any of the pieces, once for each.
  void add_parts_of_several(const std::vector<std::int32_t>& group, int k,
                            const std::vector<Corners>& triangles) {
    std::vector<Box<2>> boxes;
    std::vector<std::array<Point<2>, 3>> outlines;  // the pieces, counter-clockwise
    for (const std::int32_t p : group) {
      boxes.push_back(empty_box<2>());
      outlines.emplace_back();
      for (std::size_t i = 0; i < 3; ++i) {
        outlines.back()[i] = projection(k, position(vertices(p)[i]));
        include(boxes.back(), outlines.back()[i]);
      }
      boxes.back() = widened(boxes.back(), reach_);
      const auto& [a, b, c] = vertices(p);
      if (points_.orientation(k, a, b, c) < 0) std::swap(outlines.back()[1], outlines.back()[2]);
    }
    const BoxTree<2> tree(std::move(boxes));
    std::vector<std::int32_t> found;
    for (const Corners& part : triangles) {
      const Point<2> middle =
          projection(k, centroid({position(part[0]), position(part[1]), position(part[2])}));
      found.clear();
      tree.for_holding(middle, [&](std::int32_t i) {
        if (contains(outlines[index(i)], middle)) found.push_back(group[index(i)]);
      });
      std::sort(found.begin(), found.end());
      for (const std::int32_t p : found) add_parts(p, k, {part});
    }
  }

  // Returns whether a triangle contains the middle of a part. A part lies within the triangle or
  // outside, up to the bends of edges; the middle of a part that is not thin is farther away from
  // the edges.
  bool contains(const std::array<Point<2>, 3>& outline, const Point<2>& middle) const {
    for (std::size_t i = 0; i < 3; ++i) {
      const Point<2>&a = outline[i], &b = outline[(i + 1) % 3];
      const double twice_area =
          (b[0] - a[0]) * (middle[1] - a[1]) - (b[1] - a[1]) * (middle[0] - a[0]);
      if (twice_area < -reach_ * distance<2>(a, b)) return false;
    }
    return true;
  }

  struct KeyHash {
    std::size_t operator()(const Corners& key) const {
      std::uint64_t hash = 0;
      for (const std::int32_t part : key) hash = mixed(hash ^ static_cast<std::uint64_t>(part));
      return hash;
    }
  };

  ExactPoints points_;
  const std::vector<Piece>& pieces_;
  double reach_;
  UnionFind<std::int32_t> in_plane_;  // joins pieces that lie on each other
  std::vector<std::int32_t> grouped_;
  std::vector<Cut> cuts_;
  EdgeVertices within_edges_;
  std::vector<std::pair<std::int32_t, std::int32_t>> on_curves_;  // a segment and a point within it
  std::unordered_map<Corners, std::int32_t, KeyHash> crossings_;  // of an edge and a piece
  std::vector<char> split_;                                       // per piece
  std::vector<Piece> parts_;
};

// Returns the largest unit of the last digit of coordinates. A source has single precision if all
// of its coordinates are numbers of that precision and together use nearly all of its digits.
// Shorter numbers are exact.
double last_digit(const Triangulation& surface) {
  constexpr int kSingleDigits = std::numeric_limits<float>::digits;
  struct Digits {
    bool few = true;
    BitRange range;
  };
  std::vector<Digits> of(surface.sources.size());
  double farthest = 0;
  for (const SurfaceTriangle& triangle : surface.triangles)
    for (const std::int32_t v : triangle.vertices)
      for (const double x : surface.vertices[index(v)]) {
        Digits& digits = of[index(triangle.source)];
        farthest = std::max(farthest, std::fabs(x));
        digits.few = digits.few && std::countr_zero(binary_parts(x).mantissa) >= 53 - kSingleDigits;
        digits.range.include(x);
      }
  const bool any_single = std::ranges::any_of(of, [](const Digits& digits) {
    return digits.few && digits.range.high - digits.range.low > kSingleDigits - 3;
  });
  return farthest * (any_single ? double{std::numeric_limits<float>::epsilon()}
                                : std::numeric_limits<double>::epsilon());
}

// The source and the number of vertices that were not given.
constexpr Triangulation::GivenVertex kIntersection{-1, -1};

class Arranger {
 public:
  Arranger(Triangulation& surface, const std::vector<ArrangedSegment>& curves,
           const ArrangementRule& rule)
      : surface_(surface),
        rule_(rule),
        tolerance_(std::max(
            {rule.tolerance, rule.gap / kContactReach, kLastDigits * last_digit(surface)})),
        positions_(surface.vertices),
        parents_(surface.triangles.size()),
        curves_(curves) {
    for (std::size_t t = 0; t < surface.triangles.size(); ++t)
      pieces_.push_back({surface.triangles[t].vertices, static_cast<std::int32_t>(t), true, -1});
    for (const ArrangedSegment& segment : curves)
      if (segment.ends[0] == segment.ends[1]) points_given_.insert(segment.number);
  }

  ArrangementSummary run(std::vector<ArrangedSegment>& curves,
                         std::vector<CoveredTriangle>& covered) {
    ArrangementSummary summary;
    summary.tolerance = tolerance_;
    if (tolerance_ > rule_.tolerance) {
      round(ExactPoints(positions_), pieces_);
    } else {
      unite_equal(pieces_, parents_);
    }
    std::vector<MeetingPair> remaining;  // pairs that meet exactly and were not split yet
    while (true) {
      Meetings meetings = find_meetings(positions_, pieces_, curves_, kContactReach * tolerance_);
      meetings.exact.insert(meetings.exact.end(), remaining.begin(), remaining.end());
      sort_unique(meetings.exact);
      const bool near = meetings.near.count() > 0;
      if (!near && meetings.exact.empty() && meetings.through.empty()) break;
      if (rule_.split_at == SplitAt::contacts && !near) return {};
      if (summary.rounds == kMostRounds) reject(meetings);
      ++summary.rounds;
      EdgeVertices within = vertices_in_edges(meetings.near);
      Splitting splitting(positions_, pieces_, kContactReach * tolerance_);
      if (near) {
        splitting.run(meetings.near, std::move(within));
      } else {
        splitting.run(meetings.exact, meetings.through, curves_);
      }
      curves_ = splitting.parts_of(curves_);
      std::vector<Piece> pieces = std::move(splitting).result();
      round(splitting.points(), pieces);
      remaining = near ? pairs_between_old(meetings.exact, pieces) : std::vector<MeetingPair>{};
      pieces_ = std::move(pieces);
    }
    if (summary.rounds > 0 || tolerance_ > rule_.tolerance ||
        pieces_.size() < surface_.triangles.size()) {
      write(summary, covered);
      curves = curves_;
    }
    return summary;
  }

 private:
  // Returns the vertices within edges, including new ones where edges cross.
  EdgeVertices vertices_in_edges(const NearContacts& contacts) {
    std::vector<std::pair<Segment, std::int32_t>> all = contacts.on_edges;
    if (!contacts.crossings.empty()) {
      const auto first = static_cast<std::int32_t>(positions_.size());
      for (const auto& [e, f] : contacts.crossings)
        positions_.push_back(
            nearest_to_segment({positions_[index(e[0])], positions_[index(e[1])]},
                               {positions_[index(f[0])], positions_[index(f[1])]}));
      const std::vector<std::int32_t> welded = weld_points(positions_, tolerance_);
      std::int32_t next = first;
      for (const auto& edges : contacts.crossings) {
        const std::int32_t v = welded[index(next++)];
        for (const Segment& edge : edges)
          if (v != edge[0] && v != edge[1]) all.emplace_back(edge, v);
      }
      sort_unique(all);
    }
    EdgeVertices within;
    for (const auto& [edge, v] : all) {
      if (within.empty() || within.back().first != edge) within.push_back({edge, {}});
      within.back().second.push_back(v);
    }
    for (auto& [edge, inside] : within) {
      const Point<3>& a = positions_[index(edge[0])];
      const Point<3> along = difference(positions_[index(edge[1])], a);
      std::sort(inside.begin(), inside.end(), [&](std::int32_t v, std::int32_t w) {
        const double at_v = dot(difference(positions_[index(v)], a), along),
                     at_w = dot(difference(positions_[index(w)], a), along);
        return at_v != at_w ? at_v < at_w : v < w;
      });
    }
    return within;
  }

  // Returns the pairs whose pieces were not changed, by their new indices.
  std::vector<MeetingPair> pairs_between_old(const std::vector<MeetingPair>& pairs,
                                             const std::vector<Piece>& pieces) const {
    std::vector<std::int32_t> now(pieces_.size(), -1);
    for (std::size_t p = 0; p < pieces.size(); ++p)
      if (!pieces[p].is_new) now[index(pieces[p].before)] = static_cast<std::int32_t>(p);
    std::vector<MeetingPair> between;
    for (const auto& [p, q] : pairs)
      if (now[index(p)] >= 0 && now[index(q)] >= 0)
        between.push_back({now[index(p)], now[index(q)]});
    return between;
  }

  // Moves constructed points to doubles, merges those that are too close, and removes pieces
  // without area.
  void round(const ExactPoints& points, std::vector<Piece>& pieces) {
    std::vector<std::int32_t> added;
    for (std::int32_t p = points.given_count(); p < points.count(); ++p) added.push_back(p);
    std::sort(added.begin(), added.end(), [&](std::int32_t a, std::int32_t b) {
      return points.position(a) != points.position(b) ? points.position(a) < points.position(b)
                                                      : a < b;
    });
    std::vector<std::int32_t> vertex(index(points.count()));
    std::iota(vertex.begin(), vertex.begin() + points.given_count(), 0);
    for (const std::int32_t p : added) {
      vertex[index(p)] = static_cast<std::int32_t>(positions_.size());
      positions_.push_back(points.position(p));
    }
    const std::vector<std::int32_t> welded = weld_points(positions_, tolerance_);
    for (Piece& piece : pieces)
      for (std::int32_t& v : piece.vertices) v = welded[index(vertex[index(v)])];
    for (ArrangedSegment& segment : curves_)
      for (std::int32_t& v : segment.ends) v = welded[index(vertex[index(v)])];
    remove_thin(pieces);
    unite_equal_segments();
    unite_equal(pieces, parents_);
  }

  // Keeps the first of several segments with the same ends. Removes segments that became points.
  void unite_equal_segments() {
    std::set<Segment> met;
    std::erase_if(curves_, [&](const ArrangedSegment& segment) {
      const auto& [a, b] = segment.ends;
      if (a == b) return !points_given_.contains(segment.number);
      return !met.insert(edge_between(a, b)).second;
    });
  }

  void remove_thin(std::vector<Piece>& pieces) {
    // The tags are the indices of the pieces.
    Triangulation all{surface_.sources, {}, positions_, {}, {}};
    all.tag_names.resize(surface_.sources.size());
    for (std::size_t p = 0; p < pieces.size(); ++p) {
      const SurfaceTriangle& parent = surface_.triangles[index(parent_of(pieces[p]))];
      all.triangles.push_back(
          {pieces[p].vertices, static_cast<std::int32_t>(p), parent.source, parent.number, false});
    }
    std::vector<Segment> merged;
    if (const auto thin = remove_thin_pieces(all, tolerance_, merged))
      reject_near(all.corners(*thin));
    for (const auto& [goes, stays] : merged)
      for (ArrangedSegment& segment : curves_)
        std::replace(segment.ends.begin(), segment.ends.end(), goes, stays);
    std::vector<Piece> kept;
    for (const SurfaceTriangle& triangle : all.triangles) {
      Piece piece = pieces[index(triangle.tag)];
      piece.is_new = piece.is_new || piece.vertices != triangle.vertices;
      piece.vertices = triangle.vertices;
      kept.push_back(piece);
    }
    pieces = std::move(kept);
  }

  // Returns the first given triangle that contains a piece.
  std::int32_t parent_of(const Piece& piece) const {
    return parents_.members(piece.parents)[0] / 2;
  }

  // The part of a group of triangles near a piece.
  struct NearGroup {
    std::int32_t triangle = -1;  // of the group, nearest to the piece
    double distance = 0;         // largest one of a corner of the piece
  };

  // Returns the groups of given triangles, nearest to the piece with these corners first.
  std::vector<NearGroup> groups_near(const FacetCorners<3>& corners) const {
    struct Distances {
      std::array<double, 3> of_corners{HUGE_VAL, HUGE_VAL, HUGE_VAL};
      std::int32_t triangle = -1;
    };
    std::map<std::pair<std::int32_t, std::int32_t>, Distances> groups;  // by source and tag
    for (std::int32_t t = 0; t < static_cast<std::int32_t>(surface_.triangles.size()); ++t) {
      const SurfaceTriangle& triangle = surface_.triangles[index(t)];
      Distances& group = groups[{triangle.source, triangle.tag}];
      for (std::size_t k = 0; k < 3; ++k) {
        const double gap = distance<3>(nearest_on(surface_.corners(t), corners[k]), corners[k]);
        if (gap >= group.of_corners[k]) continue;
        group.of_corners[k] = gap;
        if (k == 0) group.triangle = t;
      }
    }
    std::vector<NearGroup> near;
    for (const auto& [key, group] : groups)
      near.push_back({group.triangle, std::ranges::max(group.of_corners)});
    std::ranges::stable_sort(near, {}, &NearGroup::distance);
    return near;
  }

  // Rejects surfaces that are too close to each other to be split, at a piece with these corners.
  // Names the two nearest groups that are nearly parallel there.
  [[noreturn]] void reject_near(const FacetCorners<3>& corners) const {
    constexpr double kParallel =
        0.9;  // least cosine of the angle between nearly parallel triangles
    const std::vector<NearGroup> near = groups_near(corners);
    const auto normal_of = [&](const NearGroup& group) {
      return unit_vector(area_normal(surface_.corners(group.triangle)));
    };
    const MessageText place = point_text(corners[0]);
    for (std::size_t j = 1; j < near.size(); ++j)
      for (std::size_t i = 0; i < j; ++i) {
        if (std::fabs(dot(normal_of(near[i]), normal_of(near[j]))) < kParallel) continue;
        throw BrokenSurface(
            surface_.group_name(near[i].triangle) + " and " +
            surface_.group_name(near[j].triangle) + " are within " +
            rounded_text(near[j].distance) + " of each other at " + place +
            ", too near to be split where they meet: pnpbs_domain_set_snap (in the command --snap) "
            "with a larger length makes them one");
      }
    throw BrokenSurface(surface_.group_name(near[0].triangle) + " at " + place +
                        " cannot be split where it meets itself because coordinates are rounded");
  }

  [[noreturn]] void reject(const Meetings& meetings) const {
    std::size_t p = 0;
    if (!meetings.exact.empty()) {
      p = index(meetings.exact[0][0]);
    } else if (!meetings.through.empty()) {
      p = index(meetings.through[0][1]);
    } else {
      const NearContacts& near = meetings.near;
      const std::int32_t v = !near.on_edges.empty()    ? near.on_edges[0].second
                             : !near.crossings.empty() ? near.crossings[0][0][0]
                                                       : near.on_triangles[0].second[0];
      const Point<3>& x = positions_[index(v)];
      const auto distance_of = [&](const Piece& piece) {
        return distance<3>(nearest_on(corners_of(positions_, piece.vertices), x), x);
      };
      p = index(std::ranges::min_element(pieces_, {}, distance_of) - pieces_.begin());
    }
    reject_near(corners_of(positions_, pieces_[p].vertices));
  }

  // Writes the pieces as triangles in the order of the triangles that they come from.
  void write(ArrangementSummary& summary, std::vector<CoveredTriangle>& covered) {
    std::vector<std::pair<std::int32_t, std::size_t>> order;
    for (std::size_t p = 0; p < pieces_.size(); ++p)
      order.emplace_back(parents_.members(pieces_[p].parents)[0] / 2, p);
    std::sort(order.begin(), order.end());
    std::vector<std::int32_t> number(positions_.size(), -1);
    const std::size_t given = surface_.vertices.size();
    surface_.given.resize(given, kIntersection);
    std::iota(number.begin(), number.begin() + static_cast<std::ptrdiff_t>(given), 0);
    const auto vertex = [&](std::int32_t v) {
      if (number[index(v)] < 0) {
        number[index(v)] = static_cast<std::int32_t>(surface_.vertices.size());
        surface_.vertices.push_back(positions_[index(v)]);
        surface_.given.push_back(kIntersection);
      }
      return number[index(v)];
    };
    std::vector<char> unchanged(surface_.triangles.size(), 0);
    std::vector<SurfaceTriangle> triangles;
    for (const auto& [first, p] : order) {
      Corners vertices = pieces_[p].vertices;
      for (std::int32_t& v : vertices) v = vertex(v);
      bool is_first = true;
      for (const std::int32_t member : parents_.members(pieces_[p].parents)) {
        SurfaceTriangle triangle = surface_.triangles[index(member / 2)];
        if (sorted(triangle.vertices) == sorted(vertices)) {
          unchanged[index(member / 2)] = 1;
        } else {
          triangle.vertices = vertices;
          if (member % 2 != 0) triangle.turn_around();
        }
        if (is_first) {
          triangles.push_back(triangle);
        } else {
          covered.push_back({static_cast<std::int32_t>(triangles.size()) - 1, triangle});
        }
        is_first = false;
      }
    }
    surface_.triangles = std::move(triangles);
    for (ArrangedSegment& segment : curves_)
      for (std::int32_t& v : segment.ends) v = vertex(v);
    summary.split = std::count(unchanged.begin(), unchanged.end(), 0);
    summary.new_vertices = static_cast<std::int64_t>(surface_.vertices.size() - given);
    summary.covered = std::ssize(covered);
  }

  Triangulation& surface_;
  const ArrangementRule& rule_;
  double tolerance_;
  std::vector<Point<3>> positions_;  // of the given vertices and of new ones
  ParentSets parents_;
  std::vector<Piece> pieces_;
  std::vector<ArrangedSegment> curves_;
  std::set<std::int32_t> points_given_;  // numbers of the given segments that are points
};

}  // namespace

ArrangementSummary arrange(Triangulation& surface, std::vector<ArrangedSegment>& curves,
                           const ArrangementRule& rule, std::vector<CoveredTriangle>& covered) {
  return Arranger(surface, curves, rule).run(curves, covered);
}

}  // namespace pnpbs
