// SPDX-License-Identifier: BSD-3-Clause
#include "seam_exchange.hpp"

#include "tiles/part_file.hpp"
#include "tiles/seam_records.hpp"

#include <algorithm>
#include <vector>

namespace delone::mpi {

std::int64_t match_seams(const std::string& work, std::span<const std::int64_t> first_cell,
                         const TileOwners& owners, Ranks& ranks,
                         const std::function<void(std::size_t, std::span<const std::int64_t>)>& write) {
  const auto p = static_cast<std::size_t>(ranks.size()), rank = static_cast<std::size_t>(ranks.rank());
  const std::size_t first_tile = owners.first_tile(rank), last_tile = owners.first_tile(rank + 1);
  std::vector<std::vector<std::int64_t>> to_each(p), cells(last_tile - first_tile);
  std::size_t k = 0, rank_of_lattice = 0;
  ranks.together([&] {
    for (std::size_t t = first_tile; t < last_tile; ++t) {
      tiles::SeamReader reader(work, t);
      const auto count = reader.header().count;
      const auto r = static_cast<std::size_t>(reader.header().rank);
      std::vector<std::int64_t>& of_tile = cells[t - first_tile];
      of_tile.assign(static_cast<std::size_t>(count) * (1 + r), 0);
      for (std::size_t at = 0; at < of_tile.size(); at += 1 + r) of_tile[at] = -1;
      if (count == 0) continue;
      k = static_cast<std::size_t>(reader.header().k);
      rank_of_lattice = r;
      reader.for_each([&](std::span<const std::int64_t> record) {
        if (record[k] != static_cast<std::int64_t>(t) || record[k + 3] < 0 || record[k + 3] >= count)
          reader.refuse(record);
        std::vector<std::int64_t>& to = to_each[tiles::bucket_of_key(record.first(k), p)];
        to.insert(to.end(), record.begin(), record.end());
      });
    }
  });
  k = static_cast<std::size_t>(ranks.max(static_cast<std::int64_t>(k)));
  rank_of_lattice = static_cast<std::size_t>(ranks.max(static_cast<std::int64_t>(rank_of_lattice)));

  // Answers: tile, seam, cell, offsets.
  std::vector<std::int64_t> records;
  for (const std::vector<std::int64_t>& some : ranks.exchange(to_each))
    records.insert(records.end(), some.begin(), some.end());
  to_each = {};
  std::int64_t unmatched = 0;
  std::vector<std::vector<std::int64_t>> answers(p);
  ranks.together([&] {
    tiles::match_seam_records(
        records, k, rank_of_lattice, [&](std::span<const std::int64_t> a, std::span<const std::int64_t> c) {
          if (a.data() == c.data()) {
            ++unmatched;
            return;
          }
          const auto tell = [&](std::span<const std::int64_t> one, std::span<const std::int64_t> other) {
            std::vector<std::int64_t>& to = answers[owners.owner(static_cast<std::size_t>(one[k]))];
            to.insert(to.end(), {one[k], one[k + 3]});
            tiles::add_answer(one, other, k, rank_of_lattice, first_cell, to);
          };
          tell(a, c);
          tell(c, a);
        });
  });
  records = {};
  const auto told = ranks.exchange(answers);
  ranks.together([&] {
    for (const std::vector<std::int64_t>& some : told)
      for (std::size_t i = 0; i < some.size(); i += 3 + rank_of_lattice)
        std::copy_n(some.begin() + static_cast<std::ptrdiff_t>(i + 2), 1 + rank_of_lattice,
                    cells[static_cast<std::size_t>(some[i]) - first_tile].begin() +
                        some[i + 1] * static_cast<std::ptrdiff_t>(1 + rank_of_lattice));
    for (std::size_t t = first_tile; t < last_tile; ++t) write(t, cells[t - first_tile]);
  });
  return ranks.sum(unmatched);
}

}  // namespace delone::mpi
