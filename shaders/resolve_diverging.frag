#version 330 core
// resolve.frag: the luminance of signed values as a scale of colours to both sides of 0 (core/render/false_colour.h).
float luminance(vec3 c);  // of colour.glsl, which resolve.frag brings

uniform float exposure;
uniform bool logarithmic;  // by decades, else from 0 on
uniform vec3 ramps[8];     // colours of the scale, linear: from 0 up, then from 0 down

vec3 colourOf(ivec2 at, vec4 s) {
  float share = luminance(s.rgb) * exposure;
  float place = 3.0 * clamp(logarithmic ? 1.0 + log(max(share, 1e-30)) / (3.0 * log(10.0)) : share, 0.0, 1.0);
  int step_below = min(int(place), 2), below = step_below + (s.a == 4.0 ? 4 : 0);
  return mix(ramps[below], ramps[below + 1], place - float(step_below));
}
