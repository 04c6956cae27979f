#version 450 core
// Combines two eyes' pictures: by color, or by the parity of rows and columns of the window.
// Textures and target are in linear light.

layout(binding = 0) uniform sampler2D left_eye;
layout(binding = 1) uniform sampler2D right_eye;
uniform int mode; // one of the names that Multiplex::shader_prelude defines
uniform ivec2 left_from_window, right_from_window; // offset from a window's pixel (times `way`) to the eye's
uniform int way;           // 1, or -1: the eyes' pictures are turned by 180 degrees
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

void main() {
    ivec2 window_pixel = ivec2(gl_FragCoord.xy);
    vec3 left = texelFetch(left_eye, way * window_pixel + left_from_window, 0).rgb;
    vec3 right = texelFetch(right_eye, way * window_pixel + right_from_window, 0).rgb;
    int row = window_height - 1 - window_pixel.y, column = window_pixel.x;
    vec3 both;
    switch (mode) {
    case anaglyph_red_cyan:
        both = vec3(left.r, right.gb);
        break;
    case anaglyph_dubois:
        both = clamp(dubois_left * left + dubois_right * right, 0.0, 1.0);
        break;
    default:
        int count = mode == vertical_interlaced     ? row
                  : mode == horizontal_interlaced ? column
                                                  : row + column;
        both = (count & 1) == 0 ? left : right;
    }
    color = vec4(both, 1.0);
}
