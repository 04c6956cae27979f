// The color of a cell from its style, conversion of colors for writing, and fading near the viewer;
// needs frame.glsl and srgb.glsl.
//
// A style has 16 bits. Bits 0 to 2 are the number of the surface. Bits 3 to 15 are the color
// coordinate: the value to color by as a fraction of its whole range, in steps of 1 / 8190; 8191
// means no value.

const uint kNoValue = 8191u;

#include "color_map.glsl"

layout(binding = 7) uniform sampler1D color_map; // linear light

// The color of a value. @param share its place in the range of all values, 0 to 1
vec3 mapped_color(float share) {
    return color_on(color_map, color_range.x * share + color_range.y, color_ratio, color_bands);
}

vec3 base_color(uint style) {
    if (!colored)
        return surfaces[style & 7u].rgb;
    uint coordinate = style >> 3;
    return coordinate == kNoValue ? no_value.rgb : mapped_color(float(coordinate) / float(kNoValue - 1u));
}

vec3 written(vec3 light) {
    return linear_light ? light : srgb_from_linear(light);
}

#ifdef BLENDED
// A layer of a translucent surface, pre-multiplied. At its rim the view goes a longer way through it,
// so that it covers more there. Its highlights are as bright as those of an opaque surface.
// @param lit the two shares of light @param turned see lighting.glsl
vec4 layer_of(vec3 base, vec2 lit, float turned, float opacity) {
    float covered = 1.0 - pow(1.0 - opacity, 1.0 + 6.0 * turned);
    return vec4(written(base * lit.x + lit.y / max(covered, 1e-3)) * covered, covered);
}
#endif

// Opaque quads fade by leaving out a share of the cells. A hash of the cell's place decides which
// ones, so that both eyes miss the same.
uint hash_of(uvec3 cell) {
    uint hash = (cell.x ^ (cell.y & 0xffffu) * 0x9e3779b9u) * 0x85ebca6bu;
    return (hash ^ hash >> 15) * 0xc2b2ae35u;
}

// @return uniformly distributed in [0, 1)
float evenly(uint hash) { return float(hash >> 8) / 16777216.0; }

// The share that remains, 0 to 1, near the viewer (fading) and beyond a cutting plane (0).
// @param at eye space
float near_share(vec3 at) {
    for (int i = 0; i < cut_count; ++i)
        if (dot(EYE(cuts[i]), vec4(at, 1.0)) > 0.0)
            return 0.0;
    return clamp((distance(at, EYE(between_eyes).xyz) - near_fade.x) * near_fade.y, 0.0, 1.0);
}

// Opaque surfaces fade by leaving out a share of their grains, which are much smaller than cells.
// @param place in the cell, voxels
// @param cell hash of the cell
// @return a number for the grain, as `evenly`
float grain(vec3 place, uint cell) {
    uvec3 at = uvec3(ivec3(floor((place + 0.5) * near_fade.z)));
    uint hash = (at.x * 0x9e3779b9u ^ at.y * 0x85ebca6bu ^ at.z * 0xc2b2ae35u ^ cell) * 0x27d4eb2fu;
    return evenly((hash ^ hash >> 15) * 0x2c1b3c6du);
}
