// From index space to the screen; needs frame.glsl.

// Clip space with x and y in pixels from the middle of the viewport.
vec4 to_pixels(vec4 p) {
    return vec4(dot(EYE(row_x), p), dot(EYE(row_y), p), dot(EYE(row_z), p), dot(EYE(row_w), p));
}
