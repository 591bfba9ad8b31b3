#version 330 core
// The tone curve `clamp` of core/base/tone.cpp: from exposed light, where about 1 is white, to linear values of a display, 0..1.

vec3 toneMap(vec3 c) { return clamp(c, 0.0, 1.0); }
