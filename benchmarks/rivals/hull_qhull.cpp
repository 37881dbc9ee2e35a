// SPDX-License-Identifier: BSD-3-Clause
// Qhull's convex hull, through its reentrant library. Option: --options "Qx" or others ("" is the default:
// facets that rounding leaves undecided are merged). Qhull decides in floating point; `facets` counts merged
// ones once, and only simplices can be written.
#include "rival.hpp"

#define qh_dllimport
extern "C" {
#include <libqhull_r/qhull_ra.h>
}

#include <cstdio>
#include <memory>
#include <stdexcept>
#include <string>
#include <vector>

namespace {

class Qhull {
 public:
  Qhull(const rival::Arguments& arguments, delone::PointTable&& table)
      : table_(std::move(table)), options_(arguments.option("options", "")) {}
  ~Qhull() { reset(); }
  Qhull(const Qhull&) = delete;
  Qhull& operator=(const Qhull&) = delete;

  rival::Program program() const { return {"Qhull", qh_version2, options_}; }

  void construct() {
    messages_.reset(std::tmpfile());
    if (!messages_) throw std::runtime_error("no temporary file for the messages of Qhull");
    qh_zero(&qh_, messages_.get());
    std::string command = "qhull " + options_;
    const int status =
        qh_new_qhull(&qh_, table_.dimension, static_cast<int>(table_.num_points()), table_.coordinates.data(),
                     False, command.data(), nullptr, messages_.get());
    alive_ = true;
    if (status != 0) throw std::runtime_error("Qhull gave up with status " + std::to_string(status));
  }

  void reset() {
    if (!alive_) return;
    qh_freeqhull(&qh_, !qh_ALL);
    int unfreed = 0, unfreed_memory = 0;
    qh_memfreeshort(&qh_, &unfreed, &unfreed_memory);
    alive_ = false;
  }

  std::size_t num_cells() const { return static_cast<std::size_t>(qh_.num_facets); }

  rival::Cells cells() const {
    rival::Cells cells{table_.dimension, {}};
    qhT* qh = const_cast<qhT*>(&qh_);  // Qhull's functions take no pointer to const
    for (const facetT* facet = qh_.facet_list; facet && facet->next; facet = facet->next) {
      if (qh_setsize(qh, facet->vertices) != table_.dimension)
        throw std::runtime_error("a facet is no simplex");
      vertexT *vertex, **vertexp;
      FOREACHvertex_(facet->vertices) cells.rows.push_back(qh_pointid(qh, vertex->point));
    }
    return cells;
  }

  nlohmann::json details() const {
    std::size_t other = 0;
    for (const facetT* facet = qh_.facet_list; facet && facet->next; facet = facet->next)
      other += !facet->simplicial;
    return {{"facets", qh_.num_facets}, {"vertices", qh_.num_vertices}, {"non_simplicial_facets", other}};
  }

 private:
  struct Close {
    void operator()(std::FILE* file) const { std::fclose(file); }
  };

  delone::PointTable table_;
  std::string options_;
  std::unique_ptr<std::FILE, Close> messages_;
  qhT qh_{};
  bool alive_ = false;
};

}  // namespace

int main(int argc, char** argv) { return rival::run<Qhull>(argc, argv); }
