// SPDX-License-Identifier: BSD-3-Clause
#include "tiles/folder_names.hpp"

#include "io/file.hpp"
#include "tiles/index_file.hpp"
#include "tiles/part_file.hpp"

#include <algorithm>
#include <filesystem>
#include <utility>
#include <vector>

namespace delone::tiles {

namespace fs = std::filesystem;

namespace {

bool is_of_parts(const std::string& name) {
  return name == index_name || name == work_name || name == "tiles.pvtu" ||
         name.starts_with(".delone-partial-") ||
         (name.starts_with("part-") &&
          (name.ends_with(".npz") || name.ends_with(".npy") || name.ends_with(".vtu")));
}

bool is_of_work(const std::string& name) {
  for (const char* const start : {"plan.json", "split.json", "lock", "points.bin", "pages.bin", "tile-",
                                  "seams-", "answers", "facets", ".delone-partial-"})
    if (name.starts_with(start)) return true;
  return false;
}

}  // namespace

void cannot_write(const std::string& path, const std::error_code& error) {
  io::fail(Errc::cannot_write, "{}: {}", io::output_name(path), error.message());
}

std::string foreign_names(const std::string& folder) {
  std::vector<std::string> names;
  std::error_code error;
  for (fs::directory_iterator at(folder, error), end; !error && at != end; at.increment(error))
    if (const std::string name = at->path().filename().string(); !is_of_parts(name)) names.push_back(name);
  const std::string work = path_in(folder, work_name);
  if (!error && fs::is_directory(work, error))
    for (fs::directory_iterator at(work, error), end; !error && at != end; at.increment(error))
      if (const std::string name = at->path().filename().string(); !is_of_work(name))
        names.push_back(path_in(work_name, name));
  if (error == std::errc::no_such_file_or_directory) error.clear();
  if (error) cannot_write(folder, error);
  std::sort(names.begin(), names.end());
  return io::joined(names);
}

void remove_parts(const std::string& folder) {
  std::vector<fs::path> paths;
  std::error_code error;
  for (fs::directory_iterator at(folder, error), end; !error && at != end; at.increment(error))
    if (is_of_parts(at->path().filename().string())) paths.push_back(at->path());
  std::sort(paths.begin(), paths.end(), [](const fs::path& a, const fs::path& b) {
    const bool last_a = a.filename() == index_name || a.filename() == work_name;
    const bool last_b = b.filename() == index_name || b.filename() == work_name;
    return last_a != last_b ? last_b : a < b;
  });
  for (const fs::path& path : paths)
    if (!error) fs::remove_all(path, error);
  if (error) cannot_write(folder, error);
}

std::unique_ptr<platform::FileLock> lock_work(const std::string& folder) {
  auto lock = std::make_unique<platform::FileLock>(path_in(path_in(folder, work_name), "lock").c_str());
  if (!lock->is_held())
    io::fail(Errc::cannot_write, "{}: another process is making tiles in this folder",
             io::output_name(folder));
  return lock;
}

void remove_work(const std::string& folder, std::unique_ptr<platform::FileLock> lock) {
  const std::string work = path_in(folder, work_name);
  std::error_code error;
  if (DELONE_WINDOWS) lock.reset();  // where the file of the lock cannot be removed while it is open
  fs::remove_all(work, error);
  if (error) cannot_write(work, error);
}

void remove_leftover_work(const std::string& folder) {
  const std::string work = path_in(folder, work_name);
  std::error_code error;
  if (!fs::is_directory(work, error) || !foreign_names(folder).empty()) return;
  auto lock = std::make_unique<platform::FileLock>(path_in(work, "lock").c_str());
  if (!lock->is_held()) return;
  if (DELONE_WINDOWS) lock.reset();
  fs::remove_all(work, error);
}

}  // namespace delone::tiles
