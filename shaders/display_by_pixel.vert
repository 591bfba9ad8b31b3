#version 330 core
// The display triangles and the edges of elements, for what display.vert does not show: light by element, signed light, lines.

layout(location = 0) in vec3 position;
layout(location = 1) in vec3 normal;
layout(location = 2) in uint side;
layout(location = 3) in vec3 irradiance;
layout(location = 4) in vec3 ambient;
layout(location = 5) in vec3 extra;  // what the mode shows besides the light: unshot, bounces, residual or the reference's reflected light

uniform mat4 view_projection;
uniform vec4 eye;                 // homogeneous: at infinity where sights are parallel
uniform int quantity;             // enum Quantity
uniform bool edges;               // lines: pulled to the eye a little, clipped where their side faces away
uniform float emission_weight;    // 0 or 1
uniform samplerBuffer sides;      // per side: reflectance, emission

out vec3 vertex_irradiance;
out vec3 vertex_ambient;
out vec3 vertex_extra;
flat out vec3 reflectance;
flat out vec3 emission;
out float gl_ClipDistance[1];

void main() {
  vec3 to_eye = eye.xyz - eye.w * position;
  // Within half a pixel depth grows by 1 / cosine: where a side is seen nearly edge-on its lines need more.
  float cosine = dot(normal, to_eye) / max(length(to_eye), 1e-30);
  float pull = clamp(0.0007 / max(cosine, 1e-3), 0.001, 0.01);
  gl_Position = view_projection * vec4(edges ? position + pull * to_eye : position, 1.0);
  gl_ClipDistance[0] = dot(normal, to_eye);
  vertex_irradiance = irradiance;
  vertex_ambient = ambient;
  vertex_extra = quantity == 8 ? vec3(0.45 + 0.55 * abs(cosine)) : extra;  // 8: the shading of patches
  reflectance = texelFetch(sides, 2 * int(side)).rgb;
  emission = (quantity == 3 ? 1.0 : emission_weight) * texelFetch(sides, 2 * int(side) + 1).rgb;
}
