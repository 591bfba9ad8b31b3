#version 330 core
// The scene's own triangles, each with the side that it belongs to (core/render/automatic_camera.h).

layout(location = 0) in vec3 position;
layout(location = 1) in uint side;

uniform mat4 view_projection;

flat out uint vertex_side;

void main() {
  gl_Position = view_projection * vec4(position, 1.0);
  vertex_side = side;
}
