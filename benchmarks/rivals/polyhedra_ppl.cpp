// SPDX-License-Identifier: BSD-3-Clause
// PPL's conversion of one polyhedron of rows of integers, in the form of cddlib and lrs:
//   polyhedra_ppl FILE.ine|FILE.ext
// Prints how many vertices, rays and lines, or inequalities and equations there are.
#include <ppl.hh>

#include <fstream>
#include <iostream>
#include <set>
#include <stdexcept>
#include <string>
#include <vector>

namespace ppl = Parma_Polyhedra_Library;

namespace {

struct Rows {
  bool is_generators = false;
  std::set<std::size_t> linearity;  // from 0
  std::vector<std::vector<ppl::Coefficient>> rows;
};

Rows read(const char* path) {
  std::ifstream file(path);
  Rows result;
  std::string word;
  while (file >> word && word != "begin") {
    if (word == "V-representation") result.is_generators = true;
    if (word != "linearity") continue;
    std::size_t count = 0, row = 0;
    for (file >> count; count > 0 && file >> row; --count) result.linearity.insert(row - 1);
  }
  std::size_t size = 0, width = 0;
  if (!(file >> size >> width >> word) || word != "integer")
    throw std::runtime_error("no integers after begin");
  result.rows.assign(size, std::vector<ppl::Coefficient>(width));
  for (auto& row : result.rows)
    for (auto& x : row)
      if (!(file >> x)) throw std::runtime_error("rows are missing");
  return result;
}

void count_generators(const Rows& rows, ppl::dimension_type d) {
  ppl::Constraint_System constraints;
  constraints.set_space_dimension(d);
  for (std::size_t i = 0; i < rows.rows.size(); ++i) {
    ppl::Linear_Expression e(rows.rows[i][0]);
    for (ppl::dimension_type j = 0; j < d; ++j) e += rows.rows[i][j + 1] * ppl::Variable(j);
    if (rows.linearity.count(i) != 0)
      constraints.insert(e == 0);
    else
      constraints.insert(e >= 0);
  }
  const ppl::C_Polyhedron polyhedron(constraints);
  std::size_t vertices = 0, rays = 0, lines = 0;
  for (const ppl::Generator& g : polyhedron.minimized_generators())
    ++(g.is_line() ? lines : g.is_ray() ? rays : vertices);
  std::cout << vertices << " vertices " << rays << " rays " << lines << " lines\n";
}

void count_constraints(const Rows& rows, ppl::dimension_type d) {
  ppl::Generator_System generators;
  generators.set_space_dimension(d);
  for (std::size_t i = 0; i < rows.rows.size(); ++i) {
    ppl::Linear_Expression e;
    for (ppl::dimension_type j = 0; j < d; ++j) e += rows.rows[i][j + 1] * ppl::Variable(j);
    if (rows.linearity.count(i) != 0)
      generators.insert(ppl::line(e));
    else if (rows.rows[i][0] == 0)
      generators.insert(ppl::ray(e));
    else
      generators.insert(ppl::point(e, rows.rows[i][0]));
  }
  const ppl::C_Polyhedron polyhedron(generators);
  std::size_t inequalities = 0, equations = 0;
  for (const ppl::Constraint& c : polyhedron.minimized_constraints())
    ++(c.is_equality() ? equations : inequalities);
  std::cout << inequalities << " inequalities " << equations << " equations\n";
}

}  // namespace

int main(int argc, char** argv) {
  try {
    if (argc != 2) throw std::runtime_error("usage: polyhedra_ppl FILE");
    const Rows rows = read(argv[1]);
    if (rows.rows.empty()) throw std::runtime_error("no rows");
    (rows.is_generators ? count_constraints : count_generators)(rows, rows.rows[0].size() - 1);
  } catch (const std::exception& error) {
    std::cerr << argv[0] << ": " << error.what() << '\n';
    return 2;
  }
}
