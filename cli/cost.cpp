// SPDX-License-Identifier: BSD-3-Clause
#include "cost.hpp"

#include <sys/resource.h>
#include <nlohmann/json.hpp>

namespace delone::cli {

double seconds_since(Clock::time_point start) {
  return std::chrono::duration<double>(Clock::now() - start).count();
}

void Cost::close(Clock::time_point start) {
  total = seconds_since(start);
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
#ifdef __APPLE__
  peak_rss_bytes = static_cast<std::size_t>(usage.ru_maxrss);
#else
  peak_rss_bytes = static_cast<std::size_t>(usage.ru_maxrss) * 1024;
#endif
}

void add_cost(nlohmann::ordered_json& json, const Statistics& statistics, std::size_t num_cells,
              const Cost& cost, std::uint64_t seed) {
  const Statistics& s = statistics;
  json["seconds"] = {{"read", cost.read},
                     {"order", s.order_seconds},
                     {"build", cost.build - s.order_seconds},
                     {"write", cost.write},
                     {"total", cost.total}};
  json["peak_rss_bytes"] = cost.peak_rss_bytes;
  json["bytes_per_cell"] =
      num_cells == 0 ? 0.0 : static_cast<double>(s.cell_bytes) / static_cast<double>(num_cells);
  json["created_cells"] = s.created_cells;
  json["stages"] = {
      {"filter", s.filter}, {"direct", s.direct}, {"exact", s.exact}, {"perturbed", s.perturbed}};
  json["threads"] = threads_used;
  json["seed"] = seed;
  json["version"] = DELONE_VERSION;
}

InsertionOrder insertion_order(const std::string& name) {
  return name == "given"      ? InsertionOrder::as_given
         : name == "shuffled" ? InsertionOrder::shuffled
                              : InsertionOrder::automatic;
}

}  // namespace delone::cli
