// A fast quad on a plane: the part of the surface's plane that lies in the cell, a little enlarged;
// needs frame.glsl, pixels.glsl, plane.glsl and footprint.glsl.
//
// Each of the three pairs of faces of the cell bounds a stripe of the plane, and so of the picture.
// What lies in all three is drawn, flat and of one depth. Near the eye, where stripes in the picture
// would be bent, stripes of the plane itself are taken. `radius` is half a side of the enlarged cell.

// As render/cells/cell_shape.h has them.
const float kLeastCosine = 0.02;
const float kNearEye = 2.0;

const float kParallel = 1e-5, kFar = 1e9;
const float kAround = 0.25; // more than GL rounds places and sizes of points [pixel]

struct Footprint {
    vec3 center; // voxels from the cell's middle
    vec3 normal;
};

Footprint footprint_of(vec3 voxel, vec3 normal, uint word) {
    Plane plane = plane_in(voxel, normal, word);
    return Footprint(plane.middle, plane.normal);
}

// A place in the cell, in halves of the enlarged cell's sides, as a linear function of one on the
// plane or in the picture.
struct Stripes {
    vec3 start, right, up;
};

// The rectangle around the places in all three stripes: around the parallelogram in which two of
// them cross, for each two of the three.
void enclose(Stripes of, out vec2 low, out vec2 high) {
    vec3 right = abs(of.right), up = abs(of.up), crossing = cross(of.right, of.up);
    // Two stripes that are parallel bound nothing.
    vec3 products = right.yzx * up.zxy + right.zxy * up.yzx;
    bvec3 cross_each_other = greaterThan(abs(crossing), kParallel * products);
    vec3 share = mix(vec3(0), 1.0 / crossing, cross_each_other);
    vec3 x = share * cross(of.up, of.start), y = share * cross(of.start, of.right);
    vec3 across = mix(vec3(kFar), abs(share) * (up.yzx + up.zxy), cross_each_other);
    vec3 high_up = mix(vec3(kFar), abs(share) * (right.yzx + right.zxy), cross_each_other);
    vec3 x_low = x - across, y_low = y - high_up, x_high = x + across, y_high = y + high_up;
    low = vec2(max(max(x_low.x, x_low.y), x_low.z), max(max(y_low.x, y_low.y), y_low.z));
    high = vec2(min(min(x_high.x, x_high.y), x_high.z), min(min(y_high.x, y_high.y), y_high.z));
}

// @param center even coordinates
// @param part of the picture in which the cell is seen, as in_order has it
void draw(Footprint plane, vec3 voxel, vec3 center, uvec2 part) {
    gl_Position = vec4(0, 0, -2, 1); // where nothing is drawn
    vec4 p = to_pixels(vec4(center, 1.0));
    vec3 row_w = voxel * EYE(row_w).xyz;
    vec2 middle = p.xy / p.w;
    vec3 a = voxel * EYE(row_x).xyz - middle.x * row_w, b = voxel * EYE(row_y).xyz - middle.y * row_w;
    vec3 ahead = cross(a, b);
#ifndef POINTS // points are not used if a cell comes that near
    vec4 eye = EYE(eye_in_index);
    vec3 to_eye = (eye.xyz - eye.w * center) / voxel;
    bool is_near = !(p.w > kNearEye * dot(abs(row_w), vec3(1)));
    if (is_near)
        ahead = to_eye;
    vec3 from_middle = abs(to_eye + plane.center);
    if (eye.w != 0.0 && max(max(from_middle.x, from_middle.y), from_middle.z) <= radius)
        return; // the eye is in the cell
#endif

    // A plane that is seen edge-on is turned a little; one without a normal faces the eye.
    vec3 n = plane.normal;
    float facing = dot(n, ahead), ahead2 = dot(ahead, ahead), least = kLeastCosine * sqrt(ahead2);
    if (abs(facing) < least) {
        float enough = facing < 0.0 ? -least : least;
        n += (enough - facing) / ahead2 * ahead;
        facing = enough;
    }
    Stripes stripes = Stripes(plane.center, cross(b, n) * (p.w / facing), cross(n, a) * (p.w / facing));
#ifndef POINTS
    if (is_near) {
        vec3 about = abs(n);
        vec3 least_axis = about.x <= about.y && about.x <= about.z ? vec3(1, 0, 0)
                          : about.y <= about.z                     ? vec3(0, 1, 0)
                                                                   : vec3(0, 0, 1);
        stripes.right = normalize(cross(n, least_axis));
        stripes.up = normalize(cross(n, stripes.right));
    }
#endif
    stripes = Stripes(stripes.start / radius, stripes.right / radius, stripes.up / radius);
    vec2 low, high;
    enclose(stripes, low, high);
    if (low.x > high.x || low.y > high.y)
        return; // the plane passes by the cell

#ifdef POINTS
    vec2 half_view = 0.5 * EYE(viewport).zw, in_target = EYE(viewport).xy + half_view + middle;
    vec3 start = stripes.start - in_target.x * stripes.right - in_target.y * stripes.up;
    for (int axis = 0; axis < 3; ++axis)
        stripe[axis] = vec4(start[axis], stripes.right[axis], stripes.up[axis], shaded[axis]);
    vec2 at = middle + 0.5 * (low + high), half_size = 0.5 * (high - low);
    gl_PointSize = 2.0 * max(half_size.x, half_size.y) + kAround;
    if (part.y != 0u) {
        gl_PointSize = float(part.y);
        vec2 farthest = max(half_view - 0.5 * gl_PointSize, 0.0);
        at = clamp(vec2(part.x & 0xffffu, part.x >> 16) - farthest, -farthest, farthest);
    }
#else
    vec2 at = mix(low, high, 0.5 + 0.5 * disc);
    cell_place = stripes.start + at.x * stripes.right + at.y * stripes.up;
    if (is_near) {
        vec4 q = to_pixels(vec4(center + voxel * (radius * cell_place - plane.center), 1.0));
        gl_Position = vec4(q.xy * EYE(clip_per_pixel).xy, q.zw);
        return;
    }
    at += middle;
#endif
    gl_Position = vec4(at * EYE(clip_per_pixel).xy * p.w, p.z, p.w);
}
