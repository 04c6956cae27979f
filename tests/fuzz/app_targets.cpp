// Fuzz targets: configurations, files that are imported as such, messages of a cluster, requests of the
// control socket.
#include "tests/fuzz/targets.h"

#include "app/cluster/cluster_messages.h"
#include "app/config/check_config.h"
#include "app/config/config.h"
#include "app/config/display_config_text.h"
#include "app/config/pvx_file.h"
#include "app/config/config_problem.h"
#include "app/control/control_answers.h"
#include "app/control/control_request.h"
#include "interaction/recording/commands_json.h"

#include <algorithm>
#include <array>
#include <string>
#include <string_view>

namespace isochron::fuzz {
namespace {

void fuzz_toml(Bytes input) {
    const std::string text(input.begin(), input.end());
    try {
        const app::Config config = app::parse_config(text, "fuzz.toml");
        for (const app::ConfigProblem& problem : app::problems_of(config))
            claim_one_line(app::line_of(problem, config));
        app::describe(config);
        app::emulation_for(config);
        const app::Config again =
            app::parse_config(app::display_config_text(config.installation), "again.toml");
        claim(again.installation == config.installation, "an installation comes back as written");
    } catch (const app::ConfigError& error) {
        claim_one_line(error.what());
        claim(std::string_view(error.what()).starts_with("fuzz.toml:"), "it names its file");
    }
}

void fuzz_pvx(Bytes input) {
    const std::string text(input.begin(), input.end());
    try {
        const app::PvxImport import = app::parse_pvx(text, "fuzz.pvx", {});
        const std::string toml = app::display_config_text(import.installation);
        app::problems_of(app::parse_config(toml, "fuzz.pvx"));
    } catch (const app::ConfigError& error) {
        claim_one_line(error.what());
        claim(std::string_view(error.what()).starts_with("fuzz.pvx:"), "it names its file");
    }
}

void fuzz_cluster(Bytes input) {
    if (input.empty())
        return;
    const std::span<const std::byte> message = std::as_bytes(input.subspan(1));
    const auto comes_back = [](const auto& value, auto decode) {
        const app::MessageBytes bytes = app::encoded(value);
        claim(decode(std::as_bytes(std::span(bytes))) == value, "a message comes back as sent");
    };
    try {
        switch (input[0] % 3) {
        case 0:
            if (const auto order = app::decode_order(message))
                comes_back(*order, [](auto bytes) { return *app::decode_order(bytes); });
            break;
        case 1: comes_back(app::decode_plan(message), app::decode_plan); break;
        default: comes_back(app::decode_answer(message), app::decode_answer); break;
        }
    } catch (const interaction::Error& error) {
        claim_one_line(error.what());
    }
}

void fuzz_control(Bytes input) {
    const std::string_view lines(reinterpret_cast<const char*>(input.data()), input.size());
    for (std::size_t from = 0; from <= lines.size();) {
        const std::size_t end = std::min(lines.find('\n', from), lines.size());
        std::string id;
        try {
            const app::ControlRequest request =
                app::request_from(lines.substr(from, end - from), id);
            std::string again_id;
            claim(app::request_from(app::line_of(request, id), again_id) == request,
                  "a request comes back as it was written");
            claim(id == again_id, "so does its name");
            claim(!interaction::unwritable_field(request.commands), "numbers are finite");
        } catch (const interaction::Error& error) {
            claim_one_line(error.what());
            claim_one_line(app::refused(id, error.what()).line.substr(0, id.size()));
        }
        from = end + 1;
    }
}

} // namespace

std::span<const Target> app_targets() {
    static constexpr std::array kTargets{Target{"toml", fuzz_toml}, Target{"pvx", fuzz_pvx},
                                         Target{"cluster", fuzz_cluster},
                                         Target{"control", fuzz_control}};
    return kTargets;
}

} // namespace isochron::fuzz
