#version 330 core
// The triangles of the panels: positions in pixels, y down (app/viewer/gui_renderer.h).

layout(location = 0) in vec2 position;
layout(location = 1) in vec2 texture_position;
layout(location = 2) in vec4 colour;  // as displayed, straight alpha

uniform vec2 origin;  // of the display, in the units of `position`
uniform vec2 scale;   // from those to the clip space's -1..1

out vec2 vertex_texture_position;
out vec4 vertex_colour;

void main() {
  vertex_texture_position = texture_position;
  vertex_colour = colour;
  gl_Position = vec4((position - origin) * scale + vec2(-1.0, 1.0), 0.0, 1.0);
}
