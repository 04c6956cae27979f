// Settings that obey commands as they are.
#pragma once

#include "interaction/commands.h"

namespace isochron::interaction {

/// Sets what the commands hold, without the checks of a session.
inline void obey(const Commands& commands, Settings& settings) {
    each_setting(
        [](const Field&, const auto& given, auto& kept) {
            if (given)
                kept = *given;
        },
        commands, settings);
    if (commands.fraction)
        settings.instant.fraction = *commands.fraction;
    if (commands.isovalue)
        settings.set_isovalue(*commands.isovalue);
}

} // namespace isochron::interaction
