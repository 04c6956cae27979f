// The colour of a cell from its style, and the form in which colours are written; needs frame.glsl
// and srgb.glsl.
//
// A style is 16 bits: 0 to 2 number the surface, 3 to 15 are the colour coordinate, the value to
// colour by as a fraction of its whole range in steps of 1 / 8190; 8191 stands for no value.

const uint kNoValue = 8191u;

layout(binding = 7) uniform sampler1D color_map; // linear light

vec3 base_color(uint style) {
    if (!colored)
        return surfaces[style & 7u].rgb;
    uint coordinate = style >> 3;
    if (coordinate == kNoValue)
        return no_value.rgb;
    float at = color_range.x * (float(coordinate) / float(kNoValue - 1u)) + color_range.y;
    float size = float(textureSize(color_map, 0));
    return textureLod(color_map, (clamp(at, 0.0, 1.0) * (size - 1.0) + 0.5) / size, 0.0).rgb;
}

vec3 written(vec3 light) {
    return linear_light ? light : srgb_from_linear(light);
}

// Opaque quads let a share of the cells through instead of light: which ones is decided in the
// volume, so that both eyes miss the same. @return 0 to 1, evenly spread
float sieve(uvec3 cell) {
    uint hash = (cell.x ^ (cell.y & 0xffffu) * 0x9e3779b9u) * 0x85ebca6bu;
    hash = (hash ^ hash >> 15) * 0xc2b2ae35u;
    return float(hash >> 8) / 16777216.0;
}
