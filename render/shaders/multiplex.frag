#version 450 core
// Two eyes' pictures in one: by colour, or by the parity of rows and columns of the window.

layout(binding = 0) uniform sampler2D left_eye;
layout(binding = 1) uniform sampler2D right_eye;
uniform int mode;          // as in multiplex.cpp
uniform ivec2 corner;      // of the viewport in the window, pixels from the lower left
uniform int window_height; // pixels
out vec4 color;

// E. Dubois, "Conversion of a stereo pair to anaglyph with the least-squares projection method",
// 2009: red-cyan glasses, linear RGB. Columns are the parts of red, green and blue.
const mat3 dubois_left = mat3(
    0.437, -0.062, -0.048,
    0.449, -0.062, -0.050,
    0.164, -0.024, -0.017);
const mat3 dubois_right = mat3(
    -0.011, 0.377, -0.026,
    -0.032, 0.761, -0.093,
    -0.007, 0.009, 1.234);

// IEC 61966-2-1 (sRGB).
vec3 linear_from_srgb(vec3 c) {
    return mix(c / 12.92, pow((c + 0.055) / 1.055, vec3(2.4)), greaterThan(c, vec3(0.04045)));
}
vec3 srgb_from_linear(vec3 c) {
    return mix(12.92 * c, 1.055 * pow(c, vec3(1.0 / 2.4)) - 0.055, greaterThan(c, vec3(0.0031308)));
}

void main() {
    ivec2 window_pixel = ivec2(gl_FragCoord.xy);
    ivec2 pixel = window_pixel - corner;
    vec3 left = texelFetch(left_eye, pixel, 0).rgb;
    vec3 right = texelFetch(right_eye, pixel, 0).rgb;
    int row = window_height - 1 - window_pixel.y, column = window_pixel.x;
    vec3 both;
    switch (mode) {
    case 0:
        both = vec3(left.r, right.gb);
        break;
    case 1:
        vec3 sum = dubois_left * linear_from_srgb(left) + dubois_right * linear_from_srgb(right);
        both = srgb_from_linear(clamp(sum, 0.0, 1.0));
        break;
    default:
        int count = mode == 2 ? row : mode == 3 ? column : row + column;
        both = (count & 1) == 0 ? left : right;
    }
    color = vec4(both, 1.0);
}
