// The order in which cells are drawn; needs frame.glsl.

layout(binding = 1) uniform usamplerBuffer order; // of the first eye
layout(binding = 2) uniform usamplerBuffer order_of_other_eye;

// @return slot of the n-th drawn cell
int slot_in_order(int n) {
    if (order_step == 0)
        return n;
    int at = order_begin + n * order_step;
    return int((EYE_INDEX == 0 ? texelFetch(order, at) : texelFetch(order_of_other_eye, at)).x);
}
