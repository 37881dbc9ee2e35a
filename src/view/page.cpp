// SPDX-License-Identifier: BSD-3-Clause
// The page: viewer.html with the description of the scene and its arrays in it.
#include "base/progress_meter.hpp"
#include "io/file.hpp"
#include "view/encode.hpp"
#include "view/scene.hpp"
#include "view/viewer_page.hpp"

#include <delone/error.hpp>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <span>
#include <string>
#include <utility>

namespace delone::view {

namespace {

using Json = nlohmann::ordered_json;

class PageWriter {
 public:
  explicit PageWriter(const Scene& scene) : scene_(scene), meter_(nobody_, num_items(scene)) {}

  std::string finish() {
    put_positions();
    put_cells();
    put_integers("rows", scene_.rows);
    put_integers("groups", scene_.groups);
    put_integers("names", scene_.names);
    put_integers("siteRows", scene_.site_rows);
    put_integers("segments", scene_.segments);
    put_numbers("radius", scene_.radius, 2, true);
    put_numbers("quality", scene_.quality, 2, false);
    put_numbers("volume", scene_.volume, 3, false);
    put_numbers("value", scene_.values, 3, false);
    put_numbers("weights", scene_.weights, 3, false);

    std::string page;
    for (const std::string_view part : page_before_data()) page += part;
    put_description(page);
    page += body_;
    for (const std::string_view part : page_after_data()) page += part;
    return page;
  }

 private:
  /// All that the page holds: the measure of its progress.
  static std::size_t num_items(const Scene& scene) {
    std::size_t count = 0;
    for (const auto* items : {&scene.vertices, &scene.sites, &scene.radius, &scene.quality, &scene.volume,
                              &scene.values, &scene.weights})
      count += items->size();
    for (const auto* items : {&scene.cells, &scene.face_vertices, &scene.rows, &scene.groups, &scene.names,
                              &scene.site_rows, &scene.segments})
      count += items->size();
    return count;
  }
  void put_block(const char* name, Json block, std::size_t num_items, std::string bytes) {
    block["deflated"] = deflate(bytes, [&](double part) {
      meter_(done_ + static_cast<std::size_t>(part * static_cast<double>(num_items)));
    });
    meter_(done_ += num_items);
    blocks_[name] = std::move(block);
    body_ += "<script type=\"application/octet-stream\" id=\"delone-" + std::string(name) + "\">";
    append_base64(body_, bytes);
    body_ += "</script>\n";
  }
  void put_planes(const char* name, std::span<const std::uint32_t> items, int bytes, std::size_t stride,
                  Json block = Json::object()) {
    block["coding"] = "planes";
    block["items"] = items.size();
    block["bytes"] = bytes;
    block["stride"] = stride;
    put_block(name, std::move(block), items.size(), planes(items, bytes, stride));
  }
  void put_positions() {
    box_ = box_of(scene_.sites, scene_.dimension,
                  scene_.vertices.empty() ? Box{} : box_of(scene_.vertices, scene_.dimension));
    const auto d = static_cast<std::size_t>(scene_.dimension);
    put_planes("positions", codes_of_positions(scene_.vertices, box_), position_bytes, d);
    if (!scene_.sites.empty()) put_planes("sites", codes_of_positions(scene_.sites, box_), position_bytes, d);
  }
  void put_cells() {
    if (scene_.corners > 0)
      put_block("cells", {{"coding", "simplices"}, {"items", scene_.cells.size()}}, scene_.cells.size(),
                simplices(scene_.cells, scene_.corners));
    else
      put_block("cells", {{"coding", "polytopes"}, {"items", scene_.face_counts.size()}},
                scene_.face_vertices.size(),
                polytopes(scene_.face_counts, scene_.face_sizes, scene_.face_vertices));
  }
  void put_integers(const char* name, const std::vector<SignedIndex>& items) {
    if (items.empty()) return;
    // Of four bytes; the largest number is left to readers that need one for "none".
    constexpr std::int64_t most = (std::int64_t{1} << 32) - 2;
    const auto [least, greatest] = std::minmax_element(items.begin(), items.end());
    if (*least < 0) io::fail(Errc::invalid_argument, "page: {}: {} is negative", name, *least);
    const std::int64_t largest = *greatest;
    if (largest > most) io::fail(Errc::too_many, "page: {}: a page numbers at most {} items", name, most + 1);
    std::vector<std::uint32_t> unsigned_items;
    unsigned_items.reserve(items.size());
    for (const SignedIndex item : items) unsigned_items.push_back(static_cast<std::uint32_t>(item));
    put_planes(name, unsigned_items, bytes_for(static_cast<std::uint64_t>(largest)), 1);
  }
  void put_numbers(const char* name, const std::vector<double>& numbers, int bytes, bool log) {
    if (numbers.empty()) return;
    const Numbers coded = codes_of_numbers(numbers, bytes, log);
    put_planes(name, coded.codes, bytes, 1,
               {{"numbers", true}, {"low", coded.low}, {"high", coded.high}, {"log", coded.log}});
  }
  void put_description(std::string& page) const {
    const Json description{
        {"kind", scene_.kind},
        {"title", scene_.title},
        {"summary", scene_.summary},
        {"cellWord", scene_.cell_word},
        {"columns", scene_.columns},
        {"dimension", scene_.dimension},
        {"affineDimension", scene_.affine_dimension},
        {"corners", scene_.corners},
        {"solid", scene_.solid},
        {"dual", scene_.dual},
        {"numCells", scene_.num_cells},
        {"numVertices", scene_.num_vertices()},
        {"low", box_.low},
        {"high", box_.high},
        {"positionError", position_error(box_)},
        {"valueName", scene_.value_name},
        {"valueOfVertices", scene_.values_of_vertices},
        {"blocks", blocks_},
    };
    page += "<script type=\"application/json\" id=\"delone-scene\">";
    // Names are the user's: bytes that are no UTF-8 are replaced, and nothing ends the element.
    for (const char c : description.dump(-1, ' ', true, Json::error_handler_t::replace)) {
      if (c == '<')
        page += "\\u003c";
      else
        page.push_back(c);
    }
    page += "</script>\n";
  }

  const Scene& scene_;
  const std::function<bool(double)> nobody_;
  internal::ProgressMeter meter_;  // counts for that of to_html()
  std::size_t done_ = 0;           // of the items
  Box box_;
  Json blocks_ = Json::object();
  std::string body_;
};

}  // namespace

std::string page_of(const Scene& scene) { return PageWriter(scene).finish(); }

}  // namespace delone::view
