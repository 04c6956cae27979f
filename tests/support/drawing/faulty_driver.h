// A driver that fails to make one object, or to give it memory.
#pragma once

#include "render/gl/gl.h"

#include <functional>
#include <string>
#include <string_view>

namespace isochron::test_support {

/// Lets the n-th of the calls that make something fail, as a driver does whose memory is used up:
/// an object has no name, memory is not there and GL_OUT_OF_MEMORY says so, a fence is null, a
/// shader does not compile or link, a framebuffer is incomplete. There can be only one at a time,
/// because GL's functions take no user data.
/// @param at from 1; 0: none
/// @return a function that replaces entry points, as stereo::ContextInBetween needs it
std::function<void*(std::string_view name, void* found)> with_fault(long at);

/// The call that failed, as `glCreateBuffers`; empty if there were fewer calls.
std::string failed_call();

} // namespace isochron::test_support
