#version 450 core
// The trilinear surface in one cell: finds where the view ray meets it, and computes its light.
//
// Along a ray the value is a cubic. Between its turning points a cubic is monotonic, so the signs
// at the ends of these intervals show every root; Halley's method finds each one within its bounds.
// There are no branches except discards: software GL would run both sides for all pixels.

#include "frame.glsl"
#include "lighting.glsl"
#include "appearance.glsl"
#include "surface.glsl"
#include "surroundings.glsl"

out vec4 result;

// Half a side of the box, a little enlarged, so that a root on a face is found in both cells.
const float kHalf = 0.5 + 1e-5;
const int kSteps = 3; // the error is 0.001 voxel in noise, and 0.00001 on smooth surfaces

// The part of a view ray inside the cell, with its ends at s = -1 and s = 1. It is empty if its
// length is not positive.
struct Ray {
    vec3 middle, half_chord;
    float along_middle, along_half; // distance along the ray, from the plane of the cell's center
};

// The place in the target that this invocation draws, in pixels.
vec2 sight() {
#ifdef EACH_SAMPLE
    return floor(gl_FragCoord.xy) + gl_SamplePosition;
#else
    return gl_FragCoord.xy;
#endif
}

Ray ray_in_cell() {
    vec4 viewport = EYE(viewport);
    vec2 pixel = sight() - viewport.xy - 0.5 * viewport.zw;
    float perspective = EYE(eye_in_index).w;
    vec3 right = EYE(ray_right).xyz, up = EYE(ray_up).xyz;
    vec4 ahead = EYE(ray_ahead);
    vec3 direction = ahead.xyz + perspective * (pixel.x * right + pixel.y * up);
    vec2 shift = pixel * center.w - center.xy;
    vec3 origin = shift.x * right + shift.y * up;
#ifdef UNEVEN
    direction /= voxel;
    origin /= voxel;
#endif

    vec3 length_along = abs(direction);
    float tiny = 1e-8 * max(length_along.x, max(length_along.y, length_along.z)); // replaces 0, as it is divided by
    direction = mix(direction, vec3(tiny), lessThan(length_along, vec3(tiny)));
    vec3 inverse = 1.0 / direction;
    vec3 middle = -origin * inverse, reach = kHalf * abs(inverse);
    vec3 enter = middle - reach, leave = middle + reach;
    float near_plane = -(center.z + center.w) / (ahead.w + perspective);
    float first = max(max(enter.x, near_plane), max(enter.y, enter.z));
    float last = min(leave.x, min(leave.y, leave.z));
    float half_way = 0.5 * (first + last), half_length = 0.5 * (last - first);
    return Ray(origin + half_way * direction, half_length * direction, half_way, half_length);
}

// The values along the ray as a cubic in s: coefficients of 1, s, s^2, s^3.
vec4 cubic_along(Ray ray) {
    vec3 b = ray.half_chord;
    vec4 at = value_and_slope(ray.middle);
    vec3 about = mixed_at(ray.middle);
    return vec4(at.x, dot(at.yzw, b), (about.x * b.x * b.y + about.y * b.x * b.z) + about.z * b.y * b.z,
                mixed.w * b.x * b.y * b.z);
}

float value_at(vec4 k, float s) { return ((k.w * s + k.z) * s + k.y) * s + k.x; }

// In ascending order; -1 replaces those that are not between the ray's ends.
vec2 turning_points(vec4 k) {
    float cubic = 3.0 * k.w;
    float d = k.z * k.z - cubic * k.y;
    float root = sqrt(max(d, 0.0));
    float q = -(k.z + (k.z >= 0.0 ? root : -root));
    float a = d > 0.0 && abs(q) < abs(cubic) ? q / cubic : -1.0;
    float b = d > 0.0 && abs(k.y) < abs(q) ? k.y / q : -1.0;
    return vec2(min(a, b), max(a, b));
}

// The root between two points whose values have different signs, without a turning point in
// between.
float root_between(vec4 k, float low, float high, float f_low, float f_high) {
    bool above = f_low >= 0.0;
    float s = low + (high - low) * f_low / (f_low - f_high);
    for (int i = 0; i < kSteps; ++i) {
        float f = value_at(k, s);
        float slope = (3.0 * k.w * s + 2.0 * k.z) * s + k.y;
        float bend = 6.0 * k.w * s + 2.0 * k.z;
        bool before = (f >= 0.0) == above;
        low = before ? s : low;
        high = before ? high : s;
        float halley = s - 2.0 * f * slope / (2.0 * slope * slope - f * bend);
        s = halley >= low && halley <= high ? halley : 0.5 * (low + high);
    }
    return s;
}

// The gradient towards lower values, in physical space, interpolated between the vertices: unlike
// the slope of the cell's own polynomial, it is continuous from cell to cell.
vec3 gradient(vec3 p) {
    vec3 along_y = gradient_linear[2] + p.x * gradient_mixed[0];
    vec3 along_z = gradient_linear[3] + p.x * gradient_mixed[1] +
                   p.y * (gradient_mixed[2] + p.x * gradient_mixed[3]);
    return gradient_linear[0] + p.x * gradient_linear[1] + p.y * along_y + p.z * along_z;
}

float depth_at(Ray ray, float s) {
    float along = ray.along_middle + s * ray.along_half;
    float w = center.w + along * EYE(eye_in_index).w;
    return 0.5 + 0.5 * (center.z + along * EYE(ray_ahead).w) / w;
}

vec3 place_at(Ray ray, float s) { return ray.middle + s * ray.half_chord; }

#ifndef UNEVEN
const vec3 voxel = vec3(1);
#define center_place center_in_index
#endif

vec3 in_eye(vec3 p) { return center_in_eye + mat3(EYE(eye_from_index)) * (voxel * p); }

// The color at a point, in linear light: interpolated as the surface's own value is.
vec3 base_at(vec3 p) {
#ifdef COLORS
    vec3 about = color_mixed.xyz + color_mixed.w * p.zyx;
    float share = color_linear.x + color_linear.y * p.x + (color_linear.z + color_mixed.x * p.x) * p.y +
                  (color_linear.w + color_mixed.y * p.x + about.z * p.y) * p.z;
    return color_known == 0u ? no_value.rgb : mapped_color(share);
#else
    return base.rgb;
#endif
}

#ifndef BLENDED
vec3 light_at(vec3 p) {
    vec3 normal = gradient(p);
    vec3 toward_eye = toward_eye_in_index(center_place + voxel * p);
    float share = unshadowed(center_in_index + p, toward_eye, voxel, normal, surface);
    return written(share * shade(in_eye(p), normal, base_at(p)));
}
#else
// Pre-multiplied.
vec4 layer_at(vec3 p) {
    vec3 normal = gradient(p);
    vec3 toward_eye = toward_eye_in_index(center_place + voxel * p);
    float share = unshadowed(center_in_index + p, toward_eye, voxel, normal, surface);
    vec2 lit = share * light_in_eye(in_eye(p), mat3(EYE(eye_from_physical)) * normal);
    return layer_of(base_at(p), lit, turned, base.a) * near_share(in_eye(p));
}
#endif

void main() {
    Ray ray = ray_in_cell();
    vec4 k = cubic_along(ray);
    vec2 turns = turning_points(k);
    float f0 = value_at(k, -1.0), f1 = value_at(k, turns.x), f2 = value_at(k, turns.y), f3 = value_at(k, 1.0);
    // Whether the sign differs between the start and the first turning point, the second, the end.
    bool first = (f0 >= 0.0) != (f1 >= 0.0), second = (f0 >= 0.0) != (f2 >= 0.0);
    bool third = (f0 >= 0.0) != (f3 >= 0.0);
    if (!(ray.along_half > 0.0) || !(first || second || third))
        discard;
    float nearest = root_between(k, first ? -1.0 : second ? turns.x : turns.y,
                                 first ? turns.x : second ? turns.y : 1.0,
                                 first ? f0 : second ? f1 : f2, first ? f1 : second ? f2 : f3);
    gl_FragDepth = depth_at(ray, nearest);
    vec3 p = place_at(ray, nearest);
#ifndef BLENDED
    if (near_share(in_eye(p)) <= grain(p, hash))
        discard;
    result = vec4(light_at(p), 1.0);
#else
    // There may be two more layers behind the nearest one.
    bool to_third = second != third, to_second = first != second;
    vec4 behind = vec4(0);
    if (to_third && (first || second))
        behind = layer_at(place_at(ray, root_between(k, turns.y, 1.0, f2, f3)));
    if (to_second && first) {
        vec4 middle = layer_at(place_at(ray, root_between(k, turns.x, turns.y, f1, f2)));
        behind = middle + behind * (1.0 - middle.a);
    }
    vec4 front = layer_at(p);
    result = front + behind * (1.0 - front.a);
#endif
}
