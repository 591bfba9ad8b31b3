#version 330 core
// The tone curve `logarithmic` of core/base/tone.cpp: from exposed light, where about 1 is white, to linear values of a display, 0..1.
float luminance(vec3 c);  // of colour.glsl, which the picture brings

vec3 toneMap(vec3 c) {
  c = clamp(c, 0.0, 1e4);
  float y = luminance(c);
  if (y <= 0.0) return vec3(0.0);
  return min(c * (pow(clamp(1.0 + log(y) / (3.0 * log(10.0)), 0.0, 1.0), 2.2) / y), 1.0);
}
