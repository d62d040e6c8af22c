// SPDX-License-Identifier: BSD-3-Clause
//
// Searches for results that depend on ranks, threads, exchange intervals or partitions. Random
// cases run on one rank with one thread and, at the same time, on other groups of ranks of
// MPI_COMM_WORLD. See docs/building.md.
#include <mpi.h>
#include <pnpbs/pnpbs_mpi.h>

#include <cstdio>
#include <ctime>
#include <exception>
#include <filesystem>

#include "arguments.hpp"
#include "case_file.hpp"
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
      if (compared_ > 0 && time_is_over()) break;
      CaseSpec spec = arguments_.spec;
      spec.number = number;
      run(spec, arguments_.group, arguments_.extra);
    }
    if (!arguments_.kept.empty()) run_kept();
  }

  /** Prints the counts and returns the exit status, which is the same on all ranks. Collective. */
  int end() const {
    const bool well =
        arguments_.expects_differences ? differ_ > 0 : differ_ == 0 && failed_checks_ == 0;
    if (rank_ == 0)
      std::printf(
          "%llu cases: %llu compared, %llu refused on all ranks, %llu fail the check of results, "
          "%llu differ; %llu hold d down, %llu do not conform\n",
          counted_, compared_, skipped_, failed_checks_, differ_, held_down_, not_conforming_);
    const bool enough = compared_ >= required();
    if (rank_ == 0 && !enough)
      std::printf("hunt: too few cases were compared: %llu; required: %llu.\n", compared_,
                  required());
    int status = well && enough && errors_ == 0 ? 0 : 1;
    MPI_Allreduce(MPI_IN_PLACE, &status, 1, MPI_INT, MPI_MAX, MPI_COMM_WORLD);
    return status;
  }

 private:
  // The number of cases that must be compared is half of all cases. With a time limit there may be
  // few cases, half of which may be rejected by chance, so one is enough.
  unsigned long long required() const {
    return arguments_.seconds > 0 || counted_ == 0 ? 1 : (counted_ + 1) / 2;
  }

  /** Returns the same value on all ranks. */
  bool time_is_over() const {
    int over = arguments_.seconds > 0 && MPI_Wtime() - begin_ > arguments_.seconds;
    MPI_Bcast(&over, 1, MPI_INT, 0, MPI_COMM_WORLD);
    return over != 0;
  }

  // The reference has one thread; the last two ranks of a large world have two and three.
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
    if (pnpbs_context_set_int64(context, "threads", threads_[static_cast<std::size_t>(rank_)]) <
        0) {
      std::fprintf(stderr, "hunt: %s\n", pnpbs_last_error(context));
      ++errors_;
    }
    pnpbs_context_destroy(&context);
  }

  // Reports an error that has the same cause on all ranks.
  void report_error(const std::string& text) {
    if (rank_ == 0) std::printf("hunt: %s\n", text.c_str());
    ++errors_;
  }

  // Builds the case on every rank, and reports an error if a rank fails. Collective over the world.
  std::optional<Case> made_case(const CaseSpec& spec) {
    std::optional<Case> made;
    std::string why = "a rank cannot make the case " + label_of(spec) + ".";
    try {
      made = make_case(spec);
    } catch (const std::exception& error) {
      why = error.what();
    }
    int everywhere = made.has_value();
    MPI_Allreduce(MPI_IN_PLACE, &everywhere, 1, MPI_INT, MPI_MIN, MPI_COMM_WORLD);
    if (everywhere) return made;
    report_error(why);
    return std::nullopt;
  }

  // Runs the case and counts its verdict. Returns whether its results could be compared.
  bool run(const CaseSpec& spec, const std::optional<Configuration>& group, const Settings& extra) {
    const std::string name = label_of(spec);
    watch(name, "");
    const std::clock_t begin = std::clock();
    ++counted_;
    const std::optional<Case> job = made_case(spec);
    if (!job) return false;
    if (group && group->ranks >= size_) {
      report_error("the case " + name + " needs at least " + std::to_string(group->ranks + 1) +
                   " ranks.");
      return false;
    }
    Random random(job->seed, job->number, "groups");
    std::vector<Configuration> groups;
    if (group) groups = {*group};
    const std::vector<Configuration> others =
        random_groups(random, size_ - 1 - (group ? group->ranks : 0));
    groups.insert(groups.end(), others.begin(), others.end());
    const Comparison made = compare(*job, groups, extra);
    const bool is_compared = made.verdict != Verdict::skipped && !groups.empty();
    compared_ += is_compared;
    skipped_ += made.verdict == Verdict::skipped;
    failed_checks_ += made.verdict == Verdict::failed_check;
    held_down_ += made.held_down;
    not_conforming_ += made.not_conforming;
    if (rank_ == 0 && arguments_.tells_all) {
      const char* words[] = {"same", "differs", "refused", "check fails"};
      std::printf("%s %s: %s%s%s, %s nodes, results %s, %.1f s %s\n", name.c_str(),
                  job->name.c_str(), words[static_cast<int>(made.verdict)],
                  made.held_down ? ", d held down" : "",
                  made.not_conforming ? ", not conforming" : "", made.nodes.c_str(),
                  made.hash.c_str(), static_cast<double>(std::clock() - begin) / CLOCKS_PER_SEC,
                  made.verdict == Verdict::skipped ? made.difference.c_str() : "");
      std::fflush(stdout);
    }
    if (made.verdict == Verdict::differs) report(spec, *job, groups[made.group], made, extra);
    if (made.verdict == Verdict::failed_check)
      tell("FAILS ITS CHECK", {spec, {}, made.difference}, job->name, nullptr, extra);
    if (!arguments_.dump.empty()) dump(*job, name, made.hash, groups, extra);
    return is_compared;
  }

  // Writes the case and runs it from the file, which must give the same results. Collective over
  // the world.
  void dump(const Case& job, std::string name, const std::string& hash,
            const std::vector<Configuration>& groups, const Settings& extra) {
    for (char& c : name)
      if (c == ':') c = '-';
    CaseSpec spec;
    spec.replay = (std::filesystem::path(arguments_.dump) / (name + ".txt")).string();
    if (rank_ == 0) {
      try {
        write_case(job, spec.replay);
      } catch (const std::exception& error) {
        report_error(error.what());
      }
    }
    MPI_Barrier(MPI_COMM_WORLD);
    const std::optional<Case> written = made_case(spec);
    if (!written) return;
    const Comparison made = compare(*written, groups, extra);
    if (rank_ == 0 && made.hash != hash)
      report_error(spec.replay + ": the results are " + made.hash + " and not " + hash +
                   " as those of the case that was written.");
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
      if (line.error.empty() && line.last != line.first + 1) line.error = "a line is one case.";
      if (!line.error.empty()) {
        report_error(arguments_.kept + ": " + line.error);
        continue;
      }
      line.spec.number = line.first;
      const std::filesystem::path folder = std::filesystem::path(arguments_.kept).parent_path();
      for (std::string& file : line.spec.files) file = (folder / file).string();
      if (!line.spec.replay.empty()) line.spec.replay = (folder / line.spec.replay).string();
      if (!run(line.spec, line.group, line.extra))
        report_error("the kept case " + label_of(line.spec) + " could not be compared.");
    }
  }

  const Arguments& arguments_;
  const double begin_ = MPI_Wtime();
  int rank_ = 0, size_ = 1;
  Threads threads_;
  unsigned long long counted_ = 0, compared_ = 0, skipped_ = 0, failed_checks_ = 0, differ_ = 0;
  unsigned long long errors_ = 0;                          // in files, arguments and settings
  unsigned long long held_down_ = 0, not_conforming_ = 0;  // first runs, on rank 0
};

// Broadcasts the seed of rank 0. The default seed is the date, which may differ between ranks.
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
