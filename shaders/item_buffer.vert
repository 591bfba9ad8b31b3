#version 330 core
// The scene's own polygons for a hemicube's item buffer: chart position and surface go through to the pixels.
layout(location = 0) in vec3 position;  // scene frame [m]
layout(location = 1) in vec2 chart;     // 0..1 over the surface's chart
layout(location = 2) in uint surface;
layout(location = 3) in vec3 heights;  // over the triangle's edges [m]; large where the edge is not the surface's outline

uniform vec3 eye;
uniform mat4 view_projection;  // about the eye
uniform uint own_surface;      // lies in the horizon of the eye and is never seen

out vec3 relative;
out vec2 chart_position;
out vec3 outline_heights;
flat out uint surface_id;

void main() {
  relative = position - eye;
  chart_position = chart;
  outline_heights = heights;
  surface_id = surface;
  gl_Position = surface == own_surface ? vec4(0.0, 0.0, 2.0, 1.0) : view_projection * vec4(relative, 1.0);
}
