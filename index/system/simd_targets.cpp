// The SIMD targets of this processor, as Highway asks for them: these three functions are all that is needed
// of its library, which measures a timer for 2 ms whenever it is loaded, thus in each command.
#include <hwy/targets.h>

#include <cstdint>
#include <cstdlib>

namespace hwy {

std::int64_t SupportedTargets() {
    static const std::int64_t targets = [] {
        std::int64_t all = HWY_STATIC_TARGET | HWY_EMU128 | HWY_SCALAR;
        if (__builtin_cpu_supports("x86-64-v3"))
            all |= HWY_AVX2;
        if (__builtin_cpu_supports("x86-64-v4"))
            all |= HWY_AVX3;
        return all;
    }();
    return targets;
}

ChosenTarget& GetChosenTarget() {
    static ChosenTarget chosen;
    return chosen;
}

/// Where an assertion fails.
void Abort(const char*, int, const char*, ...) {
    std::abort();
}

} // namespace hwy
