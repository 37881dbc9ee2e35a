// SPDX-License-Identifier: BSD-3-Clause
// Qhull's Delaunay triangulation, through its reentrant library. Option: --options "d Qbb Qc Q12 Qz" (the
// default; "Qt" added makes every cell a simplex). Qhull decides in floating point and merges what it cannot
// decide; cells that are not simplices are counted once, and cannot be written.
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
      : table_(std::move(table)), options_(arguments.option("options", "d Qbb Qc Q12 Qz")) {}
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
    if (status != 0) throw std::runtime_error(first_message());
  }

  void reset() {
    if (!alive_) return;
    qh_freeqhull(&qh_, !qh_ALL);
    int unfreed = 0, unfreed_memory = 0;
    qh_memfreeshort(&qh_, &unfreed, &unfreed_memory);
    alive_ = false;
  }

  std::size_t num_cells() const {
    std::size_t count = 0;
    for (const facetT* facet = qh_.facet_list; facet && facet->next; facet = facet->next)
      count += !facet->upperdelaunay;
    return count;
  }

  rival::Cells cells() const {
    const auto size = static_cast<int>(table_.dimension) + 1;
    rival::Cells cells{size, {}};
    qhT* qh = const_cast<qhT*>(&qh_);  // Qhull's functions take no pointer to const
    for (const facetT* facet = qh_.facet_list; facet && facet->next; facet = facet->next) {
      if (facet->upperdelaunay) continue;
      if (qh_setsize(qh, facet->vertices) != size)
        throw std::runtime_error("a cell is no simplex; use --options with Qt");
      vertexT *vertex, **vertexp;
      FOREACHvertex_(facet->vertices) cells.rows.push_back(qh_pointid(qh, vertex->point));
    }
    return cells;
  }

  nlohmann::json details() const {
    std::size_t other = 0;
    for (const facetT* facet = qh_.facet_list; facet && facet->next; facet = facet->next)
      other += !facet->upperdelaunay && !facet->simplicial;
    return {{"non_simplicial_cells", other}};
  }

 private:
  struct Close {
    void operator()(std::FILE* file) const { std::fclose(file); }
  };

  /// The first line of Qhull's message, "QH6154 …".
  std::string first_message() {
    std::rewind(messages_.get());
    std::vector<char> line(400, '\0');
    while (std::fgets(line.data(), static_cast<int>(line.size()), messages_.get())) {
      std::string text(line.data());
      if (text.find_first_not_of(" \n") == std::string::npos) continue;
      while (!text.empty() && text.back() == '\n') text.pop_back();
      return text;
    }
    return "Qhull gave up without a message";
  }

  delone::PointTable table_;
  std::string options_;
  std::unique_ptr<std::FILE, Close> messages_;
  qhT qh_{};
  bool alive_ = false;
};

}  // namespace

int main(int argc, char** argv) { return rival::run<Qhull>(argc, argv); }
