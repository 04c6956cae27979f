// Takes other data that the user has chosen, and finds out in the background whether they can be opened.
#include "app/loop/data_opening.h"

#include "app/config/series_names.h"
#include "index/readers/formats/model_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <variant>

namespace isochron::app {
namespace {

bool is_there(const std::future<std::string>& answer) {
    return answer.wait_for(std::chrono::seconds(0)) == std::future_status::ready;
}

} // namespace

void DataOpening::update(Session& session, const std::string& why_stay) {
    const auto say = [&](const std::string& words) {
        if (!words.empty())
            session.show_messages({words});
    };
    const auto open = [&](const std::filesystem::path& data) {
        if (index::is_model_name(data))
            say(session.show_model(data));
        else
            say(why_stay.empty() ? begin(data) : why_stay);
    };
    if (const auto chosen = session.panel().take_chosen())
        open(*chosen);
    if (const auto array = session.panel().take_chosen_array()) {
        say(why_stay);
        if (why_stay.empty())
            next_data_ = NextData{{}, *array};
    }
    auto dropped = session.outputs().windows().first().take_dropped();
    const auto models = std::ranges::stable_partition(
        dropped, [](const auto& file) { return !index::is_model_name(file); });
    for (const std::filesystem::path& model : models)
        open(model);
    dropped.erase(models.begin(), models.end());
    if (const auto name = one_name_of(dropped))
        open(*name);
    else if (!dropped.empty())
        say(kNoCommonName);
    say(look());
}

/// Begins with these data, or with them next. @return what the user is told; empty: nothing
std::string DataOpening::begin(const std::filesystem::path& data) {
    if (!why_not_)
        return "other data are not opened in this session";
    if (opening_)
        next_ = data;
    else
        opening_ = {data, std::async(std::launch::async, why_not_, data)};
    return {};
}

/// @return why the data that were chosen last cannot be opened, once; empty: nothing new
std::string DataOpening::look() {
    std::erase_if(given_up_, is_there);
    if (!opening_ || !is_there(opening_->why_not))
        return {};
    std::string reason = opening_->why_not.get();
    if (reason.empty() && !next_)
        next_data_ = NextData{opening_->data};
    opening_.reset();
    if (const auto next = std::exchange(next_, std::nullopt))
        begin(*next);
    return reason;
}

void DataOpening::cancel_on_escape(Session& session,
                                   std::vector<interaction::WindowEvent>& events) {
    const auto escapes = [](const interaction::WindowEvent& event) {
        const auto* change = std::get_if<interaction::KeyEvent>(&event);
        return change && change->key == interaction::Key::escape && change->down && change->alone();
    };
    if (!opening_ || std::erase_if(events, escapes) == 0)
        return;
    session.show_messages({fmt::format("canceled: {} is not opened", opening_->data.string())});
    given_up_.push_back(std::move(opening_->why_not));
    opening_.reset();
    next_.reset();
}

std::string DataOpening::note() const {
    return opening_ ? fmt::format("opening {}; Escape cancels", said_name(opening_->data))
                    : std::string();
}

} // namespace isochron::app
