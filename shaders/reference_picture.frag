#version 330 core
// The picture of the scene beside or against one that was loaded (app/viewer/reference_picture.h). In alpha: whether the two
// are compared here.
#include "colour.glsl"
#include "difference.glsl"

vec3 toneMap(vec3 c);  // of one of the tone curves (tone_*.frag)

uniform sampler2D ours;       // as displayed, as large as the picture
uniform sampler2D reference;  // linear, fitted by its height
uniform vec2 size;            // of the picture [px]
uniform float across;         // widths of the reference in that of the picture
uniform vec3 background;      // of ours, as displayed
uniform float exposure;
uniform bool light;           // in the reference; else it holds values of a display
uniform float wipe;           // column from which on the reference is shown [px]
uniform bool difference;

out vec4 pixel;

vec3 linearFromSrgb(vec3 c) {
  return mix(c / 12.92, pow((c + 0.055) / 1.055, vec3(2.4)), step(0.04045, c));
}

void main() {
  vec3 mine = texelFetch(ours, ivec2(gl_FragCoord.xy), 0).rgb;
  vec2 at = gl_FragCoord.xy / size;
  at.x = 0.5 + (at.x - 0.5) * across;
  if (at.x < 0.0 || at.x > 1.0) {
    pixel = vec4(difference ? vec3(0.1) : mine, 0.0);
    return;
  }
  vec3 theirs = max(texture(reference, at).rgb, 0.0);
  // Nothing in either, whose two ways to show it do not count.
  bool nothing = theirs == vec3(0.0) && all(lessThan(abs(mine - background), vec3(0.002)));
  theirs = light ? toneMap(min(theirs * exposure, vec3(1e4))) : min(theirs, 1.0);
  vec3 shown = gl_FragCoord.x < wipe ? mine : srgbFromLinear(theirs);
  if (difference) {
    // What is displayed has steps of 1 / 255: less than one is no difference.
    float off = luminance(linearFromSrgb(mine) - theirs),
          step_size = luminance(linearFromSrgb(mine + 0.5 / 255.0) - linearFromSrgb(max(mine - 0.5 / 255.0, 0.0)));
    shown = srgbFromLinear(differenceColour(sign(off) * max(abs(off) - step_size, 0.0)));
  }
  if (difference && nothing) shown = vec3(0.1);
  pixel = vec4(shown, nothing ? 0.0 : 1.0);
}
