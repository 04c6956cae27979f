// The transfer curve of sRGB (IEC 61966-2-1).

vec3 linear_from_srgb(vec3 value) {
    return mix(pow((value + 0.055) / 1.055, vec3(2.4)), value / 12.92,
               lessThanEqual(value, vec3(0.04045)));
}

vec3 srgb_from_linear(vec3 light) {
    light = clamp(light, 0.0, 1.0);
    return mix(1.055 * pow(light, vec3(1.0 / 2.4)) - 0.055, light * 12.92,
               lessThanEqual(light, vec3(0.0031308)));
}
