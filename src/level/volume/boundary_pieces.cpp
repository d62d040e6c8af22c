// SPDX-License-Identifier: BSD-3-Clause
#include "level/volume/boundary_pieces.hpp"

#include <algorithm>
#include <map>
#include <set>
#include <vector>

#include "base/union_find.hpp"
#include "comm/records.hpp"
#include "level/volume/open_faces.hpp"

namespace pnpbs {

namespace {

// A piece as two ranks identify it: each by the smallest id of its nodes on that rank.
struct SamePiece {
  std::int64_t here, there;

  auto operator<=>(const SamePiece&) const = default;
};

// The id of a node, and the piece it belongs to.
struct NamedNode {
  std::int64_t id, piece;

  void translate(const Translation<3>& by, const BoundarySeenFrom<3>&) { id = by.id(id); }
};

// The number of nodes that one rank has of a piece.
struct NodesOfPiece {
  std::int64_t piece, nodes;
};

// Returns for each node of this rank the smallest id of its piece on this rank, or -1 if it has no
// face in common with an owned node.
std::vector<std::int64_t> pieces_here(const Level<3>& level) {
  const Nodes<3>& nodes = level.nodes;
  const auto count = static_cast<std::size_t>(nodes.count);
  UnionFind<std::size_t> joined(count);
  std::vector<char> any(count, 0);
  for (std::int64_t i = 0; i < nodes.count; ++i) {
    if (!nodes.owned(i)) continue;
    for (const auto& [a, b] : open_faces(level, i))
      for (const std::int64_t j : {i, std::int64_t{a}, std::int64_t{b}}) {
        any[static_cast<std::size_t>(j)] = 1;
        joined.join(static_cast<std::size_t>(i), static_cast<std::size_t>(j));
      }
  }
  std::map<std::size_t, std::int64_t> least;
  for (std::size_t i = 0; i < count; ++i) {
    if (any[i] == 0) continue;
    const std::int64_t id = nodes.id(static_cast<std::int64_t>(i));
    const auto found = least.try_emplace(joined.root(i), id).first;
    found->second = std::min(found->second, id);
  }
  std::vector<std::int64_t> pieces(count, -1);
  for (std::size_t i = 0; i < count; ++i)
    if (any[i] != 0) pieces[i] = least[joined.root(i)];
  return pieces;
}

// Returns pairs of names: that of a ghost's piece on this rank, and that on the owner of the ghost.
// Collective.
std::set<SamePiece> same_pieces(const Level<3>& level, const std::vector<std::int64_t>& pieces) {
  const Nodes<3>& nodes = level.nodes;
  std::vector<std::int32_t> own;
  std::map<std::int64_t, std::int64_t> of_ghosts;
  for (std::int64_t i = 0; i < nodes.count; ++i) {
    const std::int64_t piece = pieces[static_cast<std::size_t>(i)];
    if (piece < 0) continue;
    if (nodes.owned(i))
      own.push_back(static_cast<std::int32_t>(i));
    else
      of_ghosts[nodes.id(i)] = piece;
  }
  std::set<SamePiece> same;
  if (!level.distributed()) return same;
  for (const NamedNode& node :
       level.ghosts.tell<NamedNode>(*level.comm, nodes, own, [&](std::int32_t i) {
         return std::vector<NamedNode>{{nodes.id(i), pieces[static_cast<std::size_t>(i)]}};
       }))
    if (const auto found = of_ghosts.find(node.id); found != of_ghosts.end())
      same.insert({found->second, node.piece});
  return same;
}

// Joins the pieces of all ranks. Returns the smallest id of the whole piece for each name that a
// rank uses. Collective.
std::map<std::int64_t, std::int64_t> least_of_all(const Communicator& comm,
                                                  const std::set<SamePiece>& own) {
  std::map<std::int64_t, std::size_t> places;
  const std::vector<SamePiece> all =
      of_all_ranks(comm, std::vector<SamePiece>(own.begin(), own.end()));
  for (const SamePiece& pair : all) {
    places.try_emplace(pair.here);
    places.try_emplace(pair.there);
  }
  std::vector<std::int64_t> names;
  for (auto& [name, place] : places) {
    place = names.size();
    names.push_back(name);
  }
  UnionFind<std::size_t> joined(places.size());
  for (const SamePiece& pair : all) joined.join(places[pair.here], places[pair.there]);
  std::map<std::size_t, std::int64_t> least;
  for (std::size_t k = 0; k < names.size(); ++k) least.try_emplace(joined.root(k), names[k]);
  std::map<std::int64_t, std::int64_t> result;
  for (std::size_t k = 0; k < names.size(); ++k) result[names[k]] = least[joined.root(k)];
  return result;
}

}  // namespace

BoundaryPieces boundary_pieces(const Level<3>& level) {
  BoundaryPieces result;
  collective_try(*level.comm, [&] { result.of = pieces_here(level); });
  std::set<SamePiece> own = same_pieces(level, result.of);
  for (const std::int64_t piece : std::set<std::int64_t>(result.of.begin(), result.of.end()))
    if (piece >= 0) own.insert({piece, piece});
  const std::map<std::int64_t, std::int64_t> least = least_of_all(*level.comm, own);
  std::map<std::int64_t, std::int64_t> mine;
  for (std::size_t i = 0; i < result.of.size(); ++i) {
    std::int64_t& piece = result.of[i];
    if (piece < 0) continue;
    piece = least.at(piece);
    mine[piece] += level.nodes.owned(static_cast<std::int64_t>(i)) != 0;
  }
  std::vector<NodesOfPiece> counts;
  for (const auto& [piece, nodes] : mine) counts.push_back({piece, nodes});
  for (const NodesOfPiece& some : of_all_ranks(*level.comm, counts))
    result.nodes[some.piece] += some.nodes;
  return result;
}

std::int64_t pieces_of_boundary(const Level<3>& level) {
  return std::ssize(boundary_pieces(level).nodes);
}

std::int64_t pieces_of_surfaces(const Level<3>& level) {
  const BoundaryMesh<3>& mesh = level.geometry.boundary();
  const Features& features = level.geometry.domain().features();
  UnionFind<std::size_t> joined(mesh.nodes.size());
  std::set<std::size_t> corners, pieces;
  for (std::size_t f = 0; f < mesh.facets.size(); ++f) {
    if (features.patch[f] < 0 || !mesh.facets[f].bounds()) continue;
    const auto first = static_cast<std::size_t>(mesh.facets[f].nodes[0]);
    for (const std::int32_t v : mesh.facets[f].nodes)
      joined.join(first, static_cast<std::size_t>(v));
    corners.insert(first);
  }
  for (const std::size_t v : corners) pieces.insert(joined.root(v));
  return std::ssize(pieces);
}

}  // namespace pnpbs
