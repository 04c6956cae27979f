// Where cells lie in even coordinates (index::Grid::physical_from_index), from which the matrices of
// frame.glsl lead on: at their vertex index coordinates; with UNEVEN, on a rectilinear grid, where
// the table says. What is inside a cell is in voxels from its middle, -0.5 to 0.5 along each axis.

#ifdef UNEVEN
// Four texels for each vertex number, with a number each for the axes x, y and z: the even
// coordinate, the size of the cell behind it, and the two of index::Grid::SlopeWeights.
layout(binding = 10) uniform samplerBuffer axis_table;
vec3 of_axes(ivec3 vertex, int which) {
    ivec3 at = 4 * vertex + which;
    return vec3(texelFetch(axis_table, at.x).x, texelFetch(axis_table, at.y).y, texelFetch(axis_table, at.z).z);
}
vec3 vertex_place(ivec3 vertex) { return of_axes(vertex, 0); }
vec3 cell_size(ivec3 cell) { return of_axes(cell, 1); }
#else
vec3 vertex_place(ivec3 vertex) { return vec3(vertex); }
vec3 cell_size(ivec3 cell) { return vec3(1); }
#endif

vec3 cell_middle(ivec3 cell) { return vertex_place(cell) + 0.5 * cell_size(cell); }
