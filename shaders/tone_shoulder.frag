#version 330 core
// The tone curve `shoulder` of core/base/tone.cpp: from exposed light, where about 1 is white, to linear values of a display, 0..1.
// The shoulder acts on the largest channel, so that the hue stays; far above the knee it acts on each channel, so that lamps
// go to white.

const float kKnee = 0.6;

vec3 shoulder(vec3 x) {
  vec3 over = max(x - kKnee, 0.0);
  return mix(x, kKnee + (1.0 - kKnee) * over / (over + (1.0 - kKnee)), step(kKnee, x));
}

vec3 toneMap(vec3 c) {
  c = clamp(c, 0.0, 1e4);
  float largest = max(c.r, max(c.g, c.b));
  if (largest <= kKnee) return c;
  vec3 same_hue = c * (shoulder(vec3(largest)).r / largest);
  return mix(same_hue, shoulder(c), smoothstep(0.0, 1.0, 1.0 - kKnee / largest));
}
