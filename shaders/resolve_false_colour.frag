#version 330 core
// resolve.frag: luminance as a scale of colours, with isolines (core/render/false_colour.h).
float luminance(vec3 c);  // of colour.glsl, which resolve.frag brings

uniform sampler2D samples;
uniform float exposure;
uniform bool logarithmic;    // by decades, else from 0 on
uniform vec3 ramp[7];        // colours of the scale, linear
uniform float isolines[16];  // places on the scale, ascending
uniform int isoline_count;

float placeOf(vec4 s) {
  float share = luminance(s.rgb) * exposure;
  return clamp(logarithmic ? 1.0 + log(max(share, 1e-30)) / (3.0 * log(10.0)) : share, 0.0, 1.0);
}

// Whether an isoline passes between two neighbours on one surface; what jumps by more than a line has another reason.
bool crosses(float a, float b) {
  int between = 0;
  for (int k = 0; k < isoline_count; ++k) between += int((a < isolines[k]) != (b < isolines[k]));
  return between == 1;
}

vec3 colourOf(ivec2 at, vec4 s) {
  float place = placeOf(s);
  int below = min(int(place * 6.0), 5);
  vec3 c = mix(ramp[below], ramp[below + 1], place * 6.0 - float(below));
  if (s.a == 0.0) return c;  // the sky
  ivec2 last = textureSize(samples, 0) - 1;
  for (int k = 0; k < 2; ++k) {
    vec4 next = texelFetch(samples, min(at + ivec2(1 - k, k), last), 0);
    if (next.a == s.a && crosses(place, placeOf(next))) return place < 0.6 ? mix(c, vec3(1.0), 0.45) : 0.3 * c;
  }
  return c;
}
