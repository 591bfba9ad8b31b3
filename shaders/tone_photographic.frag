#version 330 core
// The tone curve `photographic` of core/base/tone.cpp: from exposed light, where about 1 is white, to linear values of a display, 0..1.
float luminance(vec3 c);  // of colour.glsl, which the picture brings

vec3 toneMap(vec3 c) {
  c = 2.0 * clamp(c, 0.0, 1e4);
  float y = luminance(c);
  return min(c * ((1.0 + y / 64.0) / (1.0 + y)), 1.0);
}
