// SPDX-License-Identifier: BSD-3-Clause
// Runs one case on all groups of MPI_COMM_WORLD and compares their results with the reference.

#include "groups.hpp"

#include <algorithm>

#include "number_text.hpp"
#include "result_hashes.hpp"
#include "watchdog.hpp"

namespace hunt {

namespace {

Configuration random_configuration(Random& random, int ranks) {
  Configuration made;
  made.ranks = ranks;
  made.interval = random.chance(0.3) ? 0 : random.pick(1, 8);
  made.metis_seed = random.pick(1, 20);
  made.rebalances = random.chance(0.25);
  made.serial = ranks == 1 && random.chance(0.5);
  return made;
}

void send_text(const std::string& text) {
  MPI_Send(text.data(), static_cast<int>(text.size()), MPI_CHAR, 0, 1, MPI_COMM_WORLD);
}

std::string received_text(int from) {
  MPI_Status status;
  int size = 0;
  MPI_Probe(from, 1, MPI_COMM_WORLD, &status);
  MPI_Get_count(&status, MPI_CHAR, &size);
  std::string text(static_cast<std::size_t>(size), 0);
  MPI_Recv(text.data(), size, MPI_CHAR, from, 1, MPI_COMM_WORLD, MPI_STATUS_IGNORE);
  return text;
}

Verdict verdict_of(const Results& reference) {
  Verdict verdict = Verdict::skipped;
  for (const auto& [name, value] : reference) {
    if (name == "hash") verdict = Verdict::same;
    if ((name == "check" || name == "second check") && value[0] == '-')
      verdict = Verdict::failed_check;
  }
  return verdict;
}

std::string message_in(const Results& results) {
  for (const auto& [name, value] : results)
    if (name == kMessage) return value;
  return "";
}

}  // namespace

std::vector<Configuration> random_groups(Random& random, int ranks) {
  std::vector<Configuration> groups;
  for (int left = ranks; left > 0;) {
    int size = random.pick(1, std::min(left, 8));
    // A group of one rank tests only threads and serial contexts, so such groups are rarer.
    if (size == 1 && left > 1 && random.chance(0.7)) size = 2;
    groups.push_back(random_configuration(random, size));
    left -= size;
  }
  return groups;
}

Comparison compare(const Case& job, const std::vector<Configuration>& groups,
                   const Settings& extra) {
  int rank = 0;
  MPI_Comm_rank(MPI_COMM_WORLD, &rank);
  int group = rank == 0 ? 0 : -1, end = 1;
  std::vector<int> first{0};
  for (const Configuration& other : groups) {
    first.push_back(end);
    if (rank >= end && rank < end + other.ranks) group = static_cast<int>(first.size()) - 1;
    end += other.ranks;
  }
  MPI_Comm ranks;
  MPI_Comm_split(MPI_COMM_WORLD, group < 0 ? MPI_UNDEFINED : group, rank, &ranks);
  Configuration reference;
  reference.serial = !groups.empty() && groups[0].metis_seed % 2 == 0;
  Results results;
  if (group >= 0) {
    const Configuration& mine =
        group == 0 ? reference : groups[static_cast<std::size_t>(group - 1)];
    watch("", arguments_of(mine, nullptr));
    results = run_case(job, mine, group == 0 ? Settings{} : extra, ranks);
    watch("", "waits for the other ranks");
    MPI_Comm_free(&ranks);
  }
  Comparison made;
  if (group > 0 && first[static_cast<std::size_t>(group)] == rank) send_text(packed(results));
  if (rank == 0) {
    made.verdict = verdict_of(results);
    made.hash = hexadecimal(hash_of(packed(results)));
    for (const auto& [name, value] : results) {
      if (name == "nodes") made.nodes = value;
      if (name == "run") made.not_conforming = value == std::to_string(PNPBS_NOT_CONFORMING);
      if (name == "unresolved_places") made.held_down = value != "0";
    }
    for (std::size_t g = 0; g < groups.size(); ++g) {
      const std::string text = difference(results, unpacked(received_text(first[g + 1])));
      if (text.empty() || made.verdict == Verdict::differs) continue;
      made.verdict = Verdict::differs;
      made.group = g;
      made.first_rank = first[g + 1];
      made.difference = text;
    }
    if (made.verdict == Verdict::skipped && !results.empty())
      made.difference = results.back().first + ": " + results.back().second;
    if (made.verdict == Verdict::failed_check) made.difference = message_in(results);
  }
  int told[3] = {static_cast<int>(made.verdict), static_cast<int>(made.group), made.first_rank};
  MPI_Bcast(told, 3, MPI_INT, 0, MPI_COMM_WORLD);
  made.verdict = static_cast<Verdict>(told[0]);
  made.group = static_cast<std::size_t>(told[1]);
  made.first_rank = told[2];
  return made;
}

std::string arguments_of(const Configuration& configuration, const int* threads) {
  std::string text = "--ranks " + std::to_string(configuration.ranks);
  if (configuration.interval > 0) text += " --interval " + std::to_string(configuration.interval);
  if (configuration.metis_seed != 1)
    text += " --metis-seed " + std::to_string(configuration.metis_seed);
  if (configuration.rebalances) text += " --rebalance";
  if (configuration.serial) text += " --serial";
  if (!threads || std::all_of(threads, threads + configuration.ranks, [](int t) { return t == 1; }))
    return text;
  for (int r = 0; r < configuration.ranks; ++r)
    text += (r ? "," : " --threads ") + std::to_string(threads[r]);
  return text;
}

}  // namespace hunt
