// Light on a surface; needs frame.glsl.

// The colour that a display shows of a point of the surface.
// @param at position, eye space [m]
// @param normal in physical space, of any length; zero where there is none
vec3 shade(vec3 at, vec3 normal) {
    float distance_to_eye = length(at);
    vec3 to_light = EYE(eye_in_index).w == 0.0 ? vec3(0, 0, 1) : -at / max(distance_to_eye, 1e-6);
    vec3 n = mat3(EYE(eye_from_physical)) * normal;
    // Without a normal a cell faces the viewer; with one, both its sides are lit.
    float facing = dot(n, n) > 0.0 ? abs(dot(normalize(n), to_light)) : 1.0;
    vec3 lit = color.rgb * (light.x + light.y * facing) + light.z * pow(facing, light.w);
    vec4 cue = EYE(depth_cue);
    float far = clamp((distance_to_eye - cue.x) * cue.y, 0.0, 1.0);
    lit *= 1.0 - cue.z * far;
    return pow(clamp(lit, 0.0, 1.0), vec3(1.0 / 2.2)); // targets hold display values
}
