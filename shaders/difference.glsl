// The colour of a relative difference, linear (core/render/reference_light.h: differenceColour): from dark grey at 0.1 %
// over a dark and a full colour at 1 % and 10 % to a pale one at 100 %, so that lightness rises all the way.

vec3 differenceColour(float relative) {
  float decades = clamp(3.0 + log(max(abs(relative), 1e-30)) / log(10.0), 0.0, 3.0);
  bool brighter = relative > 0.0;
  vec3 dark = brighter ? vec3(0.22, 0.05, 0.01) : vec3(0.01, 0.06, 0.26);
  vec3 full = brighter ? vec3(0.95, 0.30, 0.02) : vec3(0.04, 0.30, 1.0);
  vec3 pale = brighter ? vec3(1.0, 0.92, 0.55) : vec3(0.68, 0.93, 1.0);
  if (decades < 1.0) return mix(vec3(0.03), dark, decades);
  return decades < 2.0 ? mix(dark, full, decades - 1.0) : mix(full, pale, decades - 2.0);
}
