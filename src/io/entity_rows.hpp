// SPDX-License-Identifier: BSD-3-Clause
// Values of the cells, edges and vertices of a grid on a sphere, in the order of their numbers over
// all ranks: a window at a time, so that writing takes hardly any memory beside the grid itself.
#pragma once

#include <algorithm>
#include <cstdint>
#include <cstring>
#include <functional>
#include <span>
#include <vector>

#include "base/execution.hpp"
#include "base/leading_count.hpp"
#include "cgrid/sphere_grid.hpp"
#include "comm/records.hpp"
#include "io/rows.hpp"

namespace pnpbs::io {

enum class Entity { cell, edge, vertex };

// One of them, by the node that leads it: the edge to the neighbour at a place of the node's ring,
// the vertex between that neighbour and the next one. Of a cell the place does not count.
struct EntityPlace {
  std::int32_t node;
  std::int64_t place;
};

// Sets so many values of an entity, which are 0 before.
template <class Value>
using RowFill = std::function<void(const EntityPlace&, std::span<Value> row)>;

class EntityRows {
 public:
  explicit EntityRows(const SphereGrid& grid);

  // Calls visit(values of the rows that are this rank's part of a window, by number) for each
  // window; the parts are in the order of the ranks. Collective.
  template <class Value, class Visit>
  void for_windows(Entity of, int columns, const RowFill<Value>& fill, const Communicator& comm,
                   const Visit& visit) const;

 private:
  std::int64_t number(Entity of, const EntityPlace& at) const;
  // Those led by own nodes whose cells have numbers from begin up to end, by number.
  std::vector<EntityPlace> led(Entity of, std::int64_t begin, std::int64_t end) const;
  template <class Value>
  std::vector<Value> brought(Entity of, int columns, const std::vector<EntityPlace>& places,
                             const std::vector<Value>& rows, const Communicator& comm) const;

  const SphereGrid& grid_;
  std::vector<std::int32_t> leaders_;  // own nodes with a cell, by number
};

template <class Value, class Visit>
void EntityRows::for_windows(Entity of, int columns, const RowFill<Value>& fill,
                             const Communicator& comm, const Visit& visit) const {
  const std::int64_t window = kWindow * comm.size();
  const auto n = static_cast<std::size_t>(columns);
  for (std::int64_t begin = 0; begin < grid_.cells; begin += window) {
    const std::vector<EntityPlace> places = led(of, begin, begin + window);
    std::vector<Value> rows(n * places.size(), 0);
    for_each("pnpbs::EntityRows", std::ssize(places), [&](std::int64_t i) {
      const auto row = static_cast<std::size_t>(i);
      fill(places[row], std::span(rows).subspan(n * row, n));
    });
    if (comm.size() > 1) rows = brought(of, columns, places, rows, comm);
    visit(std::move(rows));
  }
}

// To the rank that has the cell of their leader in its part of the window.
template <class Value>
std::vector<Value> EntityRows::brought(Entity of, int columns,
                                       const std::vector<EntityPlace>& places,
                                       const std::vector<Value>& rows,
                                       const Communicator& comm) const {
  const auto n = static_cast<std::size_t>(columns);
  Outbox outgoing;
  for (std::size_t i = 0; i < places.size(); ++i) {
    const std::int64_t leader = grid_.cell[static_cast<std::size_t>(places[i].node)];
    Bytes& bytes = outgoing.to(static_cast<int>(leader / kWindow % comm.size()));
    pack(bytes, number(of, places[i]));
    for (std::size_t k = 0; k < n; ++k) pack(bytes, rows[n * i + k]);
  }
  struct Arrived {
    std::int64_t number;
    const char* row;
  };
  const std::vector<Message> messages = comm.sparse_all_to_all(outgoing.messages());
  const std::size_t size = n * sizeof(Value), step = sizeof(std::int64_t) + size;
  std::vector<Arrived> arrived;
  for (const Message& message : messages)
    for (std::size_t at = 0; at < message.bytes.size(); at += step) {
      const char* const bytes = reinterpret_cast<const char*>(message.bytes.data()) + at;
      arrived.push_back({0, bytes + sizeof(std::int64_t)});
      std::memcpy(&arrived.back().number, bytes, sizeof(std::int64_t));
    }
  std::ranges::sort(arrived, {}, &Arrived::number);
  std::vector<Value> sorted(n * arrived.size());
  for (std::size_t i = 0; i < arrived.size(); ++i)
    std::memcpy(&sorted[n * i], arrived[i].row, size);
  return sorted;
}

}  // namespace pnpbs::io
