#include "base/archive.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>

#include "base/atomic_file.h"
#include "base/error.h"
#include "support/temp_folder.h"

namespace unshot {
namespace {

using testing_support::TempFolder;

std::string bytesOf(const std::function<void(ArchiveWriter&)>& write) {
  std::string out;
  ArchiveWriter archive([&](std::string_view piece) { out += piece; });
  archive.head("test file", 3);
  write(archive);
  archive.finish();
  return out;
}

std::string sample() {
  return bytesOf([](ArchiveWriter& archive) {
    archive.fields(1.5, std::string("a name"), std::vector<std::uint32_t>{1, 2, 3});
  });
}

std::string messageOf(const std::filesystem::path& path, std::uint32_t version = 3) {
  try {
    ArchiveReader(path, "test file", version, "a test file");
  } catch (const Error& error) {
    EXPECT_EQ(error.kind(), ErrorKind::kInput);
    EXPECT_EQ(error.where(), path.string());
    EXPECT_FALSE(error.advice().empty());
    return error.what();
  }
  return {};
}

TEST(Archive, GivesBackWhatItTook) {
  const TempFolder folder;
  ArchiveReader archive(folder.write("f", sample()), "test file", 3, "a test file");
  double number = 0;
  std::string text;
  std::vector<std::uint32_t> items;
  archive.fields(number, text, items);
  EXPECT_EQ(number, 1.5);
  EXPECT_EQ(text, "a name");
  EXPECT_EQ(items, (std::vector<std::uint32_t>{1, 2, 3}));
  EXPECT_THROW(archive.fields(number), Error);  // nothing is left
}

TEST(Archive, ListsItemsThatAreNoPlainValues) {
  const TempFolder folder;
  const auto transfer = [](auto& archive, auto& lists) {
    archive.list(lists, [&](auto& list) { archive.fields(list); });
  };
  const std::vector<std::vector<int>> lists{{1, 2}, {}, {3}};
  ArchiveReader archive(folder.write("f", bytesOf([&](ArchiveWriter& a) { transfer(a, lists); })),
                        "test file", 3, "a test file");
  std::vector<std::vector<int>> read;
  transfer(archive, read);
  EXPECT_EQ(read, lists);
}

TEST(Archive, RefusesAListOfMoreItemsThanTheFileHasRoomFor) {
  const TempFolder folder;
  const std::string bytes = bytesOf([](ArchiveWriter& a) { a.fields(std::uint64_t{1} << 60); });
  ArchiveReader archive(folder.write("f", bytes), "test file", 3, "a test file");
  std::vector<std::string> read;
  EXPECT_THROW(archive.list(read, [&](std::string& text) { archive.fields(text); }), Error);
}

TEST(Archive, WritesLongArraysInPieces) {
  const TempFolder folder;
  const std::vector<double> many(500'000, 0.25);
  std::size_t pieces = 0;
  std::string out;
  ArchiveWriter archive([&](std::string_view piece) {
    out += piece;
    ++pieces;
  });
  archive.head("test file", 3);
  archive.fields(many, many);
  archive.finish();
  EXPECT_GT(pieces, 2u);
  ArchiveReader reader(folder.write("f", out), "test file", 3, "a test file");
  std::vector<double> first, second;
  reader.fields(first, second);
  EXPECT_EQ(first, many);
  EXPECT_EQ(second, many);
}

TEST(Archive, RefusesAFileOfWhichAByteIsNotAsItWas) {
  const TempFolder folder;
  const std::string whole = sample();
  for (std::size_t k = 0; k < whole.size(); ++k) {
    std::string bytes = whole;
    bytes[k] = static_cast<char>(bytes[k] ^ 1);
    EXPECT_FALSE(messageOf(folder.write("f", bytes)).empty()) << "byte " << k;
  }
}

TEST(Archive, RefusesAFileThatIsCutOrLonger) {
  const TempFolder folder;
  const std::string whole = sample();
  for (std::size_t length = 0; length < whole.size(); ++length)
    EXPECT_FALSE(messageOf(folder.write("f", whole.substr(0, length))).empty()) << length << " bytes";
  EXPECT_FALSE(messageOf(folder.write("f", whole + '\0')).empty());
}

TEST(Archive, SaysWhatItDoesNotRead) {
  const TempFolder folder;
  EXPECT_EQ(messageOf(folder.path() / "missing"), "there is no such file");
  EXPECT_EQ(messageOf(folder.write("f", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n")), "is not a test file");
  EXPECT_EQ(messageOf(folder.write("f", sample()), 4),
            "a test file of version 3; this program reads version 4");
}

TEST(Archive, RefusesValuesOfAnotherSize) {
  const TempFolder folder;
  ArchiveReader archive(folder.write("f", sample()), "test file", 3, "a test file");
  float number = 0;
  EXPECT_THROW(archive.fields(number), Error);
}

TEST(Archive, ChecksumsTellContentsApart) {
  const auto sumOf = [](double x) {
    ArchiveWriter archive;
    archive.fields(x);
    return archive.checksum();
  };
  EXPECT_EQ(sumOf(1), sumOf(1));
  EXPECT_NE(sumOf(1), sumOf(2));
}

// What fails on the way leaves the file as it was.
TEST(WriteWholeFile, InPiecesReplacesAFileOnlyByAWholeOne) {
  const TempFolder folder;
  const std::filesystem::path path = folder.write("f", "before");
  EXPECT_THROW(writeWholeFile(path,
                              [](const std::function<void(std::string_view)>& sink) {
                                sink("half of it");
                                throw std::runtime_error("and no more");
                              }),
               std::runtime_error);
  EXPECT_EQ(folder.read("f"), "before");
  EXPECT_EQ(std::distance(std::filesystem::directory_iterator(folder.path()), {}), 1);
}

}  // namespace
}  // namespace unshot
