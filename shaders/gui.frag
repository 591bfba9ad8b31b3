#version 330 core
// A glyph, a picture or a plain area of the panels; values as displayed, straight alpha.

in vec2 vertex_texture_position;
in vec4 vertex_colour;

uniform sampler2D picture;

layout(location = 0) out vec4 displayed;

void main() { displayed = vertex_colour * texture(picture, vertex_texture_position); }
