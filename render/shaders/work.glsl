// The part of the work that one dispatch does: each invocation has one thing.

layout(local_size_x = 64) in;

layout(location = 0) uniform uvec2 work; // the first, and behind the last

uint my_work() { return work.x + gl_GlobalInvocationID.x; }
