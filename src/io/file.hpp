// SPDX-License-Identifier: BSD-3-Clause
// What every reader and writer shares: whole files in memory, the choice of a format, and error messages.
#pragma once

#include "base/growable_array.hpp"

#include <fmt/format.h>
#include <delone/arithmetic.hpp>
#include <delone/error.hpp>
#include <delone/printable.hpp>

#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <functional>
#include <initializer_list>
#include <memory>
#include <new>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace delone::io {

/// Throws Error with a formatted message.
template <class... Args>
[[noreturn]] void fail(Errc code, fmt::format_string<Args...> format, Args&&... args) {
  throw Error(code, fmt::format(format, std::forward<Args>(args)...));
}

/// "a, b, c", each made printable; "a, b, … (17 in all)" if that is long.
std::string joined(const std::vector<std::string>& items);

/// The text of an errno value.
std::string error_text(int error);

/// A path as messages name it: printable, and "-" is standard input.
std::string input_name(const std::string& path);
/// The same, and "-" is standard output.
std::string output_name(const std::string& path);

/// The bytes of a file. Not initialised before they are read, and grown in place: files may be as large as
/// memory.
class Bytes {
 public:
  explicit Bytes(std::size_t capacity) { reserve(capacity); }
  void reserve(std::size_t capacity) { bytes_.reserve(capacity); }
  /// Says that so many bytes will soon be written in all. REQUIRES room for them.
  void prepare(std::size_t size) { bytes_.prepare(size); }
  char* data() { return bytes_.data(); }
  std::size_t size() const { return size_; }
  std::size_t capacity() const { return bytes_.capacity(); }
  void set_size(std::size_t size) { size_ = size; }
  std::string_view view() const { return {bytes_.data(), size_}; }

 private:
  internal::GrowableArray<char> bytes_{internal::Pages::large};
  std::size_t size_ = 0;
};

/// The first bytes of a file: 64 KiB, unless it is shorter. May throw, so that the rest is not read.
using CheckOpening = std::function<void(std::string_view opening, bool is_whole)>;

/// All of a file, or of standard input when the path is "-", decompressed if gzip has compressed it. Throws
/// cannot_open with the system's reason, out_of_memory for a stream, or decompressed bytes, of more than
/// `max_stream_bytes`, and as decompressed().
Bytes read_all(const std::string& path, std::uint64_t max_stream_bytes, const CheckOpening& check_opening);

/// Throws cannot_open if the path is that of a folder. `expected`: "a file of points".
void refuse_folder(const std::string& path, std::string_view expected);

/// Throws bad_format if a byte is zero, which no text has.
void require_text(std::string_view opening, const std::string& name);

/// What a file is opened for. Results that to_meshio() of Python takes are meshes.
enum class Use { reading, writing, writing_mesh };

/// The lower-case format to use: `format` if given, `standard_stream` for the path "-", else the extension of
/// the path. Throws unsupported, listing `known`, unless the result is among them; for a mesh the message
/// names to_meshio(). `what`: "points", say, for messages. For reading, .gz after the extension does not
/// count.
std::string choose_format(const std::string& path, const std::string& format,
                          std::string_view standard_stream, std::initializer_list<std::string_view> known,
                          Use use, std::string_view what);

/// What may be done with points that are compressed as LAZ.
inline constexpr std::string_view laz_advice =
    "LAZ is not read: decompress it with laszip -i IN.laz -o OUT.las, or read it with "
    "laspy.read(\"IN.laz\").xyz "
    "in Python";

/// Runs a reader or writer in the floating-point state of the library, and turns exhausted memory into
/// Error{out_of_memory}.
template <class Work>
auto guarded(const std::string& name, Work&& work) {
  const ArithmeticScope arithmetic;
  try {
    return std::forward<Work>(work)();
  } catch (const std::bad_alloc&) {
    fail(Errc::out_of_memory, "{}: not enough memory", name);
  } catch (const std::length_error&) {
    fail(Errc::out_of_memory, "{}: not enough memory", name);
  }
}

}  // namespace delone::io
