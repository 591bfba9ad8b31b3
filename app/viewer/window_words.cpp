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
    Words{"another --mode or --form-factors", "another Iteration or other Form factors in the section Solve"},
    Words{"--form-factors auto", "Form factors: Automatic, in the section Solve"},
    Words{"--form-factors hemicube", "the form factors of hemicubes, in the section Solve"},
    Words{"fewer --elements", "fewer Elements in the section Mesh"},
    Words{"many --elements", "many Elements in the section Mesh"},
    Words{"fewer elements (--elements)", "fewer Elements in the section Mesh"},
    Words{"a smaller --error", "a smaller error at \"Stop at\" in the section Solve"},
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
