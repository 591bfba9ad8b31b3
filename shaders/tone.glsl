// From linear light to the display, shared by the window and pictures: the curves of core/base/tone.cpp, by their numbers
// there. Needs colour.glsl.

const float kKnee = 0.6;
const float kLargest = 1e4;

vec3 shoulder(vec3 x) {
  vec3 over = max(x - kKnee, 0.0);
  return mix(x, kKnee + (1.0 - kKnee) * over / (over + (1.0 - kKnee)), step(kKnee, x));
}

// The shoulder acts on the largest channel, so that the hue stays; far above the knee it acts on each channel, so that lamps
// go to white.
vec3 softShoulder(vec3 c) {
  float largest = max(c.r, max(c.g, c.b));
  if (largest <= kKnee) return c;
  vec3 same_hue = c * (shoulder(vec3(largest)).r / largest);
  return mix(same_hue, shoulder(c), smoothstep(0.0, 1.0, 1.0 - kKnee / largest));
}

// `c` is exposed: about 1 is white. Linear values of the display, 0..1.
vec3 toneMap(int curve, vec3 c) {
  c = clamp(c, 0.0, kLargest);
  if (curve == 0) return softShoulder(c);
  if (curve == 1) return min(c, 1.0);
  if (curve == 2) {
    c *= 2.0;
    float y = luminance(c);
    return min(c * ((1.0 + y / 64.0) / (1.0 + y)), 1.0);
  }
  if (curve == 3) return clamp(c * (2.51 * c + 0.03) / (c * (2.43 * c + 0.59) + 0.14), 0.0, 1.0);
  float y = luminance(c);
  if (y <= 0.0) return vec3(0.0);
  return min(c * (pow(clamp(1.0 + log(y) / (3.0 * log(10.0)), 0.0, 1.0), 2.2) / y), 1.0);
}
