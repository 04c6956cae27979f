// A splat, or a quad of a voxel's sphere: the outline of an ellipsoid in the picture, or the rectangle
// around it; needs frame.glsl, pixels.glsl, plane.glsl and footprint.glsl.
//
// The paper (Vrolijk, Botha and Post 2004, section 5) projects the voxel sphere as a quadric,
// Q' = M^-T Q M^-1, with the conic C = c A - b b^T for its outline, and draws the rectangle on the
// conic's principal axes. Each cell may have its own quadric. The dual of that conic needs no
// inverse: for an ellipsoid around c whose points are c + F s, |s| = 1, it is C* = K - p p^T with
// p = M c and K = (M F) (M F)^T (rows x, y and w; without translation). This holds for every
// frustum, also off-axis and parallel, and for any spacing.
//
// With PLANE the ellipsoid is flat: it lies on the plane of the surface in the cell, around the part
// of that plane inside the cell. Without PLANE it is the voxel's sphere.

struct Footprint {
    vec3 center; // voxels from the cell's middle
#ifdef PLANE
    vec3 normal, lengthwise; // two axes; the third is at right angles to both
#endif
    vec3 half_axes; // along the normal, lengthwise, across [voxels]
};

#ifdef PLANE
// As render/cells/cell_shape.h has them.
const float kThickness = 0.125, kLengthwise = 1.3, kLeastWidth = 0.15;

// The longest of the distances at which the plane cuts the three edges at the corner that is farthest
// out on its side gives the ellipsoid's length; the second gives its width, whose ends overlap the
// neighbors'.
Footprint footprint_of(vec3 voxel, vec3 normal, uint word) {
    Plane plane = plane_in(voxel, normal, word);
    bool flat_one = plane.normal != vec3(0);
    vec3 n = flat_one ? plane.normal : vec3(0, 0, 1);
    vec3 size = max(abs(n), 1e-6);
    float least = min(size.x, min(size.y, size.z));
    float median = max(min(size.x, size.y), min(max(size.x, size.y), size.z));
    vec3 edge = size.x == least ? vec3(1, 0, 0) : size.y == least ? vec3(0, 1, 0) : vec3(0, 0, 1);
    vec2 lengths = clamp(plane.rest * vec2(kLengthwise / least, 1.0 / median), kLeastWidth, 1.0);
    return Footprint(plane.middle, n, normalize(edge - dot(edge, n) * n),
                     radius * (flat_one ? vec3(kThickness, lengths) : vec3(1)));
}

// The shape F F^T of the ellipsoid, whose points are F s with |s| = 1, between two vectors in the cell
// [voxels].
float form(Footprint s, vec3 u, vec3 v) {
    vec3 squares = s.half_axes * s.half_axes;
    return squares.z * dot(u, v) + (squares.x - squares.z) * dot(u, s.normal) * dot(v, s.normal) +
           (squares.y - squares.z) * dot(u, s.lengthwise) * dot(v, s.lengthwise);
}

// Stretches a vector in the cell along the ellipsoid's axes.
vec3 stretched(Footprint s, vec3 v, vec3 by) {
    return by.z * v + (by.x - by.z) * dot(v, s.normal) * s.normal +
           (by.y - by.z) * dot(v, s.lengthwise) * s.lengthwise;
}
#else
Footprint footprint_of(vec3 voxel, vec3 normal, uint word) { return Footprint(vec3(0), vec3(radius)); }
float form(Footprint s, vec3 u, vec3 v) { return s.half_axes.x * s.half_axes.x * dot(u, v); }
vec3 stretched(Footprint s, vec3 v, vec3 by) { return by * v; }
#endif

// A matrix F with F F^T = s, the ellipse's shape in pixels: it leads from the unit disc to the
// ellipse. For an ellipse in a point any will do. For a rectangle its columns are the half axes; if
// the ellipse is nearly a circle these are arbitrary, so the quad is turned upright instead.
mat2 half_axes(float xx, float xy, float yy) {
#if defined(POINTS) && defined(ROUND)
    float right = sqrt(xx);
    float aside = xy / right;
    return mat2(right, aside, 0, sqrt(max(yy - aside * aside, 1e-6 * yy)));
#else
    float h = 0.5 * (xx - yy), mean = 0.5 * (xx + yy);
    float t = sqrt(h * h + xy * xy);
    float major = mean + t;
    float minor = max(xx * yy - xy * xy, 0.0) / major;
    vec2 u = h >= 0.0 ? vec2(h + t, xy) : vec2(xy, t - h);
    u = t > 1e-6 * mean ? normalize(u) : vec2(1, 0);
    vec2 lengths = sqrt(vec2(major, minor));
    // Four choices of axes are the same ellipse: take the one nearest to the screen's axes.
    if (abs(u.y) > abs(u.x)) {
        u = vec2(u.y, -u.x);
        lengths = lengths.yx;
    }
    u *= u.x < 0.0 ? -1.0 : 1.0;
    vec2 q = normalize(mix(vec2(1, 0), u, smoothstep(0.1, 0.3, t / mean)));
    float c = dot(u, q), s = q.x * u.y - q.y * u.x;
    return mat2(u, vec2(-u.y, u.x)) * mat2(lengths.x, 0, 0, lengths.y) * mat2(c, -s, s, c);
#endif
}

// @param center even coordinates
void draw(Footprint splat, vec3 voxel, vec3 center, uvec2 part) {
    vec4 p = to_pixels(vec4(center, 1.0));
    vec3 row_w = voxel * EYE(row_w).xyz; // per voxel, as are the other rows
    float d = p.w * p.w - form(splat, row_w, row_w);
    vec3 from_center = EYE(eye_in_index).xyz - center;
    if (soft_near_eye && EYE(eye_in_index).w != 0.0)
        shaded.a *= smoothstep(1.0, 2.0, length(from_center / voxel) / radius);

    if (p.w > 0.0 && d > 0.1 * p.w * p.w) {
        // Coordinates relative to the center's image keep small ellipses precise.
        vec2 m = p.xy / p.w;
        vec3 a = voxel * EYE(row_x).xyz - m.x * row_w;
        vec3 b = voxel * EYE(row_y).xyz - m.y * row_w;
        float k = 1.0 / d;
        vec2 shift = -k * vec2(form(splat, a, row_w), form(splat, b, row_w));
        vec3 shape = vec3(shift.x * shift.x + k * form(splat, a, a), shift.x * shift.y + k * form(splat, a, b),
                          shift.y * shift.y + k * form(splat, b, b));
        vec2 at = m + shift;
#ifdef SQUARE
        gl_PointSize = 2.0 * sqrt(max(shape.x, shape.z));
#else
        mat2 axes = half_axes(shape.x, shape.y, shape.z);
#ifdef POINTS
        // The square around the ellipse, or around the rectangle on its axes.
#ifdef ROUND
        float half_size = sqrt(max(shape.x, shape.z));
#else
        vec2 reach = abs(axes[0]) + abs(axes[1]);
        float half_size = max(reach.x, reach.y);
#endif
        mat2 from_point = half_size * inverse(axes);
        disc_from_point = vec4(from_point[0], from_point[1]);
        gl_PointSize = 2.0 * half_size;
#else
        at += axes * disc;
#endif
#endif
        gl_Position = vec4(at * EYE(clip_per_pixel).xy * p.w, p.z, p.w);
#ifndef POINTS // points are not used if a cell comes that near
    } else {
        // The eye in coordinates in which the ellipsoid is the unit sphere.
        vec3 eye = stretched(splat, from_center / voxel, 1.0 / splat.half_axes);
        float eye_distance2 = dot(eye, eye);
        if (EYE(eye_in_index).w == 0.0 || eye_distance2 <= 1.0) {
            gl_Position = vec4(0, 0, -2, 1); // the eye is inside: draw nothing
            return;
        }
        // The ellipsoid reaches behind the eye. Its silhouette, a circle in these coordinates, is
        // drawn in its own plane and clipped.
        float along = 1.0 / eye_distance2;
        float size = sqrt(1.0 - along);
        vec3 v = abs(eye);
        vec3 least = v.x <= v.y && v.x <= v.z ? vec3(1, 0, 0) : v.y <= v.z ? vec3(0, 1, 0) : vec3(0, 0, 1);
        vec3 e1 = normalize(cross(eye, least));
        vec3 e2 = normalize(cross(eye, e1));
        vec3 at = along * eye + size * (disc.x * e1 + disc.y * e2);
        vec4 q = to_pixels(vec4(center + voxel * stretched(splat, at, splat.half_axes), 1.0));
        gl_Position = vec4(q.xy * EYE(clip_per_pixel).xy, q.zw);
#endif
    }
}
