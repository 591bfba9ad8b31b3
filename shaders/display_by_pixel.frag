#version 330 core
// What cannot be worked out at vertices: light by element, signed light, lines. Else as display.frag.
#include "colour.glsl"

in vec3 vertex_irradiance;
in vec3 vertex_ambient;
in vec3 vertex_extra;
flat in vec3 reflectance;
flat in vec3 emission;

uniform int quantity;  // enum Quantity
uniform bool diverging;  // signed values: their size, and the sign in the class
uniform float per_mean;  // of differences: 1 over the mean reflected light of the reference
uniform bool per_element;
uniform bool edges;
uniform int first_triangle;  // of this draw
uniform usamplerBuffer triangle_elements;
uniform samplerBuffer element_irradiance;

out vec4 pixel;

const vec3 kNegative = vec3(0.15, 0.35, 1.0);  // the hue of what is below 0

void main() {
  vec3 received = vertex_irradiance;
  if (per_element) {
    uint element = texelFetch(triangle_elements, first_triangle + gl_PrimitiveID).r;
    received = texelFetch(element_irradiance, int(element)).rgb;
  }
  received += vertex_ambient;
  vec3 shown = emission + reflectance * received;
  bool lamp = false, negative = false;
  if (quantity == 0) {
    lamp = any(greaterThan(emission, vec3(0.0)));
  } else if (quantity == 1) {
    shown = received;
  } else if (quantity == 7) {
    float relative = luminance(reflectance * received - vertex_extra) * per_mean;
    negative = relative < 0.0;
    shown = vec3(abs(relative));
  } else if (quantity == 8) {
    shown = received * vertex_extra;
  } else if (quantity == 2 || quantity >= 5) {
    float y = luminance(vertex_extra);
    negative = diverging && y < 0.0;
    shown = diverging ? vec3(abs(y)) : y < 0.0 ? -y * kNegative : vertex_extra;
  } else if (quantity == 3) {
    shown = emission;
  } else {
    shown = reflectance;
  }
  pixel = vec4(max(shown, 0.0), edges ? 3.0 : lamp ? 2.0 : negative ? 4.0 : 1.0);
}
