// Counts the GL contexts that a test program makes, and what it draws with them. The linker leads calls of
// `stereo::make_context` and of the constructor of `render::Gl` here (`tests/CMakeLists.txt`, --wrap).
#include "render/gl/gl.h"
#include "stereo/context/gl_context.h"
#include "tests/support/test_costs.h"

#include <array>

namespace isochron::test_support {
namespace {

/// One function for each of the entry points that draw and each driver of a process.
template <auto Entry, int Driver>
struct Counted;
template <typename... Arguments, void (*render::Gl::*Entry)(Arguments...), int Driver>
struct Counted<Entry, Driver> {
    static inline void (*real)(Arguments...) = nullptr;
    static void call(Arguments... arguments) {
        ++test_costs().draws;
        real(arguments...);
    }
    /// @return whether this table's entry is counted now
    static bool take(render::Gl& gl) {
        if (real && real != gl.*Entry)
            return false;
        real = gl.*Entry;
        gl.*Entry = call;
        return true;
    }
};

template <auto Entry>
void count(render::Gl& gl) {
    if (gl.*Entry)
        Counted<Entry, 0>::take(gl) || Counted<Entry, 1>::take(gl) || Counted<Entry, 2>::take(gl);
}

void count_draws(render::Gl& gl) {
    count<&render::Gl::DrawArrays>(gl);
    count<&render::Gl::DrawArraysInstanced>(gl);
    count<&render::Gl::DrawElements>(gl);
    count<&render::Gl::DrawElementsBaseVertex>(gl);
    count<&render::Gl::DrawElementsInstanced>(gl);
    count<&render::Gl::DrawElementsInstancedBaseVertex>(gl);
    count<&render::Gl::DispatchCompute>(gl);
}

} // namespace
} // namespace isochron::test_support

// The names are those of the compiler for the two functions, so that a change of either is an error of the linker.
// NOLINTBEGIN(bugprone-reserved-identifier)
extern "C" {
using isochron::render::DrawnBy;
using isochron::render::Gl;
using isochron::render::GlLoader;
using isochron::stereo::ContextKind;
using isochron::stereo::ContextOptions;
using isochron::stereo::GlContext;

void __real__ZN8isochron6render2GlC1ERKSt8functionIFPvPKcEENS0_7DrawnByE(Gl*, const GlLoader&,
                                                                         DrawnBy);
void __wrap__ZN8isochron6render2GlC1ERKSt8functionIFPvPKcEENS0_7DrawnByE(Gl* gl,
                                                                         const GlLoader& load,
                                                                         DrawnBy drawn_by) {
    __real__ZN8isochron6render2GlC1ERKSt8functionIFPvPKcEENS0_7DrawnByE(gl, load, drawn_by);
    isochron::test_support::count_draws(*gl);
}

std::unique_ptr<GlContext>
__real__ZN8isochron6stereo12make_contextENS0_11ContextKindERKNS0_14ContextOptionsE(
    ContextKind, const ContextOptions&);
std::unique_ptr<GlContext>
__wrap__ZN8isochron6stereo12make_contextENS0_11ContextKindERKNS0_14ContextOptionsE(
    ContextKind kind, const ContextOptions& options) {
    ++isochron::test_support::test_costs().contexts;
    return __real__ZN8isochron6stereo12make_contextENS0_11ContextKindERKNS0_14ContextOptionsE(
        kind, options);
}
}
// NOLINTEND(bugprone-reserved-identifier)
