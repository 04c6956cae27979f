// Light on a surface, in linear light; needs frame.glsl.
//
// A head light shows what the viewer looks at. A key light, fixed in the room, shows whether the
// head or the surface turns. Both light either side of a surface. Schlick's reflectance F divides
// the light between diffuse reflection and the normalized Blinn-Phong highlight, so that no more
// light leaves than arrives: base (1 - F) + F (s + 8) / 8 (n.h)^s.

#include "srgb.glsl"

// All lights are white: what is sent is base x + y, with shares x and y.
//
// SHARP_HIGHLIGHTS: the shininess is 4 or more.

// The highlight's strength: x from 0 to 1 to the power of the shininess.
float highlight(float x) {
#ifdef SHARP_HIGHLIGHTS
    // exp(-a) in half the time of pow, 0.002 off at most: the 32nd power of the first terms of
    // exp(-a / 32), and of -log(x) the first terms.
    float t = 1.0 - x;
    float a = min(material.y * t * (1.0 + t * (1.0 / 2.0 + t * (1.0 / 3.0 + t * (1.0 / 4.0 + t * (1.0 / 5.0))))), 32.0);
    float y = 1.0 + a * (a / 2048.0 - 1.0 / 32.0);
    y *= y;
    y *= y;
    y *= y;
    y *= y;
    y *= y;
#else
    float y = pow(x, material.y);
#endif
    return (material.y + 8.0) / 8.0 * y;
}

vec3 way_to_eye(vec3 at, float to_distance) {
    return EYE(eye_in_index).w == 0.0 ? vec3(0, 0, 1) : -at * to_distance;
}

// The middle between the ways to the eye and to the key light; w: the share of that light which
// is mirrored.
vec4 halfway_to_key(vec3 to_eye) {
    vec3 between = to_eye + EYE(key_light).xyz;
    vec3 halfway = between * inversesqrt(max(dot(between, between), 1e-12));
    float grazing = 1.0 - max(dot(halfway, to_eye), 0.0);
    float grazing2 = grazing * grazing;
    return vec4(halfway, material.x + (1.0 - material.x) * grazing2 * grazing2 * grazing);
}

// The share of light that the depth cue leaves.
float cue_left(vec3 at, float to_distance) {
    vec4 cue = EYE(depth_cue);
    return 1.0 - cue.z * clamp((dot(at, at) * to_distance - cue.x) * cue.y, 0.0, 1.0);
}

#ifdef BLENDED
// Of a translucent surface: 0 where it faces the viewer, to 1 at its rim. `light_of` sets it.
float turned = 0.0;
const float kRimLight = 0.5; // what the rim sends in addition
#endif

// What is sent before the depth cue, in the two shares.
// @param n unit length, to the eye's side
// @param facing its part along the way to the eye
vec2 light_of(vec3 n, float facing, vec4 halfway) {
    // The head light: as the key light, with the light at the eye.
    vec2 lit = light.y * facing * vec2(1.0 - material.x, material.x * highlight(facing));
    float falling = light.z * max(dot(n, EYE(key_light).xyz), 0.0);
    lit += falling * vec2(1.0 - halfway.w, halfway.w * highlight(max(dot(n, halfway.xyz), 0.0)));
    // The sky gives more than the floor: upper and lower sides differ where no light falls.
    lit.x += light.x * mix(material.z, 1.0, 0.5 + 0.5 * dot(n, EYE(up).xyz));
#ifdef BLENDED
    float away = 1.0 - facing;
    turned = away * away * away;
    return lit + vec2(kRimLight * turned, 0.0);
#endif
    // Where the surface turns away, its outline.
    return lit * (1.0 - material.w * (1.0 - smoothstep(0.0, 0.5, facing)));
}

// The light that a point of the surface sends to the eye, in the two shares.
// @param at position, eye space [m]
// @param normal in eye space, of any length; zero where there is none
vec2 light_in_eye(vec3 at, vec3 normal) {
    float to_distance = inversesqrt(max(dot(at, at), 1e-12)); // 1 / it
    vec3 to_eye = way_to_eye(at, to_distance);
    // Without a normal a cell faces the viewer; with one, both its sides are lit.
    float length2 = dot(normal, normal);
    vec3 n = length2 > 0.0 ? normal * inversesqrt(length2) : to_eye;
    float facing = dot(n, to_eye);
    n = facing < 0.0 ? -n : n;
    return light_of(n, abs(facing), halfway_to_key(to_eye)) * cue_left(at, to_distance);
}

// @param normal in physical space, else as above
// @param base its color, linear light
vec3 shade(vec3 at, vec3 normal, vec3 base) {
    vec2 lit = light_in_eye(at, mat3(EYE(eye_from_physical)) * normal);
    return base * lit.x + lit.y;
}
