// Finds out in the background whether data that the user has chosen can be opened.
#include "app/session/data_opening.h"

#include <fmt/format.h>

#include <chrono>
#include <utility>
#include <variant>

namespace isochron::app {
namespace {

bool is_there(const std::future<std::string>& answer) {
    return answer.wait_for(std::chrono::seconds(0)) == std::future_status::ready;
}

} // namespace

std::string DataOpening::open(const std::filesystem::path& data) {
    if (!why_not_)
        return "other data are not opened in this session";
    if (opening_)
        next_ = data;
    else
        opening_ = {data, std::async(std::launch::async, why_not_, data)};
    return {};
}

std::string DataOpening::update() {
    std::erase_if(given_up_, is_there);
    if (!opening_ || !is_there(opening_->why_not))
        return {};
    std::string reason = opening_->why_not.get();
    if (reason.empty() && !next_)
        ready_ = opening_->data;
    opening_.reset();
    if (const auto next = std::exchange(next_, std::nullopt))
        open(*next);
    return reason;
}

std::string DataOpening::cancel_on_escape(std::vector<interaction::WindowEvent>& events) {
    const auto escapes = [](const interaction::WindowEvent& event) {
        const auto* change = std::get_if<interaction::KeyEvent>(&event);
        return change && change->key == interaction::Key::escape && change->down && change->alone();
    };
    if (!opening_ || std::erase_if(events, escapes) == 0)
        return {};
    std::string said = fmt::format("canceled: {} is not opened", opening_->data.string());
    given_up_.push_back(std::move(opening_->why_not));
    opening_.reset();
    next_.reset();
    return said;
}

std::string DataOpening::note() const {
    return opening_ ? fmt::format("opening {}; Escape cancels", opening_->data.filename().string())
                    : std::string();
}

} // namespace isochron::app
