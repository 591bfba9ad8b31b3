// How figures look to people: on a terminal and in the window.
#pragma once

#include <cstdint>
#include <glm/vec3.hpp>
#include <string>

namespace unshot {

/// 1234567 as "1,234,567".
std::string countText(std::uint64_t count);
/// To the nearest count.
std::string roundedCountText(double count);
/// 3 significant digits, without an exponent where that is readable: "0.0123", "45.6", "1.2e-08".
std::string figureText(double value);
/// Nine significant digits, for what is pasted elsewhere.
std::string numberText(double value);
/// A fraction as "1.23 %"; below a billionth "0 %".
std::string percentText(double fraction);
/// "1.2 ms", "0.123 s", "12.3 s", "3 min 20 s", "2 h 5 min".
std::string durationText(double seconds);
/// "12.3 MB".
std::string memoryText(double bytes);
/// "5.5 x 5.5 x 5.6".
std::string extentText(const glm::dvec3& extent);
/// "1 face", "2 faces", "1,234 patches" (the plural is given where it is not made with an s).
std::string countedText(std::uint64_t count, const std::string& one, const std::string& many = {});

}  // namespace unshot
