// Reads the values around a cell from volume blocks; needs BLOCKS, the sampler of their type.
// A volume block has 8^3 vertices (index/extraction/volume_blocks.h), x fastest.

#include "cell_place.glsl"

layout(binding = 0) uniform usamplerBuffer pages; // slots by block id
layout(binding = 1) uniform BLOCKS blocks;        // held values by slot

layout(std140, binding = 0) uniform Volume {
    vec4 from_difference_x, from_difference_y, from_difference_z; // rows: towards lower values
    ivec3 vertices;
    float factor;         // block units per held value
    ivec3 tiles;          // blocks along each axis
    float gradient_scale; // factor of stored gradients, per block unit
    vec4 levels[2];       // levels of the surfaces, in block units
};

// The four planes of vertices around a cell along one axis: its two vertices and their outer
// neighbors, clamped at the border. They lie in one or two blocks.
struct Planes {
    ivec4 offset; // offset of each plane in its block
    bvec4 second; // whether it lies in the second block
    ivec2 block;  // the two blocks along this axis
};

Planes planes(int cell, int count, int shift) {
    ivec4 at = clamp(cell + ivec4(-1, 0, 1, 2), 0, count - 1);
    ivec4 block = at >> 3;
    return Planes((at & 7) << shift, notEqual(block, ivec4(block.x)), ivec2(block.x, block.w));
}

ivec4 first_texels(ivec4 block) {
    return ivec4(texelFetch(pages, block.x).x, texelFetch(pages, block.y).x,
                 texelFetch(pages, block.z).x, texelFetch(pages, block.w).x) << 9;
}

// The values on those planes, in rows along x; row_yz lies on planes y and z. Rows on inner planes
// have all four values; rows with one outer plane have only the two at the cell's vertices. There
// are no rows on two outer planes, as no central difference needs them. No arrays and loops:
// software GL neither unrolls them nor keeps them in registers.
vec4 row_11, row_21, row_12, row_22;
vec2 row_01, row_31, row_02, row_32, row_10, row_20, row_13, row_23;

float value_at(int texel) { return float(texelFetch(blocks, texel).x) * factor; }

// First texels of a row in the first and the second block along x. `lower` has the first texels of
// the blocks that are first along z, `upper` of the blocks that are second along z; each has both
// blocks along x for the first block along y, then for the second.
ivec2 row_start(bool second_y, bool second_z, int offset, ivec4 lower, ivec4 upper) {
    ivec4 of_z = second_z ? upper : lower;
    return (second_y ? of_z.zw : of_z.xy) + offset;
}

vec4 inner_row(ivec2 start, Planes x) {
    ivec4 at = mix(start.xxxx, start.yyyy, x.second) + x.offset;
    return vec4(value_at(at.x), value_at(at.y), value_at(at.z), value_at(at.w));
}

vec2 outer_row(ivec2 start, Planes x) {
    ivec2 at = mix(start.xx, start.yy, x.second.yz) + x.offset.yz;
    return vec2(value_at(at.x), value_at(at.y));
}

void read_around(ivec3 cell) {
    Planes x = planes(cell.x, vertices.x, 0);
    Planes y = planes(cell.y, vertices.y, 3);
    Planes z = planes(cell.z, vertices.z, 6);
    ivec4 page = y.block.xxyy * tiles.x + x.block.xyxy;
    ivec4 lower = first_texels(page + z.block.x * tiles.y * tiles.x);
    ivec4 upper = first_texels(page + z.block.y * tiles.y * tiles.x);
#define START(i, j) row_start(y.second[i], z.second[j], y.offset[i] + z.offset[j], lower, upper)
    row_11 = inner_row(START(1, 1), x);
    row_21 = inner_row(START(2, 1), x);
    row_12 = inner_row(START(1, 2), x);
    row_22 = inner_row(START(2, 2), x);
    row_01 = outer_row(START(0, 1), x);
    row_31 = outer_row(START(3, 1), x);
    row_02 = outer_row(START(0, 2), x);
    row_32 = outer_row(START(3, 2), x);
    row_10 = outer_row(START(1, 0), x);
    row_20 = outer_row(START(2, 0), x);
    row_13 = outer_row(START(1, 3), x);
    row_23 = outer_row(START(2, 3), x);
#undef START
}

// Slopes per even coordinate at a cell's two vertices along one axis, from the values there and
// before and behind them.
#ifdef UNEVEN
struct Slopes {
    vec2 before, behind; // index::Grid::SlopeWeights of the two vertices
};
Slopes slopes_along(int axis, ivec3 cell) {
    ivec3 next = cell + 1;
    return Slopes(vec2(of_axes(cell, 2)[axis], of_axes(next, 2)[axis]),
                  vec2(of_axes(cell, 3)[axis], of_axes(next, 3)[axis]));
}
vec2 in_row(Slopes s, vec4 row) { return s.before * (row.yz - row.xy) + s.behind * (row.zw - row.yz); }
vec2 at_low(Slopes s, vec2 before, vec2 here, vec2 behind) {
    return s.before.x * (here - before) + s.behind.x * (behind - here);
}
vec2 at_high(Slopes s, vec2 before, vec2 here, vec2 behind) {
    return s.before.y * (here - before) + s.behind.y * (behind - here);
}
#else
struct Slopes {
    vec2 weights; // 0.5 for central differences, 1 for one-sided ones at the border
};
Slopes slopes_along(int axis, ivec3 cell) {
    return Slopes(vec2(cell[axis] == 0 ? 1.0 : 0.5, cell[axis] + 2 == vertices[axis] ? 1.0 : 0.5));
}
vec2 in_row(Slopes s, vec4 row) { return s.weights * (row.zw - row.xy); }
vec2 at_low(Slopes s, vec2 before, vec2 here, vec2 behind) { return s.weights.x * (behind - before); }
vec2 at_high(Slopes s, vec2 before, vec2 here, vec2 behind) { return s.weights.y * (behind - before); }
#endif

// Neither infinite nor NaN; works even if the compiler assumes that these do not occur.
bool is_finite(vec3 v) {
    const uvec3 kExponent = uvec3(0x7f800000u);
    return all(notEqual(floatBitsToUint(v) & kExponent, kExponent));
}
