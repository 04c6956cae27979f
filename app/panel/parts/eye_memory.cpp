// What an eye remembers of something that it has hidden.
#include "app/panel/parts/eye_memory.h"

#include <imgui_internal.h>

namespace isochron::app {

float& opacity_before(ImGuiStorage& of_window, std::string_view kind, std::size_t i) {
    const ImGuiID id = ImHashData(&i, sizeof i, ImHashStr(kind.data(), kind.size()));
    return *of_window.GetFloatRef(id, 1.0f);
}

} // namespace isochron::app
