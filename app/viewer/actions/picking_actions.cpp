// Actions: the picked point and the probes.
#include "viewer/actions/action_groups.h"

#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>

#include <array>

#include "viewer/actions/action_arguments.h"
#include "viewer/viewer.h"

namespace unshot {

std::span<const Action> pickingActions() {
  static constexpr auto kActions = std::to_array<Action>({
      {"pick",
       "X,Y",
       "Pick what is there in the picture, from 0,0 (left, top) to 1,1 (or click it)",
       {},
       [](Viewer& v, const std::string& a) {
         const std::vector<double> at = numbersOf(a);
         v.pick({at[0], at[1]});
       },
       checkPlace,
       true},
      {"pin-probe",
       "",
       "Keep the picked point as a probe",
       {GLFW_KEY_P, false, "P"},
       [](Viewer& v, const std::string&) { v.pinProbe(); }},
      {"save-probes",
       "[PATH]",
       "Write the probes and their B as CSV",
       {},
       [](Viewer& v, const std::string& a) { v.saveProbes(a); },
       nullptr,
       true},
      {"unpin-probe",
       "N",
       "Give up the Nth probe",
       {},
       [](Viewer& v, const std::string& a) { v.unpinProbe(whole(a) - 1); },
       checkWhole<1, 1'000'000>},
      {"clear-probes", "", "Give up all probes", {}, [](Viewer& v, const std::string&) { v.clearProbes(); }},
      {"copy-values",
       "",
       "Copy all values of the picked point",
       {GLFW_KEY_C, true, "Ctrl+C"},
       [](Viewer& v, const std::string&) { v.copyValues(); },
       nullptr,
       true},
      {"focus-picked",
       "",
       "Look at the picked point and orbit around it",
       {GLFW_KEY_C, false, "C"},
       [](Viewer& v, const std::string&) { v.focusPicked(); },
       nullptr,
       true},
      {"unpick", "", "Pick nothing", {}, [](Viewer& v, const std::string&) { v.unpick(); }},
  });
  return kActions;
}

}  // namespace unshot
