#include "base/archive.h"

#include <xxhash.h>

#include <array>
#include <cstring>
#include <new>

#include "base/error.h"

namespace unshot {
namespace {

constexpr std::size_t kBuffer = std::size_t{1} << 20;
// Reads as something else on a machine of another byte order.
constexpr std::uint32_t kByteOrder = 0x01020304u;
constexpr std::size_t kKindLength = 16;
constexpr double kCheckingShare = 0.5;  // of the time that reading takes
constexpr std::size_t kHeadLength = kKindLength + 2 * sizeof(std::uint32_t);

std::array<char, kKindLength> kindBytes(std::string_view kind) {
  std::array<char, kKindLength> out{};
  std::memcpy(out.data(), kind.data(), std::min(kind.size(), kKindLength));
  return out;
}

}  // namespace

struct ArchiveWriter::Hash {
  Hash() : state(XXH3_createState()) {
    if (!state) throw std::bad_alloc();
    XXH3_64bits_reset(state);
  }
  ~Hash() { XXH3_freeState(state); }
  Hash(const Hash&) = delete;
  Hash& operator=(const Hash&) = delete;
  XXH3_state_t* state;
};

ArchiveWriter::ArchiveWriter(std::function<void(std::string_view)> sink)
    : sink_(std::move(sink)), hash_(std::make_unique<Hash>()) {}

ArchiveWriter::~ArchiveWriter() = default;

void ArchiveWriter::head(std::string_view kind, std::uint32_t version) {
  const auto name = kindBytes(kind);
  bytes(name.data(), name.size());
  bytes(&kByteOrder, sizeof kByteOrder);
  bytes(&version, sizeof version);
}

void ArchiveWriter::bytes(const void* data, std::size_t count) {
  if (count == 0) return;
  XXH3_64bits_update(hash_->state, data, count);
  if (!sink_) return;
  const char* const from = static_cast<const char*>(data);
  if (count >= kBuffer) {
    flush();
    sink_({from, count});
    return;
  }
  buffer_.append(from, count);
  if (buffer_.size() >= kBuffer) flush();
}

void ArchiveWriter::flush() {
  if (!buffer_.empty()) sink_(buffer_);
  buffer_.clear();
}

std::uint64_t ArchiveWriter::checksum() const { return XXH3_64bits_digest(hash_->state); }

void ArchiveWriter::finish() {
  const std::uint64_t sum = checksum();
  bytes(&sum, sizeof sum);
  flush();
}

ArchiveReader::ArchiveReader(std::filesystem::path path, std::string_view kind, std::uint32_t version,
                             std::string what, const CancelToken& cancel)
    : path_(std::move(path)),
      what_(std::move(what)),
      checking_(cancel.part(0, kCheckingShare)),
      reading_(cancel.part(kCheckingShare, 1)) {
  std::error_code error;
  if (!std::filesystem::is_regular_file(path_, error))
    throw Error(ErrorKind::kInput, "there is no such file", path_.string(), what_ + " of unshot");
  file_.open(path_, std::ios::binary);
  if (!file_) throw Error(ErrorKind::kInput, "cannot be read", path_.string(), "a file that you may read");
  std::array<char, kHeadLength> head{};
  file_.read(head.data(), head.size());
  if (file_.gcount() < static_cast<std::streamsize>(head.size()) ||
      std::memcmp(head.data(), kindBytes(kind).data(), kKindLength) != 0)
    throw Error(ErrorKind::kInput, "is not " + what_, path_.string(), "a file that unshot has written");
  std::uint32_t order = 0, found = 0;
  std::memcpy(&order, head.data() + kKindLength, sizeof order);
  std::memcpy(&found, head.data() + kKindLength + sizeof order, sizeof found);
  if (order != kByteOrder || found != version)
    throw Error(ErrorKind::kInput,
                order != kByteOrder ? what_ + " of a machine of another byte order"
                                    : what_ + " of version " + std::to_string(found) +
                                          "; this program reads version " + std::to_string(version),
                path_.string(), "the program that wrote it, or a new start");
  checkWhole();
}

// Nothing is taken from a file before all of it is known to be as it was written.
void ArchiveReader::checkWhole() {
  std::error_code error;
  const std::uint64_t size = std::filesystem::file_size(path_, error);
  if (error || size < kHeadLength + sizeof(std::uint64_t)) damaged();
  const std::uint64_t covered = size - sizeof(std::uint64_t);
  const std::unique_ptr<XXH3_state_t, void (*)(XXH3_state_t*)> state(
      XXH3_createState(), [](XXH3_state_t* s) { XXH3_freeState(s); });
  if (!state) throw std::bad_alloc();
  XXH3_64bits_reset(state.get());
  file_.seekg(0);
  std::vector<char> piece(kBuffer);
  for (std::uint64_t left = covered; left > 0;) {
    checking_.check();
    checking_.report(1 - static_cast<double>(left) / static_cast<double>(covered));
    const auto count = static_cast<std::size_t>(std::min<std::uint64_t>(left, piece.size()));
    if (!file_.read(piece.data(), static_cast<std::streamsize>(count))) damaged();
    XXH3_64bits_update(state.get(), piece.data(), count);
    left -= count;
  }
  std::uint64_t written = 0;
  if (!file_.read(reinterpret_cast<char*>(&written), sizeof written) ||
      written != XXH3_64bits_digest(state.get()))
    damaged();
  file_.seekg(kHeadLength);
  left_ = all_ = covered - kHeadLength;
}

void ArchiveReader::damaged() const {
  throw Error(ErrorKind::kInput, "is damaged: its content is not what its checksum says", path_.string(),
              "another copy of it, or a new start");
}

void ArchiveReader::itemSize(std::uint32_t expected) {
  std::uint32_t size = 0;
  bytes(&size, sizeof size);
  if (size != expected)
    throw Error(ErrorKind::kInput, what_ + " of another build of this program", path_.string(),
                "the program that wrote it, or a new start");
}

void ArchiveReader::bytes(void* data, std::size_t count) {
  if (count > left_) damaged();
  for (auto* to = static_cast<char*>(data); count > 0;) {
    const std::size_t piece = std::min(count, kBuffer);
    if (!file_.read(to, static_cast<std::streamsize>(piece))) damaged();
    to += piece;
    count -= piece;
    left_ -= piece;
    if (piece < kBuffer) continue;
    reading_.check();
    reading_.report(1 - static_cast<double>(left_) / static_cast<double>(all_));
  }
}

}  // namespace unshot
