#version 450 core
// Puts the cells of a message (render/cells/slot_plan.h) into their slots.
#include "work.glsl"
#include "slots.glsl"

layout(std430, binding = 1) readonly buffer Message { uint message[]; };

layout(location = 2) uniform bool whole;           // ids by slot; else slot and id of each change
layout(location = 3) uniform uvec2 cells;          // of the grid, along x and y
layout(location = 4) uniform uint surface_ends[MOST_SURFACES]; // where whole: slots behind each surface

void main() {
    uint i = my_work();
    if (i >= work.y)
        return;
    uint slot = i, surface = 0u, id = message[i];
    if (whole) {
        for (int s = 0; s < 7; ++s)
            surface += i >= surface_ends[s] ? 1u : 0u;
    } else {
        slot = message[2u * i] & 0x1fffffffu;
        surface = message[2u * i] >> 29;
        id = message[2u * i + 1u];
    }
    uint row = id / cells.x;
    points[3u * slot] = (id - row * cells.x) | (row % cells.y) << 16;
    points[3u * slot + 1u] = row / cells.y | surface << 16;
}
