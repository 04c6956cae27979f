// OBJ (Wavefront, "Advanced Visualizer Manual", appendix B1): points and faces. All else is left out,
// such as the files that it names.
#include "index/readers/decoders/model/model.h"

#include "index/readers/decoders/model/model_text.h"

namespace isochron::index {
namespace {

/// `7`, `7/1`, `7//3`, `-1/-1/-1` -> the point, counted from 0.
std::int64_t point_of(ModelText& text, std::string_view word, std::size_t points) {
    std::int64_t number = 0;
    if (!parse_value(word.substr(0, word.find('/')), number) || number == 0)
        text.fail(fmt::format("expected the number of a point, from 1, got {}",
                              ModelText::shortened(word)));
    return number > 0 ? number - 1 : static_cast<std::int64_t>(points) + number;
}

} // namespace

StatedModel obj_model(std::span<const std::byte> bytes, const std::string& name) {
    StatedModel model;
    ModelText text(bytes, name);
    std::vector<std::int64_t> polygon;
    std::uint64_t faces = 0;
    const auto is_continued = [&] {
        const std::size_t last = text.line().find_last_not_of(" \t\r");
        return last != std::string_view::npos && text.line()[last] == '\\';
    };
    while (text.next_line()) {
        const std::string_view word = text.word();
        if (word.empty() || word[0] == '#') {
            take_origin(text.line(), false, model.origin);
        } else if (word == "v") {
            const auto along = [&] { return text.number<double>("a coordinate"); };
            const double x = along(), y = along(), z = along();
            model.points.emplace_back(x, y, z);
        } else if (word == "f") {
            polygon.clear();
            for (bool more = true; more;) {
                for (std::string_view each = text.word(); !each.empty() && each != "\\";
                     each = text.word())
                    polygon.push_back(point_of(text, each, model.points.size()));
                more = is_continued() && text.next_line();
            }
            if (polygon.size() < 3)
                text.fail(fmt::format("a face of {} corners, expected 3 or more", polygon.size()));
            model.add_polygon(polygon, name, fmt::format("face {} (line {})", ++faces,
                                                         text.line_number()));
        }
    }
    return model;
}

} // namespace isochron::index
