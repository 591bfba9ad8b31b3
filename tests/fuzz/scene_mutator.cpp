// How an input is changed. Of libFuzzer's own changes to bytes few leave a text that reaches the mesh, so
// half of the changes here are to lines and numbers: what comes out is mostly a scene, and an odd one.
#include <algorithm>
#include <array>
#include <cstdint>
#include <cstdio>
#include <random>
#include <string>
#include <vector>

extern "C" std::size_t LLVMFuzzerMutate(std::uint8_t* data, std::size_t size, std::size_t most);

namespace {

using Random = std::minstd_rand;

std::size_t below(Random& random, std::size_t count) { return count == 0 ? 0 : random() % count; }

std::string oddNumber(Random& random) {
  static constexpr std::array kNumbers = {
      "0",        "-0",        "1",    "-1",       "0.5",        "2",     "1e-6",  "1e-9",
      "1.000001", "0.9999999", "1e-3", "1e-40",    "1e30",       "1e150", "1e308", "1e400",
      "nan",      "inf",       "-inf", "100",      "1000",       "1e6",   "3",     "4",
      "0.33333",  "1e-12",     "0.25", "-2",       "5",          "0.1",   "1e7",   "1e-320",
      "+1",       ".5",        "1.",   "00000001", "2147483647", "-3",    "0.999", "1.0000000001"};
  if (random() % 2) return kNumbers[below(random, kNumbers.size())];
  char text[40];
  const double unit = static_cast<double>(random() % 2001) / 1000 - 1;
  std::snprintf(text, sizeof text, "%g", random() % 2 ? unit : static_cast<double>(random() % 7) - 3);
  return text;
}

std::vector<std::string> linesOf(const std::string& text) {
  std::vector<std::string> lines(1);
  for (const char c : text) {
    if (c == '\n') {
      lines.emplace_back();
    } else {
      lines.back() += c;
    }
  }
  return lines;
}

/// Another number in place of a word that looks like one, or the word moved by a little.
void changeNumber(std::string& line, Random& random) {
  std::vector<std::pair<std::size_t, std::size_t>> words;
  for (std::size_t k = 0; k < line.size();) {
    const std::size_t begin = line.find_first_of("+-.0123456789", k);
    if (begin == std::string::npos) break;
    std::size_t end = line.find_first_not_of("+-.0123456789eE", begin);
    if (end == std::string::npos) end = line.size();
    words.emplace_back(begin, end - begin);
    k = end;
  }
  if (words.empty()) return;
  const auto [begin, length] = words[below(random, words.size())];
  line.replace(begin, length, oddNumber(random));
}

std::string newFace(Random& random, std::size_t vertices) {
  std::string face = "f";
  const std::size_t corners = random() % 16 == 0 ? random() % 40 : 3 + random() % 4;
  for (std::size_t k = 0; k < corners; ++k) {
    const auto index = static_cast<long>(1 + below(random, vertices));
    face += " " + std::to_string(random() % 8 == 0 ? -index : index);
  }
  return face;
}

void changeLines(std::vector<std::string>& lines, Random& random) {
  const auto any = [&] { return below(random, lines.size()); };
  const auto at = [&] { return lines.begin() + static_cast<std::ptrdiff_t>(any()); };
  const auto vertices = static_cast<std::size_t>(std::count_if(
      lines.begin(), lines.end(), [](const std::string& line) { return line.rfind("v ", 0) == 0; }));
  switch (random() % 8) {
    case 0:
      std::swap(lines[any()], lines[any()]);
      break;
    case 1:
      lines.insert(at(), std::string(lines[any()]));
      break;
    case 2:
      if (lines.size() > 1) lines.erase(at());
      break;
    case 3:
      lines.insert(at(), "v " + oddNumber(random) + " " + oddNumber(random) + " " + oddNumber(random));
      break;
    case 4:
      lines.insert(at(), newFace(random, vertices));
      break;
    default:
      changeNumber(lines[any()], random);
      break;
  }
}

}  // namespace

extern "C" std::size_t LLVMFuzzerCustomMutator(std::uint8_t* data, std::size_t size, std::size_t most,
                                               unsigned seed) {
  Random random(seed);
  if (random() % 2) return LLVMFuzzerMutate(data, size, most);
  std::vector<std::string> lines = linesOf(std::string(reinterpret_cast<const char*>(data), size));
  for (std::size_t k = 1 + random() % 4; k > 0; --k) changeLines(lines, random);
  std::string text;
  for (std::size_t k = 0; k < lines.size(); ++k) text += (k > 0 ? "\n" : "") + lines[k];
  if (text.size() > most) return LLVMFuzzerMutate(data, size, most);
  std::copy(text.begin(), text.end(), data);
  return text.size();
}
