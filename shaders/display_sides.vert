#version 330 core
// The display triangles in colours of where they face: front and back, or the normal. As display.vert, for display.frag.

layout(location = 0) in vec3 position;
layout(location = 1) in vec3 normal;
layout(location = 2) in uint side;

uniform mat4 view_projection;
uniform vec4 eye;             // homogeneous: at infinity where sights are parallel
uniform int quantity;         // enum Quantity: sides or normals
uniform samplerBuffer sides;  // per side: reflectance and which side it is (0 front, 1 back, 2 as it is seen); emission

out vec4 shown;

// Front or back of the surface, in two colours that any colour vision tells apart, darker where it is seen edge-on.
vec3 sideColour(bool back, float cosine) {
  vec3 c = back ? vec3(0.80, 0.25, 0.03) : vec3(0.06, 0.24, 0.70);
  return c * (0.35 + 0.65 * abs(cosine));
}

void main() {
  gl_Position = view_projection * vec4(position, 1.0);
  float which = texelFetch(sides, 2 * int(side)).a;
  vec3 to_eye = eye.xyz - eye.w * position;
  float cosine = dot(normal, to_eye) / max(length(to_eye), 1e-30);
  bool away = which == 2.0 && cosine < 0.0;
  vec3 facing = away ? -normal : normal;
  shown.rgb = quantity == 9 ? sideColour(which == 1.0 || away, cosine) : pow(0.5 + 0.5 * facing, vec3(2.2));
  shown.a = 1.0;
}
