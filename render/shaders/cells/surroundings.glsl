// How much of its surroundings lies behind the surface, as the worker found it in the volume: light
// from all around does not reach where that is much. Needs frame.glsl.
//
// The field is asked a little before the surface, on the side that is seen: above a plane nearly
// nothing is behind it there, in a groove most of it. It depends on the volume and the side alone,
// so that both eyes see the same.

// Fields of the surfaces, one upon the other.
layout(binding = 9) uniform sampler3D surroundings_field;

const float kBefore = 2.5;      // places of the field
const float kPlane = 0.125;     // what is found so far before a plane,
const float kSteepness = 2.0;   // how fast anything beyond it darkens,
const float kDarkest = 0.85;    // at most

// The share of light that reaches a point of the surface.
// @param at vertex index coordinates
// @param toward_eye even coordinates
// @param size of the cell, even coordinates
// @param normal physical space, towards lower values
float unshadowed(vec3 at, vec3 toward_eye, vec3 size, vec3 normal, uint surface) {
    vec3 n = to_index(normal);
    bool outside = dot(n, toward_eye) >= 0.0;
    n *= size;
    float size2 = dot(n, n);
    if (surroundings.w == 0.0 || size2 == 0.0)
        return 1.0;
    n *= (outside ? kBefore : -kBefore) * inversesqrt(size2);
    vec3 places = surroundings_size.xyz;
    vec3 place = clamp(at * surroundings.xyz + n, vec3(0), places - 1.0) + 0.5;
    place.z += float(surface) * places.z;
    float share = textureLod(surroundings_field, place / vec3(textureSize(surroundings_field, 0)), 0.0).x;
    float behind = outside ? share : 1.0 - share;
    return 1.0 - surroundings.w * clamp(kSteepness * (behind - kPlane), 0.0, kDarkest);
}

vec3 toward_eye_in_index(vec3 at) {
    vec4 eye = EYE(eye_in_index);
    return eye.xyz - eye.w * at;
}
