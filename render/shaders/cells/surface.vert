#version 450 core
// Places one quad per cell so that it encloses the surface in it, and prepares what its fragments
// need to find that surface.
//
// Most of a cell's box is empty. On a smooth surface a rectangle around the surface has a third of
// the pixels of one around the box, and each pixel costs the search for a root.

layout(binding = 0) uniform usamplerBuffer cells;
layout(binding = 3) uniform samplerBuffer corner_values;
layout(binding = 4) uniform usamplerBuffer corner_gradients;
#ifdef COLORS
layout(binding = 8) uniform usamplerBuffer corner_colors;
#endif

#include "frame.glsl"
#include "pixels.glsl"
#include "cell_order.glsl"
#include "cell_place.glsl"
#include "srgb.glsl"
#include "appearance.glsl"
#include "surface.glsl"

const vec2 kCorners[4] = vec2[](vec2(-1, -1), vec2(1, -1), vec2(1, 1), vec2(-1, 1));
const float kMargin = 0.002; // around the surface [voxels], so that rounding leaves no gaps

// @param low, high values at the corners with the lower and the higher z, x fastest
void find_polynomial(vec4 low, vec4 high, out vec4 linear, out vec4 mixed) {
    const vec4 kOne = vec4(1), kX = vec4(-1, 1, -1, 1), kY = vec4(-1, -1, 1, 1), kXY = kX * kY;
    vec4 sum = low + high, difference = high - low;
    linear = vec4(0.125 * dot(sum, kOne), 0.25 * dot(sum, kX), 0.25 * dot(sum, kY),
                  0.25 * dot(difference, kOne));
    mixed = vec4(0.5 * dot(sum, kXY), 0.5 * dot(difference, kX), 0.5 * dot(difference, kY),
                 dot(difference, kXY));
}

// Zero if it is not finite, for example because a neighbor is not a number.
vec3 unpack_gradient(uvec2 words) {
    vec3 g = vec3(unpackHalf2x16(words.x), unpackHalf2x16(words.y).x);
    return dot(g, g) < 1e30 ? g : vec3(0);
}

void set_gradient(int corners) {
    vec3 sum[4], difference[4]; // sum and difference of the two corners along x
    for (int i = 0; i < 4; ++i) {
        uvec4 words = texelFetch(corner_gradients, 4 * corners + i);
        vec3 first = unpack_gradient(words.xy), second = unpack_gradient(words.zw);
        sum[i] = first + second;
        difference[i] = second - first;
    }
    gradient_linear[0] = 0.125 * (sum[0] + sum[1] + sum[2] + sum[3]);
    gradient_linear[1] = 0.25 * (difference[0] + difference[1] + difference[2] + difference[3]);
    gradient_linear[2] = 0.25 * (sum[1] - sum[0] + sum[3] - sum[2]);
    gradient_linear[3] = 0.25 * (sum[2] - sum[0] + sum[3] - sum[1]);
    gradient_mixed[0] = 0.5 * (difference[1] - difference[0] + difference[3] - difference[2]);
    gradient_mixed[1] = 0.5 * (difference[2] - difference[0] + difference[3] - difference[1]);
    gradient_mixed[2] = 0.5 * (sum[3] - sum[2] - sum[1] + sum[0]);
    gradient_mixed[3] = difference[3] - difference[2] - difference[1] + difference[0];
}

// The range of the surface along an axis, within -0.5 to 0.5, from the values at both ends of the
// four edges along it, which are linear in between: where the edges have values of both signs.
// Empty (first > last) without a surface.
vec2 extent(vec4 from, vec4 to) {
    bvec4 above_from = greaterThanEqual(from, vec4(0)), above_to = greaterThanEqual(to, vec4(0));
    bvec4 crossed = notEqual(above_from, above_to);
    vec4 crossing = from / (from - to) - 0.5;
    vec4 first = mix(vec4(1), crossing, crossed), last = mix(vec4(-1), crossing, crossed);
    return vec2(any(above_from) && !all(above_from) ? -0.5 : min(min(first.x, first.y), min(first.z, first.w)),
                any(above_to) && !all(above_to) ? 0.5 : max(max(last.x, last.y), max(last.z, last.w)));
}

// A bound of the surface: the part of a box that lies between two parallel planes.
struct Slab {
    vec3 middle, half_size; // middle and half the size of the box
    float value;            // value of a linear function, at the box's middle
    vec3 slope;             // its change from there to the box's faces
    float tolerance;        // the planes are where this function is +tolerance and -tolerance
};

Slab slab_in(vec3 lower, vec3 upper) {
    vec3 m = 0.5 * (lower + upper), h = 0.5 * (upper - lower);
    vec4 at = value_and_slope(m);
    vec3 about = abs(mixed_at(m));
    float bend = (about.x * h.x * h.y + about.y * h.x * h.z) + (about.z + abs(mixed.w) * h.x) * h.y * h.z;
    return Slab(m, h, at.x, at.yzw * h, bend + 1e-5);
}

// Projects a point p, relative to the middle of the slab's box, to
// (dot(x, p), dot(y, p)) / (w + dot(z, p)).
struct Projection {
    vec3 x, y, z;
    float w;
};

// The rectangle around the projection of a slab: around the ends of the parts of the box's edges
// that lie between the planes.
void enclose(Projection to, Slab slab, out vec2 least, out vec2 most) {
    least = vec2(3e38);
    most = vec2(-3e38);
    mat3 steps = transpose(mat3(to.x * slab.half_size, to.y * slab.half_size, to.z * slab.half_size));
    for (int axis = 0; axis < 3; ++axis) {
        int u = (axis + 1) % 3, v = (axis + 2) % 3;
        float slope = slab.slope[axis];
        float inverse = 1.0 / (abs(slope) > 1e-20 ? slope : 1e-20);
        float reach = slab.tolerance * abs(inverse);
        for (int edge = 0; edge < 4; ++edge) {
            float at_u = float(edge & 1) * 2.0 - 1.0, at_v = float(edge >> 1) * 2.0 - 1.0;
            float middle = -(slab.value + at_u * slab.slope[u] + at_v * slab.slope[v]) * inverse;
            float from = max(middle - reach, -1.0), to_end = min(middle + reach, 1.0);
            vec3 base = vec3(0, 0, to.w) + at_u * steps[u] + at_v * steps[v];
            vec3 p = base + from * steps[axis], q = base + to_end * steps[axis];
            vec2 a = p.xy / p.z, b = q.xy / q.z;
            bool inside = from <= to_end;
            least = inside ? min(least, min(a, b)) : least;
            most = inside ? max(most, max(a, b)) : most;
        }
    }
}

vec3 least_axis(vec3 v) {
    v = abs(v);
    return v.x <= v.y && v.x <= v.z ? vec3(1, 0, 0) : v.y <= v.z ? vec3(0, 1, 0) : vec3(0, 0, 1);
}

// A quad's corner in clip space. Its depth is not used, and keeps away from the near and far
// planes.
vec4 corner_around(Slab slab, vec3 cell_center, vec3 voxel, vec2 corner) {
    vec4 seen = to_pixels(vec4(cell_center + voxel * slab.middle, 1.0));
    vec3 row_w = voxel * EYE(row_w).xyz;
    // The projection to the screen, turned so that a long cell gets a narrow rectangle.
    vec2 at = seen.xy / seen.w;
    vec3 right = voxel * EYE(row_x).xyz - at.x * row_w, up = voxel * EYE(row_y).xyz - at.y * row_w;
    vec3 lengths = right * right + up * up;
    vec2 longest = lengths.x >= lengths.y && lengths.x >= lengths.z ? vec2(right.x, up.x)
                   : lengths.y >= lengths.z                         ? vec2(right.y, up.y)
                                                                    : vec2(right.z, up.z);
    vec2 u = normalize(longest), v = vec2(-u.y, u.x);
    Projection on_screen = Projection(u.x * right + u.y * up, v.x * right + v.y * up, row_w, seen.w);

    // For a box that reaches behind the eye's plane: a projection along the direction to the box's
    // nearest point, for which the whole box is ahead of the eye.
    vec3 to_middle = (cell_center + voxel * slab.middle - EYE(eye_in_index).xyz) / voxel;
    vec3 nearest = to_middle - clamp(to_middle, -slab.half_size, slab.half_size);
    bool around_eye = nearest == vec3(0);
    vec3 ahead = normalize(around_eye ? vec3(1) : nearest);
    vec3 e1 = normalize(cross(ahead, least_axis(ahead))), e2 = cross(ahead, e1);
    // Add a share of `ahead` to both directions, as the middle may be off the axis.
    float distance_ahead = dot(ahead, to_middle);
    vec2 offset = vec2(dot(e1, to_middle), dot(e2, to_middle)) / distance_ahead;
    Projection beside = Projection(e1 - offset.x * ahead, e2 - offset.y * ahead, ahead, distance_ahead);

    bool in_front = seen.w - dot(abs(row_w), slab.half_size) > 0.05 * seen.w;
    Projection to = beside;
    if (in_front)
        to = on_screen;
    vec2 least, most;
    enclose(to, slab, least, most);
    vec2 q = mix(least, most, 0.5 + 0.5 * corner);
    vec2 pixel = at + q.x * u + q.y * v;
    vec4 towards = to_pixels(vec4(voxel * (ahead + (offset.x + q.x) * e1 + (offset.y + q.y) * e2), 0.0));
    if (in_front)
        return vec4(pixel * EYE(clip_per_pixel).xy * seen.w, 0.0, seen.w);
    return around_eye ? vec4(corner, 0.0, 1.0) : vec4(towards.xy * EYE(clip_per_pixel).xy, 0.0, towards.w);
}

void main() {
    start_eye();
    int number = gl_VertexID >> 2, slot = slot_in_order(number);
    int corners = corners_by_slot ? slot : number;
    uvec3 cell = texelFetch(cells, slot).xyz;
    ivec3 place = ivec3(cell.x & 0xffffu, cell.x >> 16, cell.y & 0xffffu);
    vec3 of_cell = cell_size(place);
    vec4 at = vec4(cell_middle(place), 1.0);
    center = to_pixels(at);
    hash = hash_of(cell);
    center_in_eye = (EYE(eye_from_index) * at).xyz;
    uint style = cell.y >> 16;
    surface = style & 7u;
    center_in_index = vec3(place) + 0.5;
#ifdef UNEVEN
    voxel = of_cell;
    center_place = at.xyz;
#endif
    base = vec4(base_color(style), surfaces[style & 7u].a);

    vec4 low = texelFetch(corner_values, 2 * corners), high = texelFetch(corner_values, 2 * corners + 1);
    vec4 size = max(abs(low), abs(high));
    float largest = max(max(size.x, size.y), max(size.z, size.w));
    low /= largest;
    high /= largest;
    find_polynomial(low, high, linear, mixed);
    set_gradient(corners);
#ifdef COLORS
    // Two corners along x in each word.
    uvec4 words = texelFetch(corner_colors, slot);
    uvec4 first = words & 0xffffu, second = words >> 16;
    color_known = all(lessThan(max(first, second), uvec4(65535u))) ? 1u : 0u;
    find_polynomial(vec4(first.x, second.x, first.y, second.y) / 65534.0,
                    vec4(first.z, second.z, first.w, second.w) / 65534.0, color_linear, color_mixed);
#endif

    vec2 x = extent(vec4(low.xz, high.xz), vec4(low.yw, high.yw));
    vec2 y = extent(vec4(low.xy, high.xy), vec4(low.zw, high.zw));
    vec2 z = extent(low, high);
    bool has_surface = x.x <= x.y && y.x <= y.y && z.x <= z.y; // false if a value is not finite
    has_surface = has_surface && (drawn_surfaces >> (style & 7u) & 1) != 0;
    Slab slab = slab_in(vec3(x.x, y.x, z.x) - kMargin, vec3(x.y, y.y, z.y) + kMargin);
    gl_Position = has_surface ? corner_around(slab, at.xyz, of_cell, kCorners[gl_VertexID & 3]) : vec4(0, 0, 0, 1);
}
