// Fuzz targets: recordings, and datagrams of trackers through sockets.
#include "tests/fuzz/targets.h"

#include "interaction/recording/recording.h"
#include "interaction/recording/recording_json.h"
#include "interaction/trackers/dtrack_input.h"
#include "interaction/trackers/dtrack_protocol.h"
#include "interaction/trackers/osc_input.h"

#include <arpa/inet.h>
#include <sys/socket.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <sstream>
#include <string>
#include <string_view>
#include <vector>

namespace isochron::fuzz {
namespace {

/// A sender on this machine.
class Sender {
  public:
    explicit Sender(int port) : socket_(::socket(AF_INET, SOCK_DGRAM | SOCK_CLOEXEC, 0)) {
        to_.sin_family = AF_INET;
        to_.sin_port = htons(static_cast<std::uint16_t>(port));
        to_.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    }
    ~Sender() { ::close(socket_); }
    Sender(const Sender&) = delete;
    Sender& operator=(const Sender&) = delete;

    void send(std::string_view datagram) const {
        ::sendto(socket_, datagram.data(), datagram.size(), 0,
                 reinterpret_cast<const sockaddr*>(&to_), sizeof to_);
    }

  private:
    int socket_;
    sockaddr_in to_{};
};

/// The datagrams of an input.
std::vector<std::string_view> datagrams_of(Bytes input) {
    std::vector<std::string_view> datagrams;
    while (input.size() >= 2 && datagrams.size() < 16) {
        const std::size_t length =
            std::min<std::size_t>(input[0] | input[1] << 8, input.size() - 2);
        datagrams.emplace_back(reinterpret_cast<const char*>(input.data()) + 2, length);
        input = input.subspan(2 + length);
    }
    return datagrams;
}

bool finite(const interaction::InputState& state) {
    return std::ranges::all_of(state.devices, [](const interaction::DeviceState& device) {
        const glm::vec3 p = device.pose ? device.pose->position : glm::vec3(0.0f);
        return std::isfinite(p.x + p.y + p.z) &&
               std::ranges::all_of(device.valuators, [](float v) { return std::isfinite(v); });
    });
}

/// Sends the datagrams one after another, and polls after each.
void play(interaction::TrackedInput& tracker, int port, Bytes input) {
    const Sender sender(port);
    interaction::Seconds now{0};
    for (const std::string_view datagram : datagrams_of(input)) {
        sender.send(datagram);
        now += interaction::Seconds(0.01);
        claim(finite(tracker.poll(now)), "devices state finite numbers");
        claim(finite(tracker.latch(now)), "devices state finite numbers when latched");
    }
    for (const std::string& line : tracker.status())
        claim_one_line(line);
}

void fuzz_dtrack(Bytes input) {
    for (const std::string_view datagram : datagrams_of(input))
        if (const auto frame = interaction::parse_dtrack(datagram))
            for (const interaction::DTrackBody& body : frame->bodies)
                claim(std::isfinite(body.position.x + body.position.y + body.position.z),
                      "bodies are somewhere");
    interaction::DTrackOptions options;
    options.endpoint = {"127.0.0.1", 0};
    interaction::DTrackDevice head, wand;
    head.device.name = "head";
    wand.device.name = "wand";
    wand.kind = interaction::DTrackKind::flystick;
    options.devices = {head, wand};
    interaction::DTrackInput tracker(options);
    play(tracker, tracker.endpoint().port, input);
}

#ifdef ISOCHRON_WITH_OSC
void fuzz_osc(Bytes input) {
    interaction::OscOptions options;
    options.endpoint = {"127.0.0.1", 0};
    interaction::OscDevice head;
    head.device.name = "head";
    head.source = "head";
    options.devices = {head};
    interaction::OscInput tracker(options);
    play(tracker, tracker.endpoint().port, input);
}
#endif

void fuzz_recording(Bytes input) {
    std::istringstream file(std::string(input.begin(), input.end()));
    try {
        const interaction::Recording recording = interaction::read_recording(file, "fuzz.jsonl");
        const interaction::RecordedFrame* before = nullptr;
        std::string again = to_json(recording.header)
                                .dump(-1, ' ', false, nlohmann::json::error_handler_t::replace) +
                            "\n";
        for (const interaction::RecordedFrame& frame : recording.frames) {
            interaction::require_finite(frame);
            again += to_json(frame, before)
                         .dump(-1, ' ', false, nlohmann::json::error_handler_t::replace) +
                     "\n";
            before = &frame;
        }
        std::istringstream copy(again);
        claim(interaction::read_recording(copy, "again.jsonl").frames == recording.frames,
              "frames come back as written");
    } catch (const interaction::Error& error) {
        claim_one_line(error.what());
        claim(std::string_view(error.what()).starts_with("fuzz.jsonl:"), "it names its file");
    }
}

} // namespace

std::span<const Target> interaction_targets() {
    static constexpr std::array kTargets{
        Target{"recording", fuzz_recording},
        Target{"dtrack", fuzz_dtrack},
#ifdef ISOCHRON_WITH_OSC
        Target{"osc", fuzz_osc},
#endif
    };
    return kTargets;
}

} // namespace isochron::fuzz
