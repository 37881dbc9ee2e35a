// SPDX-License-Identifier: BSD-3-Clause
// TetGen's Delaunay triangulation of space. Option: --switches "QNF" (the default: tetrahedra, nothing else).
#include "rival.hpp"

#define TETLIBRARY
#include <tetgen.h>

#include <memory>
#include <stdexcept>
#include <string>

namespace {

class TetGen {
 public:
  TetGen(const rival::Arguments& arguments, delone::PointTable&& table)
      : coordinates_(std::move(table.coordinates)), switches_(arguments.option("switches", "QNF")) {
    if (table.dimension != 3) throw std::invalid_argument("this program is for points of space");
  }

  rival::Program program() const { return {"TetGen", "1.5.0", switches_}; }

  void construct() {
    tetgenio in;
    in.pointlist = coordinates_.data();
    in.numberofpoints = static_cast<int>(coordinates_.size() / 3);
    out_ = std::make_unique<tetgenio>();
    std::string switches = switches_;
    try {
      tetrahedralize(switches.data(), &in, out_.get());
    } catch (int code) {
      in.pointlist = nullptr;
      throw std::runtime_error("TetGen gives up, code " + std::to_string(code));
    }
    in.pointlist = nullptr;  // not its own
  }

  void reset() { out_.reset(); }

  std::size_t num_cells() const { return static_cast<std::size_t>(out_->numberoftetrahedra); }

  rival::Cells cells() const { return {4, {out_->tetrahedronlist, out_->tetrahedronlist + 4 * num_cells()}}; }

  nlohmann::json details() const { return nlohmann::json::object(); }

 private:
  std::vector<double> coordinates_;
  std::string switches_;
  std::unique_ptr<tetgenio> out_;
};

}  // namespace

int main(int argc, char** argv) { return rival::run<TetGen>(argc, argv); }
