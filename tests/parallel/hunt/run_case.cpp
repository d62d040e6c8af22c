// SPDX-License-Identifier: BSD-3-Clause
// Runs a case: creates the placement with the options of the case and its configuration, makes the
// calls, and collects the results after each.

#include "run_case.hpp"

#include <pnpbs/pnpbs_mpi.h>

namespace hunt {

namespace {

class Run {
 public:
  Run(const Case& job, const Configuration& configuration, const Settings& extra, MPI_Comm ranks)
      : job_(job), configuration_(configuration), extra_(extra), ranks_(ranks) {}
  Run(const Run&) = delete;
  Run& operator=(const Run&) = delete;
  ~Run() {
    pnpbs_placement_destroy(&placement_);
    pnpbs_domain_destroy(&domain_);
    pnpbs_context_destroy(&context_);
  }

  Results results() && {
    if (prepare() && begin_by_steps() && run_once("") && job_.adapts && ask_for_second())
      run_once("second ");
    return std::move(results_);
  }

 private:
  bool went_well(pnpbs_status status, const char* name) {
    return add_status(status, context_, ranks_, name, results_) && status >= 0;
  }

  bool prepare() {
    const pnpbs_status status = configuration_.serial ? pnpbs_context_create_serial(&context_)
                                                      : pnpbs_context_create_mpi(ranks_, &context_);
    return went_well(status, "context") &&
           went_well(pnpbs_domain_create(context_, job_.body.dim, &domain_), "domain") &&
           went_well(add(job_.body, domain_), "body") &&
           went_well(pnpbs_placement_create(context_, domain_, &placement_), "placement") &&
           set_options() && went_well(set(placement_, job_.spacing), "spacing");
  }

  bool set_options() {
    Settings all = job_.options;
    all.emplace_back("max_nodes", "4000");  // a limit, as cases are small
    all.emplace_back("metis_seed", std::to_string(configuration_.metis_seed));
    if (configuration_.interval > 0)
      all.emplace_back("exchange_interval", std::to_string(configuration_.interval));
    if (job_.wanted_nodes > 0)
      all.emplace_back("wanted_nodes", std::to_string(static_cast<int>(job_.wanted_nodes)));
    all.insert(all.end(), extra_.begin(), extra_.end());
    pnpbs_status status = PNPBS_OK;
    for (const auto& [key, value] : all)
      if (status >= 0) status = pnpbs_placement_set(placement_, key.c_str(), value.c_str());
    return went_well(status, "options");
  }

  // An error here also occurs in the next call, which the reference makes as well. So the status is
  // not compared.
  void rebalance() {
    if (configuration_.rebalances) pnpbs_placement_rebalance(placement_);
  }

  bool begin_by_steps() {
    if (!job_.by_steps) return true;
    std::int64_t inserted = 0, deleted = 0;
    if (!went_well(pnpbs_placement_initialise(placement_), "initialise")) return false;
    rebalance();
    if (!went_well(pnpbs_placement_step(placement_, job_.steps), "step") ||
        !went_well(pnpbs_placement_adjust_population(placement_, &inserted, &deleted), "adjust"))
      return false;
    results_.emplace_back("adjusted", std::to_string(inserted) + " " + std::to_string(deleted));
    rebalance();
    return went_well(pnpbs_placement_step(placement_, job_.steps), "step again");
  }

  bool run_once(const std::string& prefix) {
    rebalance();
    return went_well(pnpbs_placement_run(placement_), (prefix + "run").c_str()) &&
           add_results(placement_, context_, ranks_, prefix, results_);
  }

  bool ask_for_second() {
    if (!job_.at_nodes) return went_well(set(placement_, job_.second), "second spacing");
    std::int64_t n = 0;
    if (pnpbs_placement_count(placement_, &n) < 0) return false;
    std::vector<double> at(static_cast<std::size_t>(n * job_.body.dim + 1)),
        d(static_cast<std::size_t>(n + 1));
    if (pnpbs_placement_get_nodes(placement_, n, at.data(), nullptr, nullptr, d.data()) < 0)
      return false;
    const double scale = job_.body.frame.scale;
    for (std::int64_t i = 0; i < n; ++i) {
      Point x{};
      for (int k = 0; k < job_.body.dim; ++k) x[k] = at[i * job_.body.dim + k];
      const double factor = job_.second.at(x) / scale;
      d[i] *= factor < 0.7 ? 0.7 : (factor > 1.5 ? 1.5 : factor);
    }
    return went_well(pnpbs_placement_set_spacing_at_nodes(placement_, n, d.data()),
                     "second spacing at nodes");
  }

  const Case& job_;
  const Configuration& configuration_;
  const Settings& extra_;
  MPI_Comm ranks_;
  pnpbs_context context_ = nullptr;
  pnpbs_domain domain_ = nullptr;
  pnpbs_placement placement_ = nullptr;
  Results results_;
};

}  // namespace

Results run_case(const Case& job, const Configuration& configuration, const Settings& extra,
                 MPI_Comm ranks) {
  return Run(job, configuration, extra, ranks).results();
}

}  // namespace hunt
