#version 330 core
// The scene's own triangles (core/render/side_pictures.h).

layout(location = 0) in vec3 position;

uniform mat4 view_projection;

void main() { gl_Position = view_projection * vec4(position, 1.0); }
