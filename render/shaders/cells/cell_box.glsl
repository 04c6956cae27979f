// Where a cell is and how large; needs frame.glsl and cell_place.glsl.

struct CellBox {
    vec3 middle, size; // even coordinates
    vec3 in_index;     // the middle in vertex index coordinates
    float voxels;      // along each axis
};

// In a set of mixed levels of detail a position is twice the cell's center, an odd multiple of its
// size (index/detail/detail_regions.h). The last cell along an axis ends at the volume's border.
CellBox box_of(uvec3 cell) {
    ivec3 at = ivec3(cell.x & 0xffffu, cell.x >> 16, cell.y & 0xffffu);
    if (!mixed_levels)
        return CellBox(cell_middle(at), cell_size(at), vec3(at) + 0.5, 1.0);
    int voxels = at.x & -at.x;
    ivec3 low = (at - voxels) / 2, high = min(low + voxels, ivec3(volume_extent.xyz));
    vec3 first = vertex_place(low), last = vertex_place(high);
#ifdef UNEVEN
    vec3 size = last - first;
#else
    vec3 size = vec3(voxels); // as render/culling/cell_squares.cpp has it
#endif
    return CellBox(0.5 * (first + last), size, 0.5 * vec3(low + high), float(voxels));
}
