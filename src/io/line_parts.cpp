// SPDX-License-Identifier: BSD-3-Clause
#include "io/line_parts.hpp"

#include "base/parallel_parts.hpp"

#include <algorithm>
#include <atomic>
#include <span>

namespace delone::io {

std::size_t count_line_ends(std::string_view text) {
  const auto line_feeds = static_cast<std::size_t>(std::count(text.begin(), text.end(), '\n'));
  if (text.find('\r') == std::string_view::npos) return line_feeds;
  std::size_t others = 0;  // not followed by LF
  for (std::size_t i = 0; i + 1 < text.size(); ++i)
    others += static_cast<std::size_t>(text[i] == '\r') & static_cast<std::size_t>(text[i + 1] != '\n');
  return line_feeds + others + (text.back() == '\r' ? 1 : 0);
}

std::vector<LinePart> split_lines(std::string_view text, std::size_t first_line, char never,
                                  const ReadingInParts& how) {
  if (internal::threads_for_parts(how.threads, text.size() / how.part_bytes) < 2) return {};
  std::vector<LinePart> parts;
  for (std::size_t begin = 0; begin < text.size();) {
    std::size_t end = text.find_first_of("\r\n", std::min(begin + how.part_bytes, text.size()) - 1);
    if (end == std::string_view::npos) {
      end = text.size();
    } else {
      end += text.substr(end, 2) == "\r\n" ? 2 : 1;
    }
    parts.push_back({text.substr(begin, end - begin), 0, 0});
    begin = end;
  }
  std::atomic<bool> can_be_split = true;
  internal::for_parts(how.threads, parts.size(), 1,
                      [&](std::size_t first, std::size_t last, const internal::StopPoint& stop) {
                        for (LinePart& part : std::span(parts).subspan(first, last - first)) {
                          stop();
                          if (never != 0 && part.text.find(never) != std::string_view::npos)
                            can_be_split.store(false, std::memory_order_relaxed);
                          part.num_lines = count_line_ends(part.text);
                        }
                      });
  if (!can_be_split) return {};
  for (LinePart& part : parts) {
    part.first_line = first_line;
    first_line += part.num_lines;
  }
  // The last line may have no end.
  if (!parts.empty() && text.back() != '\n' && text.back() != '\r') ++parts.back().num_lines;
  return parts;
}

}  // namespace delone::io
