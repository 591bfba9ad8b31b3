#version 330 core
// Item buffer: which surface and side a pixel sees, where on its chart, and how far away.
in vec3 relative;
in vec2 chart_position;
flat in uint surface_id;

uniform float inverse_far;

layout(location = 0) out uvec2 item;  // (surface << 1 | back, u | v << 16, in 1/65536 of the chart)

void main() {
  uvec2 quantised = uvec2(clamp(chart_position, 0.0, 1.0) * 65535.99);
  item = uvec2(surface_id << 1u | (gl_FrontFacing ? 0u : 1u), quantised.x | quantised.y << 16u);
  // Distance itself as depth: no precision is lost between a near wall and a far one.
  gl_FragDepth = length(relative) * inverse_far;
}
