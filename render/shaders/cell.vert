#version 450 core
// Places one quad (or, with POINTS, one point) per cell so that it just encloses the projection of
// the cell's ellipsoid, and computes the cell's light.
//
// The paper (Vrolijk, Botha and Post 2004, section 5) projects the voxel sphere as a quadric,
// Q' = M^-T Q M^-1, with the conic C = c A - b b^T for its outline, and draws the rectangle on the
// conic's principal axes. Each cell may have its own quadric. The dual of that conic needs no
// inverse: for an ellipsoid around c whose points are c + F s, |s| = 1, it is C* = K - p p^T with
// p = M c and K = (M F) (M F)^T (rows x, y and w; without translation). This holds for every
// frustum, also off-axis and parallel, and for any spacing.

layout(binding = 0) uniform usamplerBuffer cells;

#include "frame.glsl"
#include "pixels.glsl"
#include "cell_order.glsl"
#include "cell_place.glsl"
#include "lighting.glsl"
#include "appearance.glsl"
#include "cell_box.glsl"
#include "plane.glsl"
#include "surroundings.glsl"
#include "footprint.glsl"

flat out vec4 shaded;

#ifndef POINTS
const vec2 kCorners[4] = vec2[](vec2(-1, -1), vec2(1, -1), vec2(1, 1), vec2(-1, 1));
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
    // Of the four ways to choose the same axes, take the one nearest to the screen's axes.
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

void main() {
    start_eye();
#ifdef POINTS
    int slot = slot_in_order(gl_VertexID);
#else
    int slot = slot_in_order(gl_VertexID >> 2);
    disc = kCorners[gl_VertexID & 3];
#endif
    uvec3 cell = texelFetch(cells, slot).xyz;
    CellBox box = box_of(cell);
    vec3 normal = plane_normal(cell.z);
    Splat splat = splat_of(box.size, normal, cell.z);
    vec4 center = vec4(box.middle + splat.size * splat.center, 1.0);

    uint style = cell.y >> 16;
    vec3 in_eye = (EYE(eye_from_index) * center).xyz;
    vec3 lit = shade(in_eye, normal, base_color(style));
    lit *= unshadowed(box.in_index + box.voxels * splat.center, toward_eye_in_index(center.xyz), splat.size, normal,
                      style & 7u);
    shaded = vec4(written(lit), surfaces[style & 7u].a * near_share(in_eye));

    if (!blended && shaded.a <= evenly(hash_of(cell))) {
        gl_Position = vec4(0, 0, -2, 1);
        return;
    }

    vec4 p = to_pixels(center);
    vec3 row_w = splat.size * EYE(row_w).xyz; // per voxel, as are the other rows
    float d = p.w * p.w - form(splat, spread(splat, row_w), row_w);
    vec3 from_center = EYE(eye_in_index).xyz - center.xyz;
    if (soft_near_eye && EYE(eye_in_index).w != 0.0)
        shaded.a *= smoothstep(1.0, 2.0, length(from_center / splat.size) / radius);

    if (p.w > 0.0 && d > 0.1 * p.w * p.w) {
        // Coordinates relative to the center's image keep small ellipses precise.
        vec2 m = p.xy / p.w;
        vec3 a = splat.size * EYE(row_x).xyz - m.x * row_w;
        vec3 b = splat.size * EYE(row_y).xyz - m.y * row_w;
        float k = 1.0 / d;
        vec3 along_a = spread(splat, a), along_b = spread(splat, b);
        vec2 shift = -k * vec2(form(splat, along_a, row_w), form(splat, along_b, row_w));
        vec3 shape = vec3(shift.x * shift.x + k * form(splat, along_a, a),
                          shift.x * shift.y + k * form(splat, along_a, b),
                          shift.y * shift.y + k * form(splat, along_b, b));
        vec2 at = m + shift;
#ifdef IN_CELL
        // By how much the place in the cell changes for each pixel to the right, and up.
        float share = 1.0 / (kHalfCell * radius * p.w * (shape.x * shape.z - shape.y * shape.y));
        vec3 right = share * (shape.z * along_a - shape.y * along_b);
        vec3 up = share * (shape.x * along_b - shape.y * along_a);
#endif
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
#ifdef IN_CELL
        cell_middle_place = splat.center / (kHalfCell * radius);
        cell_right = half_size * right;
        cell_up = half_size * up;
#endif
#else
#ifdef IN_CELL
        vec2 away = axes * disc;
        cell_place = splat.center / (kHalfCell * radius) + away.x * right + away.y * up;
#endif
        at += axes * disc;
#endif
#endif
        gl_Position = vec4(at * EYE(clip_per_pixel).xy * p.w, p.z, p.w);
#ifndef POINTS // points are not used if a cell comes that near
    } else {
        // The eye in coordinates in which the ellipsoid is the unit sphere.
        vec3 eye = stretched(splat, from_center / splat.size, 1.0 / splat.half_axes);
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
        vec3 from_middle = stretched(splat, at, splat.half_axes);
#ifdef IN_CELL
        cell_place = (splat.center + from_middle) / (kHalfCell * radius);
#endif
        vec4 q = to_pixels(vec4(center.xyz + splat.size * from_middle, 1.0));
        gl_Position = vec4(q.xy * EYE(clip_per_pixel).xy, q.zw);
#endif
    }
}
