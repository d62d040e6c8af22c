// SPDX-License-Identifier: BSD-3-Clause
//
// Hunts for results that depend on ranks, threads, exchange intervals or partitions: random cases,
// each run on one rank of one thread and on other groups of the ranks of MPI_COMM_WORLD at the same
// time. See docs/building.md.
#include <mpi.h>
#include <pnpbs/pnpbs_mpi.h>

#include <cstdio>
#include <ctime>
#include <fstream>

#include "arguments.hpp"
#include "shrink.hpp"
#include "watchdog.hpp"

namespace hunt {

namespace {

class Hunt {
 public:
  Hunt(const Arguments& arguments) : arguments_(arguments) {
    MPI_Comm_rank(MPI_COMM_WORLD, &rank_);
    MPI_Comm_size(MPI_COMM_WORLD, &size_);
    set_threads();
  }

  void run_all() {
    for (std::uint64_t number = arguments_.first; number < arguments_.last; ++number) {
      if (number > arguments_.first && time_is_over()) break;
      CaseSpec spec = arguments_.spec;
      spec.number = number;
      run(spec, arguments_.group, arguments_.extra);
    }
    if (!arguments_.kept.empty()) run_kept();
  }

  /** The exit status. */
  int end() const {
    const bool well =
        arguments_.expects_differences ? differ_ > 0 : differ_ == 0 && failed_checks_ == 0;
    if (rank_ == 0)
      std::printf(
          "%llu cases: %llu refused on all ranks, %llu fail the check of results, %llu "
          "differ; %llu hold d down, %llu do not conform\n",
          counted_, skipped_, failed_checks_, differ_, held_down_, not_conforming_);
    return well ? 0 : 1;
  }

 private:
  /** The same on all ranks. */
  bool time_is_over() const {
    int over = arguments_.seconds > 0 && MPI_Wtime() - begin_ > arguments_.seconds;
    MPI_Bcast(&over, 1, MPI_INT, 0, MPI_COMM_WORLD);
    return over != 0;
  }

  // The reference has one; the last two ranks of a large world two and three.
  void set_threads() {
    threads_.assign(static_cast<std::size_t>(size_), 1);
    if (arguments_.threads.empty() && size_ >= 6) {
      threads_[threads_.size() - 2] = 2;
      threads_[threads_.size() - 1] = 3;
    }
    for (std::size_t r = 0; r < arguments_.threads.size() && r + 1 < threads_.size(); ++r)
      threads_[r + 1] = arguments_.threads[r];
    pnpbs_context context = nullptr;
    pnpbs_context_create_serial(&context);
    if (pnpbs_context_set_int64(context, "threads", threads_[static_cast<std::size_t>(rank_)]) < 0)
      std::fprintf(stderr, "hunt: %s\n", pnpbs_last_error(context));
    pnpbs_context_destroy(&context);
  }

  void run(const CaseSpec& spec, const std::optional<Configuration>& group, const Settings& extra) {
    Random random(spec.seed, spec.number, "groups");
    std::vector<Configuration> groups;
    int left = size_ - 1;
    if (group && group->ranks <= left) {
      groups = {*group};
      left -= group->ranks;
    }
    const std::vector<Configuration> others = random_groups(random, left);
    groups.insert(groups.end(), others.begin(), others.end());
    const std::string name = std::to_string(spec.seed) + ":" + std::to_string(spec.number);
    watch(name, "");
    const std::clock_t begin = std::clock();
    const Case job = make_case(spec);
    const Comparison made = compare(job, groups, extra);
    ++counted_;
    skipped_ += made.verdict == Verdict::skipped;
    failed_checks_ += made.verdict == Verdict::failed_check;
    held_down_ += made.held_down;
    not_conforming_ += made.not_conforming;
    if (rank_ == 0 && arguments_.tells_all) {
      const char* words[] = {"same", "differs", "refused", "check fails"};
      std::printf("%s %s: %s%s%s, %s nodes, %.1f s %s\n", name.c_str(), job.name.c_str(),
                  words[static_cast<int>(made.verdict)], made.held_down ? ", d held down" : "",
                  made.not_conforming ? ", not conforming" : "", made.nodes.c_str(),
                  static_cast<double>(std::clock() - begin) / CLOCKS_PER_SEC,
                  made.verdict == Verdict::skipped ? made.difference.c_str() : "");
      std::fflush(stdout);
    }
    if (made.verdict == Verdict::differs) report(spec, job, groups[made.group], made, extra);
    if (made.verdict == Verdict::failed_check)
      tell("FAILS ITS CHECK", {spec, {}, made.difference}, job.name, nullptr, extra);
  }

  void report(const CaseSpec& spec, const Case& job, const Configuration& configuration,
              const Comparison& made, const Settings& extra) {
    ++differ_;
    tell("DIFFERS", {spec, configuration, made.difference}, job.name, &threads_[made.first_rank],
         extra);
    if (!arguments_.shrinks) return;
    Failure failure{spec, configuration, made.difference};
    if (shrink(failure, extra))
      tell("  shrunk", failure, job.name, &threads_[1], extra);
    else if (rank_ == 0)
      std::printf("  shrunk: not the same on other threads, or not every time\n");
  }

  void tell(const char* word, const Failure& failure, const std::string& name, const int* threads,
            const Settings& extra) const {
    if (rank_ != 0) return;
    std::string text =
        arguments_of(failure.spec) + " " + arguments_of(failure.configuration, threads);
    for (const auto& [key, value] : extra) text += " --set " + key + "=" + value;
    std::printf("%s: mpirun --oversubscribe --bind-to none -np %d hunt %s  # %s; %s\n", word,
                failure.configuration.ranks + 1, text.c_str(), name.c_str(),
                failure.difference.c_str());
    std::fflush(stdout);
  }

  void run_kept() {
    for (const std::vector<std::string>& words : lines_of(arguments_.kept)) {
      Arguments defaults;
      defaults.spec.data = arguments_.spec.data;
      Arguments line = parsed(words, defaults);
      if (!line.error.empty()) {
        if (rank_ == 0) std::printf("%s: %s\n", arguments_.kept.c_str(), line.error.c_str());
        ++differ_;
        continue;
      }
      line.spec.number = line.first;
      if (find_bodies(line.spec)) run(line.spec, line.group, line.extra);
    }
  }

  // The files of a kept case, which need not be there.
  bool find_bodies(CaseSpec& spec) const {
    for (std::string& file : spec.files) {
      if (!arguments_.bodies.empty()) file = arguments_.bodies + "/" + file;
      if (std::ifstream(file).good()) continue;
      if (rank_ == 0) std::printf("left out, as it is not here: %s\n", file.c_str());
      return false;
    }
    return true;
  }

  const Arguments& arguments_;
  const double begin_ = MPI_Wtime();
  int rank_ = 0, size_ = 1;
  Threads threads_;
  unsigned long long counted_ = 0, skipped_ = 0, failed_checks_ = 0, differ_ = 0;
  unsigned long long held_down_ = 0, not_conforming_ = 0;  // first runs, on rank 0
};

// The date may change between the ranks.
void agree_on_seed(Arguments& arguments) {
  MPI_Bcast(&arguments.spec.seed, 1, MPI_UINT64_T, 0, MPI_COMM_WORLD);
}

}  // namespace

}  // namespace hunt

int main(int argc, char** argv) {
  MPI_Init(&argc, &argv);
  hunt::Arguments arguments = hunt::parsed({argv + 1, argv + argc}, {});
  int rank = 0;
  MPI_Comm_rank(MPI_COMM_WORLD, &rank);
  if (!arguments.error.empty() || (arguments.last <= arguments.first && arguments.kept.empty())) {
    if (rank == 0) std::fprintf(stderr, "%s\n%s", arguments.error.c_str(), hunt::kUsage);
    MPI_Finalize();
    return 2;
  }
  hunt::agree_on_seed(arguments);
  if (rank == 0 && arguments.last > arguments.first)
    std::printf("hunt: seed %llu, cases %llu..%llu\n",
                static_cast<unsigned long long>(arguments.spec.seed),
                static_cast<unsigned long long>(arguments.first),
                static_cast<unsigned long long>(arguments.last));
  hunt::Hunt hunt(arguments);
  hunt.run_all();
  hunt::end_watch();
  const int status = hunt.end();
  MPI_Finalize();
  return status;
}
