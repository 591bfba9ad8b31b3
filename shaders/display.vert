#version 330 core
// The display triangles, what is shown worked out at their vertices (core/render/scene_view.h): it is linear in the light, and
// a software rasteriser takes twice as long for small triangles with reflectance and emission as varyings of their own.

layout(location = 0) in vec3 position;
layout(location = 1) in vec3 normal;
layout(location = 2) in uint side;
layout(location = 3) in vec3 irradiance;
layout(location = 4) in vec3 ambient;

uniform mat4 view_projection;
uniform vec4 eye;              // homogeneous: at infinity where sights are parallel
uniform int quantity;          // enum Quantity, but for unshot light
uniform float ambient_weight;  // 0 or 1
uniform samplerBuffer sides;   // per side: reflectance and which side it is (0 front, 1 back, 2 as it is seen); emission

out vec4 shown;  // the quantity, and the class of the pixel

// Front or back of the surface, in two colours that any colour vision tells apart, darker where it is seen edge-on.
vec3 sideColour(bool back, float cosine) {
  vec3 c = back ? vec3(0.80, 0.25, 0.03) : vec3(0.06, 0.24, 0.70);
  return c * (0.35 + 0.65 * abs(cosine));
}

void main() {
  gl_Position = view_projection * vec4(position, 1.0);
  vec4 material = texelFetch(sides, 2 * int(side));
  vec3 reflectance = material.rgb;
  vec3 emission = texelFetch(sides, 2 * int(side) + 1).rgb;
  vec3 received = irradiance + ambient_weight * ambient;
  shown = vec4(emission + reflectance * received, 1.0);
  if (quantity == 0 && any(greaterThan(emission, vec3(0.0)))) shown.a = 2.0;
  if (quantity == 1) shown.rgb = received;
  if (quantity == 3) shown.rgb = emission;
  if (quantity == 4) shown.rgb = reflectance;
  if (quantity >= 9) {
    vec3 to_eye = eye.xyz - eye.w * position;
    float cosine = dot(normal, to_eye) / max(length(to_eye), 1e-30);
    bool away = material.a == 2.0 && cosine < 0.0;
    vec3 facing = away ? -normal : normal;
    shown.rgb = quantity == 9 ? sideColour(material.a == 1.0 || away, cosine) : pow(0.5 + 0.5 * facing, vec3(2.2));
  }
}
