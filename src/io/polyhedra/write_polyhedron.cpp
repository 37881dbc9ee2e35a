// SPDX-License-Identifier: BSD-3-Clause
#include "io/atomic_file.hpp"
#include "io/file.hpp"

#include <delone/polyhedron_io.hpp>

#include <string>

namespace delone {
namespace {

bool is_integer(const RationalRows& rows) {
  for (const Rational& x : rows.entries())
    if (!x.is_integer()) return false;
  return true;
}

class RepresentationWriter {
 public:
  explicit RepresentationWriter(io::AtomicFile& file) : file_(file) {}

  void write_inequalities(const Polyhedron& polyhedron) {
    const RationalRows equations = polyhedron.equations(), inequalities = polyhedron.inequalities();
    begin("H", equations.size(), equations.size() + inequalities.size(), polyhedron.dimension(), true);
    for (const RationalRows* rows : {&equations, &inequalities})
      for (std::size_t i = 0; i < rows->size(); ++i) {
        const std::span<const Rational> row = (*rows)[i];
        file_.write(row.back().to_string());
        for (std::size_t c = 0; c + 1 < row.size(); ++c) put(Rational(row[c], -1));
        file_.put('\n');
      }
    file_.write("end\n");
  }
  void write_generators(const Polyhedron& polyhedron) {
    const RationalRows lines = polyhedron.lines(), vertices = polyhedron.vertices(), rays = polyhedron.rays();
    begin("V", lines.size(), lines.size() + vertices.size() + rays.size(), polyhedron.dimension(),
          is_integer(vertices));
    for (const RationalRows* rows : {&lines, &vertices, &rays})
      for (std::size_t i = 0; i < rows->size(); ++i) {
        file_.put(rows == &vertices ? '1' : '0');
        for (const Rational& x : (*rows)[i]) put(x);
        file_.put('\n');
      }
    file_.write("end\n");
  }

 private:
  /// Rows of linearity are the first ones.
  void begin(const char* letter, std::size_t linear, std::size_t size, int dimension, bool has_integers) {
    file_.print("{}-representation\n", letter);
    if (linear > 0) {
      file_.print("linearity {}", linear);
      for (std::size_t i = 1; i <= linear; ++i) file_.print(" {}", i);
      file_.put('\n');
    }
    file_.print("begin\n{} {} {}\n", size, dimension + 1, has_integers ? "integer" : "rational");
  }
  void put(const Rational& x) {
    file_.put(' ');
    file_.write(x.to_string());
  }

  io::AtomicFile& file_;
};

}  // namespace

void write_polyhedron(const std::string& path, const Polyhedron& polyhedron, const std::string& format) {
  const std::string name = io::output_name(path);
  const std::string chosen =
      io::choose_format(path, format, "ine", {"ine", "ext"}, io::Use::writing, "a polyhedron");
  io::guarded(name, [&] {
    io::AtomicFile file(path);
    RepresentationWriter writer(file);
    chosen == "ine" ? writer.write_inequalities(polyhedron) : writer.write_generators(polyhedron);
    file.commit();
  });
}

}  // namespace delone
