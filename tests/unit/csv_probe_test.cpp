#include <gmock/gmock.h>

#include <cmath>

#include "base/csv_table.h"
#include "base/error.h"
#include "export/probes.h"
#include "support/synthetic_room.h"
#include "support/temp_folder.h"

namespace unshot {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing_support::TempFolder;

std::string messageOf(const TempFolder& folder, const std::string& content) {
  try {
    readProbes(folder.write("points.csv", content));
  } catch (const Error& error) {
    EXPECT_EQ(error.kind(), ErrorKind::kInput);
    return error.fullText();
  }
  return "no Error";
}

TEST(CsvTable, ReadsCommentsHeaderAndBlankLines) {
  const TempFolder folder;
  const CsvTable table = readCsv(folder.write("t.csv", "# note\r\n\na, b ,c\r\n1,,text\n\n 2 ,3,x"));
  EXPECT_THAT(table.header, ElementsAre("a", "b", "c"));
  ASSERT_EQ(table.rows.size(), 2u);
  EXPECT_THAT(table.lines, ElementsAre(4u, 6u));
  EXPECT_EQ(table.number(0, 0), 1);
  EXPECT_EQ(table.number(0, 1), std::nullopt);
  EXPECT_EQ(table.number(1, *table.column("b")), 3);
  EXPECT_THROW(table.number(0, 2), Error);
}

TEST(CsvTable, ShortestTextReadsBackAsTheSameNumber) {
  EXPECT_EQ(shortest(0.1), "0.1");
  EXPECT_EQ(shortest(0.1f), "0.1");
  EXPECT_EQ(shortest(-3.0), "-3");
}

TEST(Probes, ReadsPointsWithAndWithoutHeader) {
  const TempFolder folder;
  const std::string plain = folder.write("a.csv", "1,2,3,0,2,0\n");
  const std::string named = folder.write("b.csv", "x,y,z,nx,ny,nz,more\n# comment\n1,2,3,0,2,0,9\n");
  for (const std::string& file : {plain, named}) {
    const std::vector<Probe> probes = readProbes(file);
    ASSERT_EQ(probes.size(), 1u);
    EXPECT_EQ(probes[0].position, glm::dvec3(1, 2, 3));
    EXPECT_EQ(probes[0].normal, glm::dvec3(0, 2, 0));
  }
}

TEST(Probes, NamesTheLineOfBadInput) {
  const TempFolder folder;
  EXPECT_THAT(messageOf(folder, "1,2,3,0,1,0\n1,2,x,0,1,0\n"),
              HasSubstr("points.csv:2: 'x' is not a number"));
  EXPECT_THAT(messageOf(folder, "1,2,3,0,1,0\n1,2,3\n"), HasSubstr("points.csv:2: there are 3 values"));
  EXPECT_THAT(messageOf(folder, "1,2,3\n"), HasSubstr("points.csv:1: a probe needs six values"));
  EXPECT_THAT(messageOf(folder, "1,2,3,0,0,0\n"), HasSubstr("points.csv:1: the normal"));
  EXPECT_THAT(messageOf(folder, "1,2,,0,1,0\n"), HasSubstr("points.csv:1: value 3 is missing"));
  EXPECT_THAT(messageOf(folder, "1,2,nan,0,1,0\n1,inf,2,0,1,0\n"), HasSubstr("points.csv:1: value 3"));
  EXPECT_THAT(messageOf(folder, "# nothing\n"), HasSubstr("no probes"));
  EXPECT_THAT(messageOf(folder, ""), HasSubstr("empty"));
  EXPECT_THAT(messageOf(folder, std::string("1,2\0,3", 6)), HasSubstr("not a text file"));
}

/// A probe in file coordinates for a point of the room's own frame.
Probe probeAt(const Snapshot& snapshot, const glm::dvec3& point, const glm::dvec3& normal) {
  return {point + snapshot.mesh->frame_origin, normal};
}

TEST(Probes, InterpolateWithinTheDisplayTriangle) {
  const Snapshot room = testing_support::RoomBuilder({.frame_origin = {1000, -200, 30}}).build();
  const Mesh& mesh = *room.mesh;
  std::vector<Probe> probes;
  std::vector<glm::dvec3> expected;
  for (std::size_t k = 0; k + 2 < mesh.triangle_vertices.size(); k += 3) {
    const glm::dvec3 weights(0.2, 0.5, 0.3);
    glm::dvec3 point(0), b(0);
    for (int c = 0; c < 3; ++c) {
      const std::uint32_t v = mesh.triangle_vertices[k + static_cast<std::size_t>(c)];
      point += weights[c] * glm::dvec3(mesh.vertices[v].position);
      b += weights[c] * radiosity(room, v, false);
    }
    probes.push_back(probeAt(room, point, mesh.vertices[mesh.triangle_vertices[k]].normal));
    expected.push_back(b);
  }
  const auto answers = answerProbes(room, probes, false);
  for (std::size_t k = 0; k < probes.size(); ++k) {
    ASSERT_TRUE(answers[k]) << k;
    EXPECT_LT(glm::length(*answers[k] - expected[k]), 1e-4 * (1 + glm::length(expected[k]))) << k;
  }
}

TEST(Probes, TakeTheSideThatFacesTheNormal) {
  const Snapshot room = testing_support::RoomBuilder({}).build();
  // At the edge of floor and left wall.
  const glm::dvec3 edge(-1, 0, 0.1);
  const std::vector<Probe> probes = {
      probeAt(room, edge, {0, 1, 0}),      probeAt(room, edge, {1, 0, 0}),
      probeAt(room, edge, {0, -1, 0}),     probeAt(room, edge, {0.3, 1, 0}),
      probeAt(room, {0, 1, 0}, {0, 1, 0}), probeAt(room, {-1, 0, 0.1}, {0, 100, 0})};
  const auto answers = answerProbes(room, probes, false);
  ASSERT_TRUE(answers[0] && answers[1]);
  EXPECT_NEAR(answers[0]->x / answers[0]->y, 1, 0.3) << "the floor is white";
  EXPECT_GT(answers[1]->x / answers[1]->y, 5) << "the wall is red";
  EXPECT_EQ(answers[2], glm::dvec3(0.0)) << "the floor from below, where no light is";
  EXPECT_EQ(answers[3], answers[0]) << "a slanted normal";
  EXPECT_FALSE(answers[4]) << "in mid-air";
  EXPECT_EQ(answers[5], answers[0]) << "the length of the normal says nothing";
}

// One by one they look at few triangles, together at all.
TEST(Probes, LieWhereTheyDoAlone) {
  const Snapshot room = testing_support::RoomBuilder({.frame_origin = {1000, -200, 30}}).build();
  const Mesh& mesh = *room.mesh;
  std::vector<Probe> probes;
  for (const Vertex& v : mesh.vertices) probes.push_back(probeAt(room, glm::dvec3(v.position), v.normal));
  for (const Vertex& v : mesh.vertices) probes.push_back(probeAt(room, glm::dvec3(v.position), -v.normal));
  probes.push_back(probeAt(room, {0, 1, 0}, {0, 1, 0}));
  const auto together = answerProbes(room, probes, false);
  for (std::size_t k = 0; k < probes.size(); ++k)
    EXPECT_EQ(answerProbes(room, std::span(&probes[k], 1), false).front(), together[k]) << k;
  EXPECT_EQ(placeProbes(mesh, {}).size(), 0u);
}

TEST(Probes, DarkSidesArePresentAndBlack) {
  Snapshot snapshot;
  auto mesh = std::make_shared<Mesh>();
  mesh->bounds_max = glm::dvec3(1, 1, 0);
  Surface surface;
  surface.extent = {1, 1};
  surface.triangles = {0, 1};
  mesh->surfaces.push_back(surface);
  mesh->triangles.push_back({.uv = {{0, 0}, {1, 0}, {0, 1}}, .position = {0, 1, 2}, .outline = {}});
  snapshot.mesh = mesh;
  const std::vector<Probe> probes = {
      {{0.2, 0.2, 0}, {0, 0, 1}}, {{0.2, 0.2, 0}, {0, 0, -1}}, {{0.9, 0.9, 0}, {0, 0, 1}}};
  const auto answers = answerProbes(snapshot, probes, false);
  EXPECT_EQ(answers[0], glm::dvec3(0.0));
  EXPECT_EQ(answers[1], glm::dvec3(0.0));
  EXPECT_FALSE(answers[2]);
}

TEST(Probes, WrittenAsCsvInTheSameOrder) {
  const std::vector<Probe> probes = {{{1, 2.5, -3}, {0, 2, 0}}, {{0.1, 0, 0}, {1, 0, 0}}};
  const std::vector<std::optional<glm::dvec3>> answers = {glm::dvec3(0.1, 0, 17), std::nullopt};
  EXPECT_EQ(probeCsv(probes, answers),
            "x,y,z,nx,ny,nz,B_r,B_g,B_b\n"
            "1,2.5,-3,0,2,0,0.1,0,17\n"
            "0.1,0,0,1,0,0,,,\n");
}

}  // namespace
}  // namespace unshot
