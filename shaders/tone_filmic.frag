#version 330 core
// The tone curve `filmic` of core/base/tone.cpp: from exposed light, where about 1 is white, to linear values of a display, 0..1.

vec3 toneMap(vec3 c) {
  c = clamp(c, 0.0, 1e4);
  return clamp(c * (2.51 * c + 0.03) / (c * (2.43 * c + 0.59) + 0.14), 0.0, 1.0);
}
