#version 330 core
// One display mode's quantity, linear, and the class of the pixel in alpha (core/render/exposure.h).
#include "colour.glsl"

in vec3 vertex_irradiance;
in vec3 vertex_ambient;
in vec3 vertex_unshot;
flat in vec3 reflectance;
flat in vec3 emission;

uniform int quantity;  // enum Quantity
uniform bool per_element;
uniform bool edges;
uniform usamplerBuffer triangle_elements;
uniform samplerBuffer element_irradiance;

out vec4 pixel;

const vec3 kNegative = vec3(0.15, 0.35, 1.0);  // the hue of what is below 0

void main() {
  vec3 received = vertex_irradiance;
  if (per_element) received = texelFetch(element_irradiance, int(texelFetch(triangle_elements, gl_PrimitiveID).r)).rgb;
  received += vertex_ambient;
  vec3 shown = emission + reflectance * received;
  bool lamp = false;
  if (quantity == 0) {
    lamp = any(greaterThan(emission, vec3(0.0)));
  } else if (quantity == 1) {
    shown = received;
  } else if (quantity == 2) {
    float y = luminance(vertex_unshot);
    shown = y < 0.0 ? -y * kNegative : vertex_unshot;
  } else if (quantity == 3) {
    shown = emission;
  } else {
    shown = reflectance;
  }
  pixel = vec4(max(shown, 0.0), edges ? 3.0 : lamp ? 2.0 : 1.0);
}
