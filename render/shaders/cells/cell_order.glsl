// The order in which cells are drawn; needs frame.glsl.

layout(binding = 1) uniform usamplerBuffer order; // order for the first eye
layout(binding = 2) uniform usamplerBuffer order_of_other_eye;

// @return of the n-th drawn cell: its slot, and a square around what is seen of it: its lower left
// pixel (x, and y from bit 16 on), and its size [pixel], 0 if that is not known
uvec3 in_order(int n) {
    if (order_step == 0)
        return uvec3(order_begin + n, 0, 0);
    int at = order_begin + n * order_step;
    return EYE_INDEX == 0 ? texelFetch(order, at).xyz : texelFetch(order_of_other_eye, at).xyz;
}

// @return slot of the n-th drawn cell
int slot_in_order(int n) { return int(in_order(n).x); }
