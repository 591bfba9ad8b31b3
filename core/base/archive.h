// Binary files of plain values: written and read as a stream, and told from damaged ones by a checksum (home
// of xxHash).
//
// A file is a magic word, the version of its kind, values, texts and arrays one after the other, and at its
// end XXH3 of all before. What a file holds, and in which order, is said once for both: a function template
// takes either archive and names the fields (mesh_archive.cpp).
//
// Each value and array says how large its items are, so that a file of another layout is refused rather than
// misread. Numbers stand as this machine has them; one of another byte order is refused.
#pragma once

#include <cstdint>
#include <filesystem>
#include <fstream>
#include <functional>
#include <memory>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

#include "base/cancel.h"

namespace unshot {

class ArchiveWriter {
 public:
  /// `sink` takes the bytes, in pieces; without one only the checksum is made.
  explicit ArchiveWriter(std::function<void(std::string_view)> sink = {});
  ~ArchiveWriter();
  ArchiveWriter(const ArchiveWriter&) = delete;
  ArchiveWriter& operator=(const ArchiveWriter&) = delete;

  /// The head of a file; first of all.
  void head(std::string_view kind, std::uint32_t version);
  /// Each as it is: a plain value, a text, or an array of plain values.
  template <class... Fields>
  void fields(const Fields&... all) {
    (field(all), ...);
  }
  /// Items that are no plain values: how many there are, and what `visit` says of each.
  template <class Item, class Visit>
  void list(const std::vector<Item>& items, const Visit& visit) {
    field(std::uint64_t{items.size()});
    for (const Item& item : items) visit(item);
  }
  /// The checksum of all so far.
  std::uint64_t checksum() const;
  /// The end of a file; last of all.
  void finish();

 private:
  template <class T>
  void field(const T& value) {
    static_assert(std::is_trivially_copyable_v<T>);
    itemSize(sizeof(T));
    bytes(&value, sizeof(T));
  }
  void field(const std::string& text) { field(std::vector<char>(text.begin(), text.end())); }
  template <class T>
  void field(const std::vector<T>& items) {
    static_assert(std::is_trivially_copyable_v<T>);
    itemSize(sizeof(T));
    const std::uint64_t count = items.size();
    bytes(&count, sizeof count);
    bytes(items.data(), count * sizeof(T));
  }
  void itemSize(std::uint32_t size) { bytes(&size, sizeof size); }
  void bytes(const void* data, std::size_t count);
  void flush();

  struct Hash;
  std::function<void(std::string_view)> sink_;
  std::unique_ptr<Hash> hash_;
  std::string buffer_;
};

/// Reads what an ArchiveWriter wrote. Throws Error (kInput) that names the file: missing, of another kind or
/// version, damaged.
class ArchiveReader {
 public:
  /// Looks at all of the file first, and at what it is. `what` names the kind in messages: "a saved solve".
  /// What the token reports is about all of the file. Throws Cancelled, as later reading does.
  ArchiveReader(std::filesystem::path path, std::string_view kind, std::uint32_t version, std::string what,
                const CancelToken& cancel = {});

  /// As ArchiveWriter's: one function template that lists fields serves both.
  template <class... Fields>
  void fields(Fields&... all) {
    (field(all), ...);
  }
  template <class Item, class Visit>
  void list(std::vector<Item>& items, const Visit& visit) {
    std::uint64_t count = 0;
    field(count);
    items.clear();
    // One by one: a number that is wrong ends with the file, before it takes all memory.
    for (std::uint64_t k = 0; k < count; ++k) visit(items.emplace_back());
  }
  /// Throws the Error of a damaged file.
  [[noreturn]] void damaged() const;

 private:
  template <class T>
  void field(T& value) {
    static_assert(std::is_trivially_copyable_v<T>);
    itemSize(sizeof(T));
    bytes(&value, sizeof(T));
  }
  void field(std::string& text) {
    std::vector<char> characters;
    field(characters);
    text.assign(characters.begin(), characters.end());
  }
  template <class T>
  void field(std::vector<T>& items) {
    static_assert(std::is_trivially_copyable_v<T>);
    itemSize(sizeof(T));
    std::uint64_t count = 0;
    bytes(&count, sizeof count);
    if (count > left_ / sizeof(T)) damaged();
    items.resize(static_cast<std::size_t>(count));
    bytes(items.data(), items.size() * sizeof(T));
  }
  void itemSize(std::uint32_t expected);
  void bytes(void* data, std::size_t count);
  void checkWhole();

  std::filesystem::path path_;
  std::string what_;
  std::ifstream file_;
  std::uint64_t left_ = 0, all_ = 0;  // bytes before the checksum: not read yet, and altogether
  CancelToken checking_, reading_;
};

}  // namespace unshot
