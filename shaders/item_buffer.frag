#version 330 core
// Item buffer: which surface and side a pixel sees, where on its chart, and how far away.
in vec3 relative;
in vec2 chart_position;
in vec3 outline_heights;
flat in uint surface_id;

uniform float inverse_far;
uniform float tie_margin;  // this near to its outline a surface may win the depth test against one it ends at [m]

layout(location = 0) out uvec2 item;  // (tie << 31 | surface << 1 | back, u | v << 16, in 1/65536 of the chart)

void main() {
  uvec2 quantised = uvec2(clamp(chart_position, 0.0, 1.0) * 65535.99);
  uint tie = min(min(outline_heights.x, outline_heights.y), outline_heights.z) < tie_margin ? 0x80000000u : 0u;
  item = uvec2(tie | surface_id << 1u | (gl_FrontFacing ? 0u : 1u), quantised.x | quantised.y << 16u);
  // Distance itself as depth: no precision is lost between a near wall and a far one.
  gl_FragDepth = length(relative) * inverse_far;
}
