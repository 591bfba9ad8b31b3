#version 330 core
// One display mode's quantity, linear, and the class of the pixel in alpha (core/render/exposure.h).

in vec4 shown;

out vec4 pixel;

void main() { pixel = vec4(max(shown.rgb, 0.0), round(shown.a)); }
