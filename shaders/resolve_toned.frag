#version 330 core
// resolve.frag: colours as they are, exposed, by one of the tone curves (tone_*.frag).

uniform float exposure;
uniform bool tone_mapped;     // else 1 is white
uniform float edge_strength;  // 0..1

vec3 toneMap(vec3 c);

vec3 colourOf(ivec2 at, vec4 s) {
  vec3 exposed = min(s.rgb * exposure, vec3(1e4));
  vec3 c = tone_mapped ? toneMap(exposed) : min(exposed, 1.0);
  // Edges darken what is light and lighten what is dark.
  return s.a == 3.0 ? mix(c, 0.25 * c + 0.04, edge_strength) : c;
}
