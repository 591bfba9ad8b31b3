#version 330 core
// Linear samples to the display: exposure and tone curve per sample, then the mean over the samples of a pixel, so that the
// edge of a lamp is as smooth as any other. The second output is the linear mean itself.
#include "colour.glsl"
#include "tone.glsl"

uniform sampler2D samples;
uniform int factor;           // samples along a pixel's side
uniform ivec2 origin;         // of the viewport in the target
uniform float exposure;
uniform int tone_curve;       // in core/base/tone.cpp; -1: none, 1 is white
uniform vec3 background;      // linear values of the display
uniform vec3 sky;             // linear, where the picture shows light and there is a sky behind it; else 0
uniform float edge_strength;  // 0..1
uniform int false_colour;     // 0: none, 1: from 0 on, 2: by decades (core/render/false_colour.h)
uniform vec3 ramp[7];         // colours of its scale, linear
uniform float isolines[16];   // places on the scale, ascending
uniform int isoline_count;

layout(location = 0) out vec4 displayed;
layout(location = 1) out vec4 linear;

float placeOf(vec4 s) {
  float share = luminance(s.rgb) * exposure;
  return clamp(false_colour == 1 ? share : 1.0 + log(max(share, 1e-30)) / (3.0 * log(10.0)), 0.0, 1.0);
}

// Whether an isoline passes between two neighbours on one surface; what jumps by more than a line has another reason.
bool crosses(float a, float b) {
  int between = 0;
  for (int k = 0; k < isoline_count; ++k) between += int((a < isolines[k]) != (b < isolines[k]));
  return between == 1;
}

vec3 falseColour(ivec2 at, vec4 s) {
  float place = placeOf(s);
  int below = min(int(place * 6.0), 5);
  vec3 c = mix(ramp[below], ramp[below + 1], place * 6.0 - float(below));
  ivec2 last = textureSize(samples, 0) - 1;
  for (int k = 0; k < 2; ++k) {
    vec4 next = texelFetch(samples, min(at + ivec2(1 - k, k), last), 0);
    if (next.a == s.a && crosses(place, placeOf(next))) return place < 0.6 ? mix(c, vec3(1.0), 0.45) : 0.3 * c;
  }
  return c;
}

vec3 display(ivec2 at, vec4 s) {
  if (false_colour != 0 && s.a != 0.0) return falseColour(at, s);
  if (s.a == 0.0) {
    if (sky == vec3(0.0)) return background;
    s.rgb = sky;
  }
  vec3 exposed = min(s.rgb * exposure, vec3(1e4));
  vec3 c = tone_curve >= 0 ? toneMap(tone_curve, exposed) : min(exposed, 1.0);
  // Edges darken what is light and lighten what is dark.
  if (s.a == 3.0) c = mix(c, 0.25 * c + 0.04, edge_strength);
  return c;
}

void main() {
  ivec2 first = factor * (ivec2(gl_FragCoord.xy) - origin);
  vec3 display_sum = vec3(0.0);
  vec3 linear_mean = vec3(0.0);
  float weight = 1.0 / float(factor * factor);
  for (int y = 0; y < factor; ++y) {
    for (int x = 0; x < factor; ++x) {
      vec4 s = texelFetch(samples, first + ivec2(x, y), 0);
      display_sum += display(first + ivec2(x, y), s);
      linear_mean += weight * (s.a == 0.0 ? sky : s.rgb);
    }
  }
  displayed = vec4(srgbFromLinear(weight * display_sum), 1.0);
  linear = vec4(linear_mean, 1.0);
}
