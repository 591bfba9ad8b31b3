// Materials edited in the viewer: by actions, in the panel, back and forth.
#include <gmock/gmock.h>
#include <imgui_internal.h>

#include <set>

#include "gui/support/own_folder.h"
#include "scene/obj_reader.h"
#include "support/live_viewer.h"
#include "viewer/panels/materials_panel.h"

namespace unshot {
namespace {

using testing::HasSubstr;
using testing_support::LiveViewer;

LiveViewer::Options boxToEdit(const std::string& script = {}) {
  LiveViewer::Options options;
  options.scene = std::string(UNSHOT_SOURCE_DIR) + "/assets/cornell_box.obj";
  options.solve.elements = 200;
  options.solve.error = 0.01;
  options.script = script;
  options.width = 1020;
  options.height = 1600;  // all of the panel is in it: what is not cannot be clicked
  return options;
}

const Material& shown(LiveViewer& live, std::string_view name) {
  const std::vector<Material>& materials = live->state().snapshot->mesh->materials;
  return materials.at(live->edits().find(name));
}

bool carriedOut(LiveViewer& live) {
  return live.until([&] {
    return live->edits().materials() == live->state().snapshot->mesh->materials &&
           live->state().phase == SessionPhase::kConverged;
  });
}

double meanIrradiance(LiveViewer& live) {
  double sum = 0;
  for (const glm::vec3& h : live->state().snapshot->irradiance) sum += static_cast<double>(h.x + h.y + h.z);
  return sum / static_cast<double>(live->state().snapshot->irradiance.size());
}

using Materials = testing_support::InOwnFolder;

TEST_F(Materials, ActionsChangeThemWhileTheSolveGoesOn) {
  LiveViewer live(boxToEdit("wait converged\nreflectance red 0.1,0.2,0.7\nemission light 34,24,8\n"));
  ASSERT_TRUE(live.until([&] { return live->scriptDone(); }));
  ASSERT_TRUE(carriedOut(live));
  EXPECT_EQ(shown(live, "red").reflectance, glm::dvec3(0.1, 0.2, 0.7));
  EXPECT_EQ(shown(live, "light").emission, glm::dvec3(34, 24, 8));
  EXPECT_EQ(live->state().epoch, 1u) << "began anew";
  const double bright = meanIrradiance(live);
  live->perform("light", "light off");
  ASSERT_TRUE(carriedOut(live));
  EXPECT_EQ(live->state().stopped_by, "no light");
  EXPECT_EQ(meanIrradiance(live), 0);
  live->perform("light", "light on");
  ASSERT_TRUE(carriedOut(live));
  EXPECT_EQ(shown(live, "light").emission, glm::dvec3(34, 24, 8)) << "as it was switched off";
  EXPECT_NEAR(meanIrradiance(live), bright, 0.01 * bright);  // the error asked for
  EXPECT_FALSE(live->error());
}

TEST_F(Materials, AnyCanBeALight) {
  LiveViewer live(boxToEdit("wait converged\nlight green on\nlight light off\n"));
  ASSERT_TRUE(live.until([&] { return live->scriptDone(); }));
  ASSERT_TRUE(carriedOut(live));
  EXPECT_EQ(shown(live, "green").emission, glm::dvec3(17, 12, 4)) << "as much as the other light";
  EXPECT_GT(meanIrradiance(live), 1);
}

TEST_F(Materials, UndoAndRedoGoStepByStep) {
  LiveViewer live(boxToEdit());
  ASSERT_TRUE(live.untilPhase(SessionPhase::kConverged));
  const std::vector<Material> opened = live->edits().materials();
  EXPECT_FALSE(live->edits().edited());
  live->perform("undo");
  live->perform("reflectance", "red 0.5,0.5,0.5");
  const std::vector<Material> once = live->edits().materials();
  live->perform("emission", "light 1,1,1");
  const std::vector<Material> twice = live->edits().materials();
  live->perform("undo");
  EXPECT_EQ(live->edits().materials(), once);
  live->perform("undo");
  EXPECT_EQ(live->edits().materials(), opened);
  EXPECT_FALSE(live->edits().canUndo());
  live->perform("redo");
  live->perform("redo");
  EXPECT_EQ(live->edits().materials(), twice);
  EXPECT_FALSE(live->edits().canRedo());
  live->perform("reset-materials");
  EXPECT_EQ(live->edits().materials(), opened);
  live->perform("undo");
  EXPECT_EQ(live->edits().materials(), twice);
  ASSERT_TRUE(carriedOut(live));
  // With another scene all of it is gone.
  live->perform("open", (std::filesystem::path(UNSHOT_SOURCE_DIR) / "assets/two_patches.obj").string());
  ASSERT_TRUE(live.until([&] { return live->state().epoch == 2; }));
  EXPECT_FALSE(live->edits().canUndo());
  EXPECT_FALSE(live->edits().edited());
}

TEST_F(Materials, ADragIsUndoneAsOne) {
  MaterialEdits edits;
  edits.begin({{"wall", glm::dvec3(0.5), {}}});
  for (const double x : {0.1, 0.2, 0.3}) edits.setReflectance(0, glm::dvec3(x), 7.5);
  edits.setReflectance(0, glm::dvec3(0.4), 9.0);
  edits.undo();
  EXPECT_EQ(edits.materials()[0].reflectance, glm::dvec3(0.3));
  edits.undo();
  EXPECT_EQ(edits.materials()[0].reflectance, glm::dvec3(0.5));
}

TEST_F(Materials, WhatCannotBeIsSaidAndChangesNothing) {
  LiveViewer live(boxToEdit());
  ASSERT_TRUE(live.untilPhase(SessionPhase::kConverged));
  for (const auto& [action, argument, message] :
       {std::array<std::string, 3>{"reflectance", "red 0.5,0.5,1.5", "r,g,b from 0 on to 1"},
        {"reflectance", "brown 0.5,0.5,0.5", "one of: white, light, green, red"},
        {"emission", "light -1,0,0", "r,g,b from 0 on"},
        {"light", "light", "on or off"}}) {
    live->perform(action, argument);
    ASSERT_TRUE(live->error()) << action;
    EXPECT_THAT(live->error()->fullText(), HasSubstr(message));
    live->perform("dismiss");
  }
  EXPECT_FALSE(live->edits().edited());
}

TEST_F(Materials, OfASceneThatIsBeingOpenedAreNotEditedBlindly) {
  LiveViewer live(boxToEdit());
  ASSERT_TRUE(live.untilPhase(SessionPhase::kConverged));
  live->perform("reflectance", "red 0.5,0.5,0.5");
  live->perform("open", (std::filesystem::path(UNSHOT_SOURCE_DIR) / "assets/two_patches.obj").string());
  live->perform("undo");
  ASSERT_TRUE(live->error());
  EXPECT_THAT(live->error()->what(), HasSubstr("being opened"));
  live->perform("dismiss");
  ASSERT_TRUE(live.until([&] { return live->state().facts->scene_name == "two_patches"; }));
  EXPECT_FALSE(live->edits().canUndo());
  // One that cannot be opened leaves all as it was.
  live->perform("reflectance", "floor 0.5,0.5,0.5");
  live->perform("open", "missing.obj");
  ASSERT_TRUE(live.until([&] { return live->error().has_value(); }));
  live->perform("dismiss");
  EXPECT_TRUE(live->edits().canUndo());
  live->perform("undo");
  EXPECT_FALSE(live->error());
  EXPECT_FALSE(live->edits().edited());
}

TEST_F(Materials, AreSavedAsTheyAreShown) {
  const std::string file = folder_ / "edited.mtl";
  LiveViewer live(boxToEdit("wait converged\nreflectance red 0.1,0.2,0.7\nsave-materials " + file + "\n"));
  ASSERT_TRUE(live.until([&] { return live->scriptDone(); }));
  // The scene with this file in the place of its own is the same.
  std::filesystem::copy_file(std::filesystem::path(UNSHOT_SOURCE_DIR) / "assets/cornell_box.obj",
                             folder_.path() / "cornell_box.obj");
  std::filesystem::rename(file, folder_.path() / "cornell_box.mtl");
  const std::vector<Material> read = readObj(folder_.path() / "cornell_box.obj").materials;
  ASSERT_EQ(read.size(), live->edits().materials().size());
  for (std::size_t m = 0; m < read.size(); ++m) {
    const Material& saved = live->edits().materials()[m];
    EXPECT_EQ(read[m].name, saved.name);
    for (int c = 0; c < 3; ++c) {
      EXPECT_DOUBLE_EQ(read[m].reflectance[c], saved.reflectance[c]);  // the reader rounds by itself
      EXPECT_DOUBLE_EQ(read[m].emission[c], saved.emission[c]);
    }
  }
}

// Another scene, the same one read again, the window's end: none of them costs what was made by hand.
TEST_F(Materials, ThatWereEditedAreWrittenBeforeTheyGo) {
  LiveViewer live(boxToEdit());
  ASSERT_TRUE(live.untilPhase(SessionPhase::kConverged));
  live->perform("reflectance", "red 0.125,0.25,0.75");
  live->perform("open", (std::filesystem::path(UNSHOT_SOURCE_DIR) / "assets/two_patches.obj").string());
  ASSERT_TRUE(live.until([&] { return live->state().epoch == 2 && live->upToDate(); }));
  EXPECT_EQ(folder_.names(), std::set<std::string>{"unshot-cornell_box-001.mtl"});
  EXPECT_THAT(folder_.read("unshot-cornell_box-001.mtl"), HasSubstr("Kd 0.125 0.25 0.75"));
  EXPECT_THAT(live->messages().lines(), testing::Contains(HasSubstr("unshot-cornell_box-001.mtl")));
  live->perform("light", "floor on");
  live->perform("reload");
  ASSERT_TRUE(live.until([&] { return live->state().epoch == 3 && live->upToDate(); }));
  EXPECT_TRUE(folder_.has("unshot-two_patches-001.mtl"));
  live->perform("emission", "floor 0.5,0.5,0.5");
  testing::internal::CaptureStderr();
  live->finish();
  EXPECT_THAT(testing::internal::GetCapturedStderr(), HasSubstr(folder_ / "unshot-two_patches-002.mtl"));
  EXPECT_THAT(folder_.read("unshot-two_patches-002.mtl"), HasSubstr("Ke 0.5 0.5 0.5"));
  EXPECT_EQ(folder_.names().size(), 3u);
  EXPECT_EQ(live->exitCode(), 0);
}

TEST_F(Materials, ThatAreAtHandAnywayAreNotWritten) {
  {  // by whoever wrote the script
    LiveViewer live(
        boxToEdit("wait converged\nreflectance red 0.1,0.2,0.7\nreload\nwait converged\n"
                  "reflectance red 0.1,0.2,0.7\n"));
    ASSERT_TRUE(live.until([&] { return live->scriptDone(); }));
    EXPECT_TRUE(live->edits().edited());
    live->finish();
  }
  EXPECT_EQ(folder_.names(), std::set<std::string>{});
  LiveViewer live(boxToEdit());
  ASSERT_TRUE(live.untilPhase(SessionPhase::kConverged));
  live->perform("reflectance", "red 0.1,0.2,0.7");
  live->perform("restart");  // goes on with them
  ASSERT_TRUE(live.until([&] { return live->state().epoch == 2 && live->upToDate(); }));
  live->perform("open", "missing.obj");
  ASSERT_TRUE(live.until([&] { return live->error().has_value(); }));
  EXPECT_EQ(folder_.names(), std::set<std::string>{}) << "nothing was lost";
  live->perform("save-materials", "mine.mtl");
  live->perform("reload");
  ASSERT_TRUE(live.until([&] { return live->state().epoch == 3 && live->upToDate(); }));
  live->perform("reflectance", "red 0.1,0.2,0.7");
  live->perform("undo");
  live->finish();
  EXPECT_EQ(folder_.names(), std::set<std::string>{"mine.mtl"});
}

TEST_F(Materials, TheLightInThePanelIsSwitched) {
  LiveViewer live(boxToEdit("wait converged\nmaterials on\n"));
  ASSERT_TRUE(live.until([&] { return live->scriptDone(); }));
  live->ui().material = live->edits().find("light");
  live.draw();
  live.draw();
  char name[32];
  std::snprintf(name, sizeof name, "panel/sections_%08X",
                ImGui::FindWindowByName("panel")->GetID("sections"));
  ImGui::ActivateItem(ImHashStr("##light", 0, ImGui::FindWindowByName(name)->ID));
  for (int frame = 0; frame < 3; ++frame) {
    live->input();
    live.draw();
  }
  EXPECT_FALSE(live->edits().materials()[live->ui().material].emits());
  ASSERT_TRUE(carriedOut(live));
  EXPECT_EQ(live->state().stopped_by, "no light");
}

TEST_F(Materials, WhatIsPickedIsTheOneToBeChanged) {
  LiveViewer live(boxToEdit("wait converged\n"));
  ASSERT_TRUE(live.until([&] { return live->scriptDone() && live->nextFrame(0) > 1e30; }));
  std::set<std::string> picked;
  for (const char* at : {"0.1,0.5", "0.3,0.5", "0.5,0.45", "0.5,0.5", "0.7,0.5", "0.9,0.5"}) {
    live->perform("unpick");
    live->perform("pick", at);
    for (int frame = 0; frame < 3; ++frame) live.draw();
    if (!live->picking().picked()) continue;
    const Mesh& mesh = *live->state().snapshot->mesh;
    const std::uint32_t material = mesh.surfaces[live->picking().picked()->pick.surface].material;
    EXPECT_EQ(live->ui().material, material) << at;
    picked.insert(mesh.materials[material].name);
  }
  EXPECT_GE(picked.size(), 2u) << "one material alone says nothing";
}

// What is remembered stays comparable, since the mesh is the same.
TEST_F(Materials, TheLightBeforeAnEditCanBeComparedWith) {
  LiveViewer live(boxToEdit("wait converged\nremember\nreflectance red 0.1,0.2,0.7\nwait converged\n"));
  ASSERT_TRUE(live.until([&] { return live->scriptDone(); }));
  ASSERT_TRUE(carriedOut(live));
  EXPECT_TRUE(live->ui().settings.view.reference);
}

}  // namespace
}  // namespace unshot
