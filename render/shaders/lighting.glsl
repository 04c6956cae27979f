// Light on a surface, in linear light; needs frame.glsl.
//
// A head light shows what the viewer looks at, a key light that stands still in the room tells the
// turning of the head from the turning of the surface. Both shine on either side. Diffuse light and
// the normalized highlight of Blinn and Phong share what Schlick's reflectance F splits between
// them, so that no more light leaves than arrives: base (1 - F) + F (s + 8) / 8 (n.h)^s.

#include "srgb.glsl"

// All lights are white: what is sent is base x + y, with these shares x and y.
vec2 reflected(vec3 n, vec3 to_eye, vec3 to_light) {
    float falling = max(dot(n, to_light), 0.0);
    vec3 between = to_eye + to_light;
    vec3 halfway = between * inversesqrt(max(dot(between, between), 1e-12));
    float grazing = 1.0 - max(dot(halfway, to_eye), 0.0);
    float grazing2 = grazing * grazing;
    float mirrored = material.x + (1.0 - material.x) * grazing2 * grazing2 * grazing;
    float highlight = (material.y + 8.0) / 8.0 * pow(max(dot(n, halfway), 0.0), material.y);
    return falling * vec2(1.0 - mirrored, mirrored * highlight);
}

// The light that a point of the surface sends to the eye, in the two shares.
// @param at position, eye space [m]
// @param normal in eye space, of any length; zero where there is none
vec2 light_in_eye(vec3 at, vec3 normal) {
    float to_distance = inversesqrt(max(dot(at, at), 1e-12)); // 1 / it
    vec3 to_eye = EYE(eye_in_index).w == 0.0 ? vec3(0, 0, 1) : -at * to_distance;
    // Without a normal a cell faces the viewer; with one, both its sides are lit.
    float length2 = dot(normal, normal);
    vec3 n = length2 > 0.0 ? normal * inversesqrt(length2) : to_eye;
    float facing = dot(n, to_eye);
    n = facing < 0.0 ? -n : n;
    facing = abs(facing);

    // From the eye: `reflected` towards where the light comes from.
    float highlight = (material.y + 8.0) / 8.0 * pow(facing, material.y);
    vec2 lit = light.y * facing * vec2(1.0 - material.x, material.x * highlight);
    lit += light.z * reflected(n, to_eye, EYE(key_light).xyz);
    // The sky gives more than the floor: upper and lower sides differ where no light falls.
    lit.x += light.x * mix(material.z, 1.0, 0.5 + 0.5 * dot(n, EYE(up).xyz));
    // Where the surface turns away, its outline.
    lit *= 1.0 - material.w * (1.0 - smoothstep(0.0, 0.5, facing));
    vec4 cue = EYE(depth_cue);
    return lit * (1.0 - cue.z * clamp((dot(at, at) * to_distance - cue.x) * cue.y, 0.0, 1.0));
}

// @param normal in physical space, else as above
// @param base its color, linear light
vec3 shade(vec3 at, vec3 normal, vec3 base) {
    vec2 lit = light_in_eye(at, mat3(EYE(eye_from_physical)) * normal);
    return base * lit.x + lit.y;
}
