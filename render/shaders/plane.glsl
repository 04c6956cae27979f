// The ellipsoid that a cell's quad or splat stands for, in the cell; needs frame.glsl.
//
// With PLANE it is flat: it lies on the plane of the surface in the cell (index::CellPlane), around
// the part of that plane inside the cell. With IN_CELL only what lies in the cell, a little enlarged,
// is drawn of it. Without PLANE it is the voxel's sphere.

struct Splat {
    vec3 center; // voxels from the cell's middle
    vec3 size;   // of the cell, even coordinates
#ifdef PLANE
    vec3 normal, lengthwise; // two axes; the third is at right angles to both
#endif
    vec3 half_axes; // along the normal, lengthwise, across [voxels]
};

// The plane's normal in physical space; zero if there is none.
vec3 plane_normal(uint word) {
    vec2 at = (vec2(word & 0xfffu, word >> 12 & 0xfffu) - 2048.0) / 2047.0;
    vec3 n = vec3(at, 1.0 - abs(at.x) - abs(at.y));
    float fold = max(-n.z, 0.0);
    n.xy -= vec2(n.x < 0.0 ? -fold : fold, n.y < 0.0 ? -fold : fold);
    return (word & 0xffffffu) == 0u ? vec3(0) : normalize(n);
}

#ifdef PLANE
// As render/cells/cell_shape.h has them.
#ifdef QUAD
const float kThickness = 0.03, kLengthwise = 0.8;
#else
const float kThickness = 0.125, kLengthwise = 1.3;
#endif
const float kLeastWidth = 0.15, kLeastRest = 0.007, kHalfCell = 0.7;

vec3 signs(vec3 v) { return vec3(v.x < 0.0 ? -1.0 : 1.0, v.y < 0.0 ? -1.0 : 1.0, v.z < 0.0 ? -1.0 : 1.0); }

// `rest` is the distance from the plane to the corner of the cell that is farthest out on the
// plane's side. The plane cuts each edge at that corner at a distance of `rest` divided by the
// normal's component along the edge, at most the whole edge. The longest of these three distances
// gives the ellipsoid's length; the second gives its width, whose ends overlap the neighbors'. From
// the corner, a third of each distance along its edge leads to a point near the middle of the
// plane's part in the cell.
Splat splat_of(vec3 voxel, vec3 normal, uint word) {
    vec3 n = voxel * to_index(normal);
    bool flat_one = dot(n, n) > 0.0;
    n = flat_one ? normalize(n) : vec3(0, 0, 1);
    float offset = 0.87 / 127.0 * float(int(word) >> 24);
    vec3 size = max(abs(n), 1e-6);
    float rest = max(0.5 * (size.x + size.y + size.z) - abs(offset), kLeastRest);
    float least = min(size.x, min(size.y, size.z));
    float median = max(min(size.x, size.y), min(max(size.x, size.y), size.z));

    vec3 at = signs(n) * (0.5 - min(rest / (3.0 * size), 0.5)) * (offset < 0.0 ? -1.0 : 1.0);
    at += (offset - dot(n, at)) * n;
    vec3 edge = size.x == least ? vec3(1, 0, 0) : size.y == least ? vec3(0, 1, 0) : vec3(0, 0, 1);
    vec2 lengths = clamp(rest * vec2(kLengthwise / least, 1.0 / median), kLeastWidth, 1.0);
    return Splat(flat_one ? at : vec3(0), voxel, n, normalize(edge - dot(edge, n) * n),
                 radius * (flat_one ? vec3(kThickness, lengths) : vec3(1)));
}

// The shape F F^T of the ellipsoid, whose points are F s with |s| = 1, times a vector in the cell
// [voxels]: as far as it goes in that direction, times the place where it goes that far.
vec3 spread(Splat s, vec3 u) {
    vec3 squares = s.half_axes * s.half_axes;
    return squares.z * u + (squares.x - squares.z) * dot(u, s.normal) * s.normal +
           (squares.y - squares.z) * dot(u, s.lengthwise) * s.lengthwise;
}

// u . v in that shape. @param along u, spread
float form(Splat s, vec3 along, vec3 v) { return dot(along, v); }

// Stretches a vector in the cell along the ellipsoid's axes.
vec3 stretched(Splat s, vec3 v, vec3 by) {
    return by.z * v + (by.x - by.z) * dot(v, s.normal) * s.normal +
           (by.y - by.z) * dot(v, s.lengthwise) * s.lengthwise;
}
#else
Splat splat_of(vec3 voxel, vec3 normal, uint word) { return Splat(vec3(0), voxel, vec3(radius)); }
vec3 spread(Splat s, vec3 u) { return u; }
float form(Splat s, vec3 along, vec3 v) { return s.half_axes.x * s.half_axes.x * dot(along, v); }
vec3 stretched(Splat s, vec3 v, vec3 by) { return by * v; }
#endif
