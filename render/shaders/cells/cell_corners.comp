#version 450 core
// Computes for every cell the values at its vertices, minus its surface's isovalue, and their
// gradients: the data for the exact surface inside the cell.
#ifndef BLOCKS
#define BLOCKS samplerBuffer
#endif
#include "volume_blocks.glsl"
#include "work.glsl"
#include "slots.glsl"

layout(std430, binding = 1) writeonly buffer Values { vec4 corner_values[]; };       // 2 per cell
layout(std430, binding = 2) writeonly buffer Gradients { uvec4 corner_gradients[]; }; // 4 per cell
layout(std430, binding = 3) readonly buffer List { uint listed[]; }; // slots

// The gradient towards lower values, in physical space, from differences along the axes; as four
// halves, the fourth is 0.
uvec2 packed_gradient(vec3 d) {
    if (!is_finite(d))
        return uvec2(0u);
    vec3 g = gradient_scale * vec3(dot(from_difference_x.xyz, d), dot(from_difference_y.xyz, d),
                                   dot(from_difference_z.xyz, d));
    return uvec2(packHalf2x16(g.xy), packHalf2x16(vec2(g.z, 0.0)));
}

void write_row(uint texel, vec2 x, vec2 y, vec2 z) {
    corner_gradients[texel] = uvec4(packed_gradient(vec3(x.x, y.x, z.x)),
                                    packed_gradient(vec3(x.y, y.y, z.y)));
}

void main() {
    uint item = my_work();
    if (item >= work.y)
        return;
    uint slot = whole ? item : listed[item];
    ivec3 cell = cell_of(slot);
    uint surface = surface_of(slot);
    float level = levels[surface >> 2][surface & 3u];
    read_around(cell);
    uint to = item - work.x;
    corner_values[2u * to] = vec4(row_11.yz, row_21.yz) - level;
    corner_values[2u * to + 1u] = vec4(row_12.yz, row_22.yz) - level;
    // Differences at the two vertices of a row, for each of the four rows.
    Slopes x = slopes_along(0, cell), y = slopes_along(1, cell), z = slopes_along(2, cell);
    write_row(4u * to, in_row(x, row_11), at_low(y, row_01, row_11.yz, row_21.yz),
              at_low(z, row_10, row_11.yz, row_12.yz));
    write_row(4u * to + 1u, in_row(x, row_21), at_high(y, row_11.yz, row_21.yz, row_31),
              at_low(z, row_20, row_21.yz, row_22.yz));
    write_row(4u * to + 2u, in_row(x, row_12), at_low(y, row_02, row_12.yz, row_22.yz),
              at_high(z, row_11.yz, row_12.yz, row_13));
    write_row(4u * to + 3u, in_row(x, row_22), at_high(y, row_12.yz, row_22.yz, row_32),
              at_high(z, row_21.yz, row_22.yz, row_23));
}
