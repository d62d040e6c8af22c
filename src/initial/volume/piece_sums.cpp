// SPDX-License-Identifier: BSD-3-Clause
#include "initial/volume/piece_sums.hpp"

#include <algorithm>
#include <map>
#include <tuple>

#include "comm/records.hpp"

namespace pnpbs {

namespace {

struct Question {
  PiecesInCell pieces;
  int rank;
};

// The answers, in the order of the questions.
std::vector<PatchSums> answers_to(const std::vector<Question>& questions) {
  std::vector<std::size_t> order;
  for (std::size_t k = 0; k < questions.size(); ++k) order.push_back(k);
  std::sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
    const PiecesInCell &x = questions[a].pieces, &y = questions[b].pieces;
    return std::tie(x.patch, x.cell) < std::tie(y.patch, y.cell);
  });
  std::map<std::int32_t, PatchSums> whole;
  std::vector<PatchSums> answers(questions.size());
  for (const std::size_t k : order) {
    const PiecesInCell& pieces = questions[k].pieces;
    PatchSums& patch = whole[pieces.patch];
    answers[k].nodes_before = patch.nodes;
    patch.nodes.add(pieces.nodes);
    patch.min_d = std::min(patch.min_d, pieces.min_d);
    patch.max_d = std::max(patch.max_d, pieces.max_d);
  }
  for (std::size_t k = 0; k < questions.size(); ++k) {
    const PatchSums& patch = whole[questions[k].pieces.patch];
    answers[k] = {answers[k].nodes_before, patch.nodes, patch.min_d, patch.max_d};
  }
  return answers;
}

}  // namespace

std::vector<PatchSums> sums_over_patches(const Communicator& comm, std::int32_t patches,
                                         const std::vector<PiecesInCell>& own) {
  const auto asked = [&](std::int32_t patch) {
    return static_cast<int>(std::int64_t{patch} * comm.size() / patches);
  };
  Outbox outgoing, answered;
  for (const PiecesInCell& pieces : own) pack(outgoing.to(asked(pieces.patch)), pieces);
  std::vector<Question> questions;
  for (const Message& theirs : comm.sparse_all_to_all(outgoing.messages()))
    for_records<PiecesInCell>({theirs.bytes}, [&](const PiecesInCell& pieces) {
      questions.push_back({pieces, theirs.rank});
    });
  const std::vector<PatchSums> answers = answers_to(questions);
  for (std::size_t k = 0; k < questions.size(); ++k)
    pack(answered.to(questions[k].rank), answers[k]);
  // By rank, so in the order of the patches.
  std::vector<PatchSums> sums;
  sums.reserve(own.size());
  for (const Message& theirs : comm.sparse_all_to_all(answered.messages()))
    for_records<PatchSums>({theirs.bytes}, [&](const PatchSums& sum) { sums.push_back(sum); });
  return sums;
}

}  // namespace pnpbs
