// The part of the work that one dispatch does: each invocation has one thing.

layout(local_size_x = 64) in;

// A block, since a driver may compile plain uniforms into the program, again for every value.
layout(std140, binding = 1) uniform Work {
    uvec2 work;   // the first, and behind the last
    bool whole;   // places: ids by slot; else slot and id of each change
    bool colored; // styles
    uvec2 cells;  // of the grid, along x and y
    uvec4 surface_ends[MOST_SURFACES / 4]; // places, where whole: slots behind each surface
};

uint my_work() { return work.x + gl_GlobalInvocationID.x; }
