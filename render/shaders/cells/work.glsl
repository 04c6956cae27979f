// The range of items of one dispatch: each invocation handles one item.

layout(local_size_x = 64) in;

// A block, because a driver may compile plain uniforms into the program, anew for every value.
layout(std140, binding = 1) uniform Work {
    uvec2 work;   // first item, and the one after the last
    bool whole;   // cell_places.comp: message is ids by slot; else slot and id of each change
                  // cell_corners.comp: items are slots; else they are numbers in the list
    bool colored; // cell_styles.comp: the set has colors
    uvec2 cells;  // cells of the grid, along x and y
    uvec4 surface_ends[MOST_SURFACES / 4]; // cell_places.comp, if whole: end slot of each surface
};

uint my_work() { return work.x + gl_GlobalInvocationID.x; }
