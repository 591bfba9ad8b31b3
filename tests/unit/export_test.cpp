#include <gmock/gmock.h>

#include <cmath>
#include <cstring>
#include <glm/geometric.hpp>
#include <limits>

#include "base/error.h"
#include "base/srgb.h"
#include "export/exporters.h"
#include "export/image_files.h"
#include "export/ply.h"
#include "scene/texture_mean.h"
#include "support/given_up.h"
#include "support/synthetic_room.h"
#include "support/temp_folder.h"

namespace unshot {
namespace {

using testing::HasSubstr;
using testing_support::givenUpAt;
using testing_support::TempFolder;

TEST(ImageFiles, PngKeepsEveryByteAndIsDecodedFromSrgb) {
  const TempFolder folder;
  Image8 image{16, 16, {}};
  for (int k = 0; k < 16 * 16 * 3; ++k) image.rgb.push_back(static_cast<std::uint8_t>(k % 256));
  writePng(folder / "a.png", image);
  const ImageF read = readImage(folder / "a.png");
  ASSERT_EQ(read.width, 16);
  ASSERT_EQ(read.rgb.size(), image.rgb.size());
  for (std::size_t k = 0; k < image.rgb.size(); ++k) {
    ASSERT_NEAR(read.rgb[k], linearFromSrgb(image.rgb[k] / 255.0), 1e-6) << k;
    ASSERT_EQ(srgb8FromLinear(read.rgb[k]), image.rgb[k]);
  }
}

TEST(ImageFiles, HdrKeepsLinearValuesToAPercent) {
  const TempFolder folder;
  ImageF image{9, 2, {}};
  for (int k = 0; k < 9 * 2; ++k) {
    const auto value = static_cast<float>(std::pow(10.0, k - 9));
    image.rgb.insert(image.rgb.end(), {value, 0.7f * value, 0.5f * value});
  }
  writeHdr(folder / "a.hdr", image);
  const ImageF read = readImage(folder / "a.hdr");
  ASSERT_EQ(read.rgb.size(), image.rgb.size());
  for (std::size_t k = 0; k < image.rgb.size(); ++k) EXPECT_NEAR(read.rgb[k] / image.rgb[k], 1, 0.012) << k;
}

TEST(ImageFiles, HdrTurnsWhatIsNoRadianceIntoBlack) {
  const TempFolder folder;
  const float nan = std::numeric_limits<float>::quiet_NaN();
  writeHdr(folder / "a.hdr", {1, 1, {-1, nan, 0}});
  EXPECT_THAT(readImage(folder / "a.hdr").rgb, testing::Each(0.0f));
}

TEST(ImageFiles, RefusesWhatIsNoPicture) {
  const TempFolder folder;
  EXPECT_THROW(readImage(folder.write("a.png", "no picture")), Error);
  EXPECT_THROW(readImage(folder / "missing.png"), Error);
  writePng(folder / "whole.png", {4, 4, std::vector<std::uint8_t>(48)});
  EXPECT_THROW(readImage(folder.write("cut.png", folder.read("whole.png").substr(0, 40))), Error);
}

TEST(Ply, HasTheLayoutOfTheDesign) {
  const Snapshot room = testing_support::RoomBuilder({.frame_origin = {100, 0, -50}}).build();
  const std::string bytes = plyBytes(room, false, 0.5);
  const std::string header = bytes.substr(0, bytes.find("end_header\n") + 11);
  EXPECT_THAT(header, HasSubstr("ply\nformat binary_little_endian 1.0\n"));
  EXPECT_THAT(
      header,
      HasSubstr("property float x\nproperty float y\nproperty float z\nproperty float nx\nproperty float ny\n"
                "property float nz\nproperty float radiosity_r\nproperty float radiosity_g\n"
                "property float radiosity_b\nproperty uchar red\nproperty uchar green\n"
                "property uchar blue\nelement face "));
  const std::size_t vertices = room.mesh->vertices.size(),
                    triangles = room.mesh->triangle_vertices.size() / 3;
  EXPECT_EQ(bytes.size(), header.size() + 39 * vertices + 13 * triangles);
  float first[9];
  std::memcpy(first, bytes.data() + header.size(), sizeof first);
  EXPECT_FLOAT_EQ(first[0], room.mesh->vertices[0].position.x + 100);
  EXPECT_FLOAT_EQ(first[2], room.mesh->vertices[0].position.z - 50);
  EXPECT_FLOAT_EQ(first[4], room.mesh->vertices[0].normal.y);
  EXPECT_FLOAT_EQ(first[6], static_cast<float>(radiosity(room, 0, false).x));
}

TEST(Ply, TrianglesFaceTheirSide) {
  const Snapshot room = testing_support::RoomBuilder({}).build();
  const std::string bytes = plyBytes(room, false, 1);
  const char* face = bytes.data() + bytes.find("end_header\n") + 11 + 39 * room.mesh->vertices.size();
  for (std::size_t t = 0; t < room.mesh->triangle_vertices.size() / 3; ++t, face += 13) {
    ASSERT_EQ(face[0], 3);
    std::int32_t corner[3];
    std::memcpy(corner, face + 1, sizeof corner);
    const auto& vertices = room.mesh->vertices;
    const glm::vec3 a = vertices[std::size_t(corner[0])].position,
                    b = vertices[std::size_t(corner[1])].position,
                    c = vertices[std::size_t(corner[2])].position;
    EXPECT_GT(glm::dot(glm::cross(b - a, c - a), vertices[std::size_t(corner[0])].normal), 0) << t;
  }
}

TEST(Ply, ReadsBackWhatItWrote) {
  const TempFolder folder;
  const Snapshot room = testing_support::RoomBuilder({}).build();
  const PlySolution solution = readPly(folder.write("a.ply", plyBytes(room, false, 1)));
  ASSERT_EQ(solution.positions.size(), room.mesh->vertices.size());
  for (std::size_t v = 0; v < solution.positions.size(); ++v) {
    EXPECT_EQ(solution.positions[v], glm::dvec3(room.mesh->vertices[v].position));
    EXPECT_LT(glm::length(solution.radiosity[v] - radiosity(room, v, false)), 1e-6);
  }
}

TEST(Ply, RefusesWhatItCannotRead) {
  const TempFolder folder;
  const std::string whole = plyBytes(testing_support::RoomBuilder({}).build(), false, 1);
  const auto refused = [&](const std::string& content) {
    try {
      readPly(folder.write("a.ply", content));
    } catch (const Error& error) {
      return error.kind() == ErrorKind::kInput;
    }
    return false;
  };
  EXPECT_TRUE(refused("ply"));
  EXPECT_TRUE(refused("hello"));
  EXPECT_TRUE(refused("ply\nformat ascii 1.0\nend_header\n"));
  EXPECT_TRUE(
      refused("ply\nformat binary_little_endian 1.0\nelement vertex 9\nproperty float x\nend_header\n"));
  EXPECT_TRUE(refused(whole.substr(0, whole.find("end_header\n") + 100)));
  std::string huge = whole;
  const std::size_t count = huge.find("vertex ") + 7;
  huge.replace(count, huge.find('\n', count) - count, "99999999999999999999");
  EXPECT_TRUE(refused(huge));
}

/// A PNG of stored bytes: the rows as they are, each after the number of its filter.
std::string storedPng(std::uint32_t width, std::uint32_t height, int depth, int colour,
                      const std::string& rows) {
  const auto number = [](std::size_t n, int bytes, bool low_first = false) {
    std::string out;
    for (int k = 0; k < bytes; ++k)
      out.push_back(static_cast<char>(n >> 8 * (low_first ? k : bytes - 1 - k) & 255));
    return out;
  };
  const auto chunk = [&](const std::string& type, const std::string& data) {
    return number(data.size(), 4) + type + data + "????";  // checksums are not looked at
  };
  const std::string head = number(width, 4) + number(height, 4) + static_cast<char>(depth) +
                           static_cast<char>(colour) + std::string(3, '\0');
  const std::string data =
      "\x78\x01\x01" + number(rows.size(), 2, true) + number(~rows.size() & 0xffff, 2, true) + rows;
  return "\x89PNG\r\n\x1a\n" + chunk("IHDR", head) + chunk("IDAT", data.substr(0, 7)) +
         chunk("tEXt", "between") + chunk("IDAT", data.substr(7)) + chunk("IEND", "");
}

TEST(ImageFiles, ReadPngsOfOtherKinds) {
  const TempFolder folder;
  const auto read = [&](const std::string& bytes) { return readImage(folder.write("k.png", bytes)).rgb; };
  const auto linear = [](double share) { return static_cast<float>(linearFromSrgb(share)); };
  const float a = linear(10 / 255.0), b = linear(20 / 255.0), c = linear(30 / 255.0);
  // The second row adds to the first.
  const std::vector<float> grey = {a, a, a, b, b, b};
  EXPECT_EQ(read(storedPng(1, 2, 8, 0, std::string("\0\x0a\2\x0a", 4))), grey);
  EXPECT_EQ(read(storedPng(1, 2, 8, 4, std::string("\0\x0a\xff\2\x0a\0", 6))), grey) << "with transparency";
  const std::vector<float> colour = {a, b, c};
  EXPECT_EQ(read(storedPng(1, 1, 8, 6, std::string("\0\x0a\x14\x1e\x80", 5))), colour);
  EXPECT_EQ(read(storedPng(1, 1, 16, 2, std::string("\0\x0a\x0a\x14\x14\x1e\x1e", 7))), colour) << "16 bits";
  EXPECT_THROW(read(storedPng(2, 2, 8, 0, std::string("\0\x0a\2\x0a", 4))), Error) << "cut short";
}

// Each filter is the best for some of these rows. The reader of textures is another.
TEST(ImageFiles, PngsAreReadByOthersAndBack) {
  const TempFolder folder;
  Image8 image{301, 97, {}};
  std::uint32_t noise = 1;
  for (int y = 0; y < image.height; ++y) {
    for (int x = 0; x < image.width; ++x) {
      noise = noise * 1664525u + 1013904223u;
      const int values[] = {x * y / 64, y % 9 < 4 ? static_cast<int>(noise >> 24) : x, 3 * y};
      for (const int value : values) image.rgb.push_back(static_cast<std::uint8_t>(value));
    }
  }
  writePng(folder / "a.png", image);
  glm::dvec3 mean(0.0);
  const ImageF read = readImage(folder / "a.png");
  ASSERT_EQ(read.rgb.size(), image.rgb.size());
  for (std::size_t k = 0; k < image.rgb.size(); ++k) {
    ASSERT_EQ(srgb8FromLinear(read.rgb[k]), image.rgb[k]) << k;
    mean[static_cast<int>(k % 3)] += linearFromSrgb(image.rgb[k] / 255.0) / (301.0 * 97);
  }
  const auto elsewhere = textureMean(folder / "a.png");
  ASSERT_TRUE(elsewhere);
  EXPECT_LT(glm::distance(*elsewhere, mean), 1e-4);
}

TEST(ImageFiles, WritingAndReadingTellHowFarTheyAreAndEndWhereTheyAreGivenUp) {
  const TempFolder folder;
  const Image8 image{600, 400, std::vector<std::uint8_t>(600 * 400 * 3, 77)};
  const std::string path = folder.write("a.png", "what was there");
  for (const double share : {0.0, 0.5, 0.9}) {
    EXPECT_LT(givenUpAt(share, [&](const CancelToken& cancel) { writePng(path, image, cancel); }),
              share + 0.1);
    EXPECT_EQ(folder.read("a.png"), "what was there");
  }
  writePng(path, image);
  ImageF light{300, 200, std::vector<float>(300 * 200 * 3, 0.5f)};
  for (std::size_t k = 0; k < light.rgb.size(); ++k) light.rgb[k] = static_cast<float>(k % 977);
  writeHdr(folder / "a.hdr", light);
  for (const double share : {0.0, 0.5}) {
    for (const char* file : {"a.png", "a.hdr"})
      EXPECT_LT(givenUpAt(share, [&](const CancelToken& cancel) { readPicture(folder / file, cancel); }),
                share + 0.1);
  }
}

// At any length: within its head, a row and between two.
TEST(ImageFiles, RefusesRadianceFilesThatAreCutShort) {
  const TempFolder folder;
  ImageF light{64, 8, std::vector<float>(64 * 8 * 3)};
  for (std::size_t k = 0; k < light.rgb.size(); ++k) light.rgb[k] = static_cast<float>(k / 100 % 7);
  writeHdr(folder / "a.hdr", light);
  const std::string whole = folder.read("a.hdr");
  EXPECT_NO_THROW(readImage(folder / "a.hdr"));
  for (std::size_t length = 12; length < whole.size(); length += 13)
    EXPECT_THROW(readImage(folder.write("cut.hdr", whole.substr(0, length))), Error) << length;
}

// Two pixels above two others; either order of bytes.
TEST(ImageFiles, ReadPortableFloatMaps) {
  const TempFolder folder;
  const std::vector<float> rows = {7, 8, 9, 10, 11, 12, 1, 2, 3, 4, 5, 6};  // the lowest row first
  const std::string little(reinterpret_cast<const char*>(rows.data()), 4 * rows.size());
  std::string big = little;
  for (std::size_t k = 0; k < big.size(); k += 4) std::reverse(&big[k], &big[k] + 4);
  const std::vector<float> wanted = {1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12};
  for (const auto& [head, body] :
       {std::pair<std::string, std::string>("PF\n2 2\n-1.0\n", little), {"PF 2 2 1\n", big}}) {
    folder.write("map.pfm", head + body);
    const ImageF image = readImage(folder / "map.pfm");
    EXPECT_EQ(std::pair(image.width, image.height), std::pair(2, 2));
    EXPECT_EQ(image.rgb, wanted) << head;
    EXPECT_TRUE(readPicture(folder / "map.pfm").light);
  }
  folder.write("grey.pfm", "Pf\n3 1\n-1\n" + little.substr(0, 12));
  EXPECT_EQ(readImage(folder / "grey.pfm").rgb, (std::vector<float>{7, 7, 7, 8, 8, 8, 9, 9, 9}));
  for (const std::string& broken :
       {"PF\n2 2\n-1.0\n" + little.substr(1), std::string("PF"), "PF\n-2 2\n-1\n" + little,
        "PF\n2 2\n-1\n" + little + "x", std::string("PF\n99999999999 1 1\n")}) {
    folder.write("broken.pfm", broken);
    EXPECT_THROW(readImage(folder / "broken.pfm"), Error) << broken.substr(0, 12);
  }
  writePng(folder / "a.png", Image8{1, 1, {1, 2, 3}});
  EXPECT_FALSE(readPicture(folder / "a.png").light);
}

TEST(Exporters, WriteWhatTheyAreGiven) {
  const TempFolder folder;
  const Snapshot room = testing_support::RoomBuilder({}).build();
  const Image8 picture{2, 1, {0, 0, 0, 255, 255, 255}};
  const ImageF radiance{1, 1, {1, 2, 4}};
  const std::vector<Probe> probes = {{{0, 0, 0.9}, {0, 1, 0}}, {{0, 50, 0}, {0, 1, 0}}};
  Diagnostics warnings;
  const ExportSource source{.snapshot = room,
                            .picture = [&]() -> const Image8& { return picture; },
                            .radiance = [&]() -> const ImageF& { return radiance; },
                            .report = [] { return std::string("{}\n"); },
                            .probes = probes,
                            .warn = [&](const Diagnostic& d) { warnings.push_back(d); }};
  std::set<std::string> names;
  for (const Exporter& exporter : exporters()) {
    const std::string name = std::string(exporter.info.key) + std::string(exporter.ending);
    exporter.write(source, folder / name);
    names.insert(name);
  }
  EXPECT_EQ(folder.names(), names);
  ASSERT_EQ(warnings.size(), 1u);
  EXPECT_THAT(warnings[0].message, HasSubstr("1 of 2 probes"));
}

}  // namespace
}  // namespace unshot
