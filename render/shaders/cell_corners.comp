#version 450 core
// Computes for every cell the values at its vertices, minus its surface's isovalue, and their
// gradients: the data for the exact surface inside the cell.
#ifndef BRICKS
#define BRICKS samplerBuffer
#endif
#include "volume_bricks.glsl"
#include "work.glsl"
#include "slots.glsl"

layout(std430, binding = 1) writeonly buffer Values { vec4 corner_values[]; };       // 2 per cell
layout(std430, binding = 2) writeonly buffer Gradients { uvec4 corner_gradients[]; }; // 4 per cell

// The gradient towards lower values, in physical space, from differences along the axes; as halves,
// the last of which is 0.
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
    uint slot = my_work();
    if (slot >= work.y)
        return;
    ivec3 cell = cell_of(slot);
    uint surface = surface_of(slot);
    float level = levels[surface >> 2][surface & 3u];
    read_around(cell);
    uint to = slot - work.x;
    corner_values[2u * to] = vec4(row_11.yz, row_21.yz) - level;
    corner_values[2u * to + 1u] = vec4(row_12.yz, row_22.yz) - level;
    // Differences at the two vertices of a row, for each of the four rows.
    vec2 wx = difference_weights(cell.x, vertices.x);
    vec2 wy = difference_weights(cell.y, vertices.y);
    vec2 wz = difference_weights(cell.z, vertices.z);
    write_row(4u * to, wx * (row_11.zw - row_11.xy), wy.x * (row_21.yz - row_01),
              wz.x * (row_12.yz - row_10));
    write_row(4u * to + 1u, wx * (row_21.zw - row_21.xy), wy.y * (row_31 - row_11.yz),
              wz.x * (row_22.yz - row_20));
    write_row(4u * to + 2u, wx * (row_12.zw - row_12.xy), wy.x * (row_22.yz - row_02),
              wz.y * (row_13 - row_11.yz));
    write_row(4u * to + 3u, wx * (row_22.zw - row_22.xy), wy.y * (row_32 - row_12.yz),
              wz.y * (row_23 - row_21.yz));
}
