#version 330 core
// Which side is seen: its index + 1, 0 for none. A side that no light can reach is not there, but where that is so of both
// the surface hides what is behind it.

uniform usamplerBuffer triangle_sides;  // per triangle: front, back, as index + 1 or 0; all bits where neither is lit

out uint id;

void main() {
  uvec2 sides = texelFetch(triangle_sides, gl_PrimitiveID).rg;
  id = gl_FrontFacing ? sides.r : sides.g;
  if (id == 0u) discard;
  if (id == 0xFFFFFFFFu) id = 0u;
}
