// SPDX-License-Identifier: BSD-3-Clause
// The pages of all ranks for the questions of one: its own, and those of others that have come.
#pragma once

#include "owned_pages.hpp"
#include "pages/pages.hpp"
#include "periodic/period.hpp"
#include "ranks.hpp"

#include <cstddef>
#include <cstdint>
#include <memory>
#include <mutex>
#include <vector>

namespace delone::mpi {

class RemotePages final : public pages::PageSource {
 public:
  /// `period`: that of a periodic set, or null. REQUIRES that it outlives the object, as `own` does.
  RemotePages(const OwnedPages& own, const periodic::Period* period)
      : own_(own), period_(period), pages_(own.table().num_pages()) {}

  /// Null for a page of another rank that has not come; exchange() will get it.
  std::shared_ptr<const pages::Page> find(std::size_t page) override;
  /// Wants the pages of other ranks that are near a tile, or have a translate that is, as many questions will
  /// reach them.
  void want_near(std::size_t tile);
  /// Every rank gets the pages that it wants, each in one message per owner. Collective. Returns how many
  /// came here.
  std::size_t exchange(Ranks& ranks);
  /// Forgets all pages.
  void drop();

 private:
  std::vector<std::vector<double>> nearest_translations() const;

  const OwnedPages& own_;
  const periodic::Period* const period_;
  std::mutex mutex_;  // of the members below
  std::vector<std::shared_ptr<const pages::Page>> pages_;
  std::vector<std::uint64_t> wanted_;  // with repetitions
};

}  // namespace delone::mpi
