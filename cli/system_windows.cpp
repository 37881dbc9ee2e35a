// SPDX-License-Identifier: BSD-3-Clause
// Windows. See system.hpp.
#include <delone/config.hpp>

#if !DELONE_PORTABLE && defined(_WIN32)

#include "system.hpp"

#define WIN32_LEAN_AND_MEAN
#include <fcntl.h>
#include <io.h>
#include <windows.h>

#include <psapi.h>

#include <cerrno>
#include <csignal>

namespace delone::cli::system {
namespace {

namespace fs = std::filesystem;

/// The time that `caught` has to end the work.
constexpr DWORD grace_milliseconds = 800;

void (*on_signal)(int) = nullptr;
void (*on_grace_over)() = nullptr;

/// Runs in a thread of its own.
BOOL WINAPI handle_event(DWORD event) {
  const bool is_break = event == CTRL_C_EVENT || event == CTRL_BREAK_EVENT;
  on_signal(is_break ? SIGINT : SIGTERM);
  Sleep(grace_milliseconds);
  on_grace_over();
  return TRUE;
}

/// Arguments are in UTF-8, by the manifest.
fs::path wide(const std::string& path) { return fs::path(std::u8string(path.begin(), path.end())); }

FoundFile found(HANDLE file) {
  BY_HANDLE_FILE_INFORMATION information{};
  if (file == INVALID_HANDLE_VALUE || file == nullptr) return {};
  if (GetFileType(file) != FILE_TYPE_DISK || GetFileInformationByHandle(file, &information) == 0)
    return {true, std::nullopt};
  if ((information.dwFileAttributes & FILE_ATTRIBUTE_DIRECTORY) != 0) return {true, std::nullopt};
  return {true, FileNumber{information.dwVolumeSerialNumber,
                           std::uint64_t{information.nFileIndexHigh} << 32 | information.nFileIndexLow}};
}

PROCESS_MEMORY_COUNTERS memory_counters() {
  PROCESS_MEMORY_COUNTERS counters{};
  K32GetProcessMemoryInfo(GetCurrentProcess(), &counters, sizeof counters);
  return counters;
}

/// The job of this process alone, which can limit its memory.
HANDLE job_of_process() {
  static const HANDLE job = [] {
    const HANDLE made = CreateJobObjectW(nullptr, nullptr);
    return made != nullptr && AssignProcessToJobObject(made, GetCurrentProcess()) != 0 ? made : nullptr;
  }();
  return job;
}

bool has_limit = false;

void set_limit(DWORD which, std::uint64_t bytes) {
  JOBOBJECT_EXTENDED_LIMIT_INFORMATION limit{};
  limit.BasicLimitInformation.LimitFlags = which;
  limit.ProcessMemoryLimit = static_cast<SIZE_T>(bytes);
  if (job_of_process() != nullptr)
    SetInformationJobObject(job_of_process(), JobObjectExtendedLimitInformation, &limit, sizeof limit);
}

}  // namespace

void prepare_process() {
  for (std::FILE* const stream : {stdin, stdout, stderr}) _setmode(_fileno(stream), _O_BINARY);
  SetConsoleOutputCP(CP_UTF8);
}

bool is_terminal() {
  // Since Windows 10 a terminal understands the escape sequences of the progress bar, if it is asked to.
  const HANDLE console = GetStdHandle(STD_ERROR_HANDLE);
  DWORD mode = 0;
  return GetConsoleMode(console, &mode) != 0 &&
         SetConsoleMode(console, mode | ENABLE_VIRTUAL_TERMINAL_PROCESSING) != 0;
}

int why_not_writable(const std::string& path) {
  constexpr int for_writing = 2;
  return _waccess(wide(path).c_str(), for_writing) == 0 ? 0 : errno;
}
int why_not_writable_folder(const std::string& path) { return why_not_writable(path); }

std::string null_device() {
  return (fs::temp_directory_path() / ("delone-nothing-" + std::to_string(GetCurrentProcessId()))).string();
}
void remove_null(const std::string& path) {
  std::error_code ignored;
  fs::remove(path, ignored);
}

FoundFile find_file(const std::string& path) {
  const HANDLE file =
      CreateFileW(wide(path).c_str(), 0, FILE_SHARE_READ | FILE_SHARE_WRITE | FILE_SHARE_DELETE, nullptr,
                  OPEN_EXISTING, FILE_FLAG_BACKUP_SEMANTICS, nullptr);
  const FoundFile result = found(file);
  if (file != INVALID_HANDLE_VALUE) CloseHandle(file);
  return result;
}
FoundFile find_file(StandardStream stream) {
  return found(GetStdHandle(stream == StandardStream::input ? STD_INPUT_HANDLE : STD_OUTPUT_HANDLE));
}

std::size_t peak_memory() { return memory_counters().PeakWorkingSetSize; }

std::optional<Memory> memory_now() {
  const PROCESS_MEMORY_COUNTERS counters = memory_counters();
  if (counters.WorkingSetSize == 0) return std::nullopt;
  return Memory{counters.WorkingSetSize, counters.PagefileUsage};
}

void limit_data(std::uint64_t bytes) {
  has_limit = true;
  set_limit(JOB_OBJECT_LIMIT_PROCESS_MEMORY, bytes);
}
void restore_limit_of_data() {
  if (has_limit) set_limit(0, 0);
}

void watch_signals(void (*caught)(int), void (*grace_over)()) {
  on_signal = caught;
  on_grace_over = grace_over;
  SetConsoleCtrlHandler(handle_event, TRUE);
}

/// Windows has nothing like it; the writer sees at its next piece that a signal was caught.
void refuse_writes() {}

void write_error(std::string_view text) {
  DWORD written = 0;
  WriteFile(GetStdHandle(STD_ERROR_HANDLE), text.data(), static_cast<DWORD>(text.size()), &written, nullptr);
}

}  // namespace delone::cli::system

#endif
