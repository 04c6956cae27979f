// A window with nothing but the choice of data.
#include "app/session/data_choice.h"

#include "app/frame/pacer.h"
#include "app/panel/operator_window.h"
#include "render/gl/gl.h"
#include "render/gl/render_target.h"
#include "stereo/presenter.h"

#include <glm/common.hpp>
#include <glm/vec4.hpp>

#include <chrono>
#include <utility>

namespace isochron::app {

namespace fs = std::filesystem;

std::optional<fs::path> choose_data(const stereo::Windows& windows, const DataChoice& choice) {
    stereo::GlContext& window = windows.first();
    window.make_current();
    const render::Gl gl(window.loader());
    PanelLayer layer(gl);
    render::RenderTarget picture(gl, glm::max(window.framebuffer_size(), glm::ivec2(1)));
    stereo::Presenter presenter(gl, window, window);
    layer.offer_files([&choice] { return choice.recent; });
    layer.open_files();
    Pacer pacer(choice.frame_rate_limit);
    std::string complaint;
    const auto start = std::chrono::steady_clock::now();
    while (layer.has_page() && !windows.should_close() && !choice.ended()) {
        layer.feed(windows.poll_events(), true);
        const glm::ivec2 size = window.framebuffer_size();
        if (size.x > 0 && size.y > 0) { // a minimized window has none
            layer.set_scale(panel_scale(window, choice.font_scale, size.x));
            layer.lay_out_files(size, complaint, std::chrono::steady_clock::now() - start);
            picture.resize(size);
            picture.clear(glm::vec4(choice.background, 1));
            picture.bind();
            layer.draw(size);
            presenter.present(picture, nullptr);
        }
        std::optional<fs::path> wanted = layer.take_chosen();
        for (fs::path& dropped : window.take_dropped())
            wanted = std::move(dropped);
        if (wanted) {
            complaint = choice.why_not_open(*wanted);
            if (complaint.empty())
                return wanted;
            layer.open_files();
        }
        pacer.wait();
    }
    return std::nullopt;
}

} // namespace isochron::app
