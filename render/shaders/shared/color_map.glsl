// Colors of a map, in linear light.

// @param at place of a value on the map, 0 to 1
// @param ratio of the values at the map's ends where it goes by logarithms, else 0
// @param bands the map's colors do not flow into each other
vec3 color_on(sampler1D map, float at, float ratio, bool bands) {
    at = clamp(at, 0.0, 1.0);
    if (ratio > 0.0)
        at = log2(1.0 + at * (ratio - 1.0)) / log2(ratio);
    float size = float(textureSize(map, 0));
    float texel = at * (size - 1.0);
    if (bands)
        texel = floor(texel + 0.5);
    return textureLod(map, (texel + 0.5) / size, 0.0).rgb;
}
