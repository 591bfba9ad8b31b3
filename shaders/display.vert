#version 330 core
// The display triangles, what is shown worked out at their vertices (core/render/scene_view.h): it is linear in the light, and
// a software rasteriser takes twice as long for small triangles with reflectance and emission as varyings of their own.

layout(location = 0) in vec3 position;
layout(location = 2) in uint side;
layout(location = 3) in vec3 irradiance;
layout(location = 4) in vec3 ambient;

uniform mat4 view_projection;
uniform int quantity;          // enum Quantity, but for unshot light
uniform float emission_weight;  // 0 or 1
uniform samplerBuffer sides;   // per side: reflectance, emission

out vec4 shown;  // the quantity, and the class of the pixel

void main() {
  gl_Position = view_projection * vec4(position, 1.0);
  vec3 reflectance = texelFetch(sides, 2 * int(side)).rgb;
  vec3 emission = texelFetch(sides, 2 * int(side) + 1).rgb;
  vec3 received = irradiance + ambient;
  if (quantity != 3) emission *= emission_weight;
  shown = vec4(emission + reflectance * received, 1.0);
  if (quantity == 0 && any(greaterThan(emission, vec3(0.0)))) shown.a = 2.0;
  if (quantity == 1) shown.rgb = received;
  if (quantity == 3) shown.rgb = emission;
  if (quantity == 4) shown.rgb = reflectance;
}
