// SPDX-License-Identifier: BSD-3-Clause
// Shewchuk's Triangle, divide and conquer, from its source. Option: --switches "zQNB" (the default:
// triangles, nothing else).
#include "rival.hpp"

extern "C" {
#define REAL double
#define VOID void
#define ANSI_DECLARATORS
#include <triangle.h>
}

#include <cstdlib>
#include <stdexcept>
#include <string>

namespace {

class Triangle {
 public:
  Triangle(const rival::Arguments& arguments, delone::PointTable&& table)
      : table_(std::move(table)), switches_(arguments.option("switches", "zQNB")) {
    if (table_.dimension != 2) throw std::invalid_argument("this program is for points of the plane");
  }
  ~Triangle() { reset(); }
  Triangle(const Triangle&) = delete;
  Triangle& operator=(const Triangle&) = delete;

  rival::Program program() const { return {"Triangle", "1.6", switches_ + ", " + DELONE_BENCHMARK_FLAGS}; }

  void construct() {
    triangulateio in{};
    in.pointlist = table_.coordinates.data();
    in.numberofpoints = static_cast<int>(table_.num_points());
    std::string switches = switches_;
    triangulate(switches.data(), &in, &out_, nullptr);
  }

  void reset() {
    std::free(out_.trianglelist);
    out_ = {};
  }

  std::size_t num_cells() const { return static_cast<std::size_t>(out_.numberoftriangles); }

  rival::Cells cells() const { return {3, {out_.trianglelist, out_.trianglelist + 3 * num_cells()}}; }

  nlohmann::json details() const { return nlohmann::json::object(); }

 private:
  delone::PointTable table_;
  std::string switches_;
  triangulateio out_{};
};

}  // namespace

int main(int argc, char** argv) { return rival::run<Triangle>(argc, argv); }
