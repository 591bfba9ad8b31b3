#version 330 core
// Linear samples to the display: exposure and colour per sample, then the mean over the samples of a pixel, so that the edge
// of a lamp is as smooth as any other. The second output is the linear mean itself.
#include "colour.glsl"

uniform sampler2D samples;
uniform int factor;       // samples along a pixel's side
uniform ivec2 origin;     // of the viewport in the target
uniform vec3 background;  // linear values of the display
uniform vec3 sky;         // linear, where the picture shows light and there is a sky behind it; else 0

layout(location = 0) out vec4 displayed;
layout(location = 1) out vec4 linear;

// Of the sample `s` at `at`: resolve_toned.frag or resolve_false_colour.frag, linked with this. A software renderer takes the
// time of all branches, whichever is taken.
vec3 colourOf(ivec2 at, vec4 s);

vec3 display(ivec2 at, vec4 s) {
  if (s.a == 0.0) {
    if (sky == vec3(0.0)) return background;
    s.rgb = sky;
  }
  return colourOf(at, s);
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
