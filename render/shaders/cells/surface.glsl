// The data of a cell that its quad's vertices pass to the fragments; needs frame.glsl.

#ifdef VERTEX_STAGE
#define OF_CELL flat out
#else
#define OF_CELL flat in
#endif

// Coordinates inside a cell are voxels from its center, which is precise in any volume.
OF_CELL vec4 center; // in pixels from the middle of the viewport times w, z and w
OF_CELL vec3 center_in_eye;
OF_CELL uint hash;
OF_CELL uint surface;
OF_CELL vec3 center_in_index; // vertex index coordinates
#ifdef UNEVEN
OF_CELL vec3 voxel, center_place; // the cell's size and middle, even coordinates
#endif
OF_CELL vec4 base; // color in linear light, opacity
// Polynomials of the trilinear interpolation, with coefficients of 1, x, y, z and of xy, xz, yz,
// xyz:
// for the value, in any scale, and for the gradient towards lower values in physical space.
OF_CELL vec4 linear, mixed;
OF_CELL vec3 gradient_linear[4], gradient_mixed[4];
#ifdef COLORS
OF_CELL vec4 color_linear, color_mixed; // for the color coordinate, 0 to 1
OF_CELL uint color_known;               // 0: a vertex has no value
#endif

// The coefficients of xy, xz and yz relative to `p`.
vec3 mixed_at(vec3 p) { return mixed.xyz + mixed.w * p.zyx; }

// The value at `p`, followed by its derivatives by x, y and z.
vec4 value_and_slope(vec3 p) {
    vec3 about = mixed_at(p);
    vec3 slope = linear.yzw + vec3(mixed.xx * p.yx, mixed.y * p.x) + vec3(about.yz * p.z, about.z * p.y);
    float value = linear.x + linear.y * p.x + (linear.z + mixed.x * p.x) * p.y + slope.z * p.z;
    return vec4(value, slope);
}
