#include "viewer/window_words.h"

#include <array>
#include <string_view>

namespace unshot {
namespace {

struct Words {
  std::string_view given, shown;
};

// Longer ones before those that are a part of them.
constexpr std::array kWords = {
    Words{"--bounces N (or --max-shots N) for the light of a number of bounces",
          "the light of a number of bounces: section Bounces, or the action bounces N"},
    Words{"--sky r,g,b for another, --sky 0,0,0 for none",
          "the chooser Sky in the section Scene, or the action sky r,g,b; sky 0,0,0 for none"},
    Words{"no --mode, or no --bounces", "no number of bounces when the program is started"},
    Words{"another --mode or --form-factors", "another Iteration or other Form factors in the section Solve"},
    Words{"--form-factors auto", "Form factors: Automatic, in the section Solve"},
    Words{"--form-factors hemicube", "the form factors of hemicubes, in the section Solve"},
    Words{"fewer --elements", "fewer Elements in the section Mesh"},
    Words{"--emit front or many --elements",
          "Lights: front alone, in the section Scene, or many Elements in the section Mesh"},
    Words{"with --emit front", "where the front of lights alone emits, section Scene"},
    Words{"fewer elements (--elements)", "fewer Elements in the section Mesh"},
    Words{"a larger --element-size, or --elements", "fewer Elements in the section Mesh"},
    Words{"--element-size", "sizes of elements"},
    Words{"(--elements ", "(Elements in the section Mesh: about "},
    Words{"(--keep)", "(the action keep)"},
    Words{"--keep ", "the action keep "},
    Words{"another provider (--gl)", "another provider of OpenGL, chosen when the program is started"},
    Words{"what was saved with --save goes on with --resume",
          "what was saved goes on when the program is started with it"},
    Words{"unshot solve --ply", "unshot solve"},
    Words{"a smaller --size", "a smaller window"},
    Words{"another --eye or --at", "another camera"},
    Words{"--fov 40", "the action fov 40"},
    Words{"--error 0.01", "the action error 0.01"},
    Words{"a smaller --error", "a smaller error at \"Stop at\" in the section Solve"},
    Words{"--max-seconds ", "a limit, when the program is started, of so many seconds: "},
    Words{"--mode gmres", "Iteration: GMRES, in the section Solve"},
    Words{"a --sky", "a Sky in the section Scene"},
    Words{"W/m^2", "W/m\u00b2"}};

}  // namespace

std::string windowWords(std::string text) {
  for (const Words& words : kWords) {
    for (std::size_t at = 0; (at = text.find(words.given, at)) != std::string::npos; at += words.shown.size())
      text.replace(at, words.given.size(), words.shown);
  }
  return text;
}

Error inWindowWords(const Error& error) {
  return Error(error.kind(), windowWords(error.what()), error.where(), windowWords(error.advice()));
}

}  // namespace unshot
