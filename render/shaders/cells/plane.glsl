// The plane of the surface in a cell (index::CellPlane); needs frame.glsl.

// The plane's normal in physical space; zero if there is none.
vec3 plane_normal(uint word) {
    vec2 at = (vec2(word & 0xfffu, word >> 12 & 0xfffu) - 2048.0) / 2047.0;
    vec3 n = vec3(at, 1.0 - abs(at.x) - abs(at.y));
    float fold = max(-n.z, 0.0);
    n.xy -= vec2(n.x < 0.0 ? -fold : fold, n.y < 0.0 ? -fold : fold);
    return (word & 0xffffffu) == 0u ? vec3(0) : normalize(n);
}

vec3 signs(vec3 v) { return vec3(v.x < 0.0 ? -1.0 : 1.0, v.y < 0.0 ? -1.0 : 1.0, v.z < 0.0 ? -1.0 : 1.0); }

const float kLeastRest = 0.007; // as render/cells/cell_shape.h has it

// In voxels from the cell's middle.
struct Plane {
    vec3 normal; // unit length; zero if there is none
    vec3 middle; // near the middle of the plane's part in the cell
    float rest;  // distance to the corner of the cell that is farthest out on the plane's side
};

// The plane cuts each edge at the corner that is farthest out on its side at a distance of `rest`
// divided by the normal's component along the edge, at most the whole edge. From the corner, a third
// of each distance along its edge leads to a point near the middle of the plane's part in the cell.
Plane plane_in(vec3 voxel, vec3 normal, uint word) {
    vec3 n = voxel * to_index(normal);
    if (dot(n, n) == 0.0)
        return Plane(vec3(0), vec3(0), 0.0);
    n = normalize(n);
    float offset = 0.87 / 127.0 * float(int(word) >> 24);
    vec3 size = max(abs(n), 1e-6);
    float rest = max(0.5 * (size.x + size.y + size.z) - abs(offset), kLeastRest);
    vec3 at = signs(n) * (0.5 - min(rest / (3.0 * size), 0.5)) * (offset < 0.0 ? -1.0 : 1.0);
    return Plane(n, at + (offset - dot(n, at)) * n, rest);
}
