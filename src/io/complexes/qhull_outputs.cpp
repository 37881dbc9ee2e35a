// SPDX-License-Identifier: BSD-3-Clause
#include "io/complexes/qhull_outputs.hpp"

#include "io/file.hpp"
#include "messages/in_quotes.hpp"

#include <algorithm>

namespace delone::io {

void write_qhull_outputs(const std::string& path, const std::string& wanted, const std::string& what,
                         std::initializer_list<QhullOutput> known) {
  std::vector<std::string> names;
  for (const QhullOutput& output : known) names.emplace_back(output.first);
  std::vector<const QhullOutput*> chosen;
  for (std::size_t begin = wanted.find_first_not_of(", "); begin != std::string::npos;) {
    const std::size_t end = std::min(wanted.find_first_of(", ", begin), wanted.size());
    const std::string name = wanted.substr(begin, end - begin);
    const auto found = std::find_if(known.begin(), known.end(),
                                    [&](const QhullOutput& output) { return name == output.first; });
    if (found == known.end())
      fail(Errc::invalid_argument, "{} is none of the outputs of {} in the form of Qhull: {}",
           messages::in_quotes(name), what, fmt::join(names, " "));
    chosen.push_back(found);
    begin = wanted.find_first_not_of(", ", end);
  }
  if (chosen.empty())
    fail(Errc::invalid_argument, "no output in the form of Qhull is named; those of {} are {}", what,
         fmt::join(names, " "));
  guarded(output_name(path), [&] {
    AtomicFile file(path);
    for (const QhullOutput* output : chosen) output->second(file);
    file.commit();
  });
}

void put_column(AtomicFile& file, std::span<const SignedIndex> numbers) {
  file.print("{}\n", numbers.size());
  for (const SignedIndex number : numbers) file.print("{}\n", number);
}

void put_counted(AtomicFile& file, const NumberLists& lists) {
  for (std::size_t i = 0; i < lists.size(); ++i) {
    file.put(lists[i].size());
    if (!lists[i].empty()) file.put(' ');
    put_line(file, lists[i]);
  }
}

void put_rows(AtomicFile& file, std::span<const double> numbers, std::size_t width) {
  for (std::size_t i = 0; i + width <= numbers.size(); i += width) put_line(file, numbers.subspan(i, width));
}

}  // namespace delone::io
