#version 450 core
// Writes the cells of a message (render/cells/slot_assignment.h) into their slots.
#include "work.glsl"
#include "slots.glsl"

layout(std430, binding = 1) readonly buffer Message { uint message[]; };

void main() {
    uint i = my_work();
    if (i >= work.y)
        return;
    uint slot = i, surface = 0u, id = message[i];
    if (whole) {
        for (int s = 0; s < MOST_SURFACES - 1; ++s)
            surface += i >= surface_ends[s >> 2][s & 3] ? 1u : 0u;
    } else {
        slot = message[2u * i] & 0x1fffffffu;
        surface = message[2u * i] >> 29;
        id = message[2u * i + 1u];
    }
    uint row = id / cells.x;
    points[3u * slot] = (id - row * cells.x) | (row % cells.y) << 16;
    points[3u * slot + 1u] = row / cells.y | surface << 16;
}
