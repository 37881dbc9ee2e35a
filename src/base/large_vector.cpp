// SPDX-License-Identifier: BSD-3-Clause
#include "base/large_vector.hpp"

namespace delone::internal {

void fetch_pages(char* begin, std::size_t bytes) {
  constexpr std::size_t page = platform::large_page;
  PriceOfLargePages price;
  bool are_large = PriceOfLargePages::are_worth_trying(platform::clock_seconds());
  if (are_large) platform::use_large_pages(begin, bytes, true);
  while (are_large && bytes > 0) {
    const double start = platform::thread_seconds();
    if (!platform::populate(begin, page)) return;
    begin += page;
    bytes -= page;
    are_large = price.pay(platform::thread_seconds() - start, 1, platform::clock_seconds());
    if (!are_large) platform::use_large_pages(begin, bytes, false);
  }
  if (bytes > 0) platform::populate(begin, bytes);
}

}  // namespace delone::internal
