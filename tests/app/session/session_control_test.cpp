// A session that is steered from outside: which state the pictures show that its clients ask for.
#include "app/control/control_client.h"
#include "app/loop/session_control.h"
#include "stereo/image_file.h"
#include "tests/app/session/quality_session.h"
#include "tests/support/gate.h"

#include <nlohmann/json.hpp>

#include <optional>
#include <stdexcept>
#include <string>

namespace isochron::app {
namespace {

using interaction::Commands;
using interaction::Seconds;
using nlohmann::json;
using test_support::eventually;

json told_by(const std::string& note) {
    const std::size_t begin = note.find('{');
    return json::parse(note.substr(begin, note.rfind('}') + 1 - begin));
}

/// The test is the loop of frames. The picture is exact at rest alone, and in motion it never is final.
class SteeredSession : public SessionQuality {
  protected:
    void begin(index::Extract extract = {}) {
        session_.emplace(config_in_parts(), file_, *context_, std::move(extract));
        session_->outputs().set_screenshots(folder_.path());
        control_.emplace(control_address((folder_.path() / "control.sock").string()), *session_,
                         ControlServerOptions{});
        client_.emplace(control_->server().address());
        EXPECT_EQ(picture(*client_).at("footprint"), "surface");
    }
    /// Nothing happens for as long as the session's age says.
    void wait() { waited_ += grow_old(*session_); }
    /// @param aside where the head is, beside its place [m]
    void frame(float aside = 0) {
        interaction::InputState input = head_at_rest(now().count());
        input.devices[0].pose->position.x += aside;
        ++frame_;
        const Commands commands = control_->take(*session_);
        control_->tell(*session_, session_->frame(input, commands, Waiting::never));
    }
    /// The answer to a request, for which frames go on.
    ControlClient::Answer ask(ControlClient& client, const ControlRequest& request) {
        client.send(request);
        EXPECT_TRUE(eventually([&] {
            frame();
            return client.waits_for_more(0);
        }));
        return client.next().value();
    }
    void tell(ControlClient& client, const Commands& commands) {
        ask(client, {.verb = ControlVerb::commands, .commands = commands});
    }
    /// Returns when the session has the request.
    static void want_picture(ControlClient& client) {
        client.send(kPicture);
        client.ask({.verb = ControlVerb::state}); // which is read behind it, and needs no frame
    }
    /// What the note of a picture says.
    json picture(ControlClient& client) {
        const ControlClient::Answer answer = ask(client, kPicture);
        pixels_ = answer.bytes;
        return told_by(json::parse(answer.line).at("note"));
    }
    static Commands at(double isovalue, std::optional<std::uint32_t> step = std::nullopt) {
        Commands commands;
        commands.isovalue = isovalue;
        if (step)
            commands.instant.emplace(*step);
        return commands;
    }
    /// Frames of a head that moves, a quarter of a second from each other, until this holds.
    void sway_until(const std::function<bool()>& holds) {
        EXPECT_TRUE(eventually([&] {
            waited_ += Seconds(0.25);
            frame(frame_ % 2 == 0 ? 0.3f : 0.0f);
            return holds();
        }));
    }

    static inline const ControlRequest kPicture{.verb = ControlVerb::picture};
    std::optional<Session> session_;
    std::optional<SessionControl> control_;
    std::optional<ControlClient> client_;
    std::vector<std::byte> pixels_; ///< pixels of the last picture
};
INSTANTIATE_TEST_SUITE_P(Ages, SteeredSession,
                         testing::Values(stereo::ContextKind::egl,
                                         SessionKind{stereo::ContextKind::egl, kAnHour}),
                         context_name);

TEST_P(SteeredSession, APictureShowsWhatWasToldBeforeAtFinalQuality) {
    begin();
    Commands light, closer_eyes;
    light.look = interaction::Look{.background = interaction::Background::light};
    closer_eyes.eye_separation = 0.03f;
    for (const Commands& told : {at(6, 2), at(9), light, closer_eyes}) {
        wait();
        tell(*client_, told);
        const json note = picture(*client_);
        const auto given = pixels_;
        EXPECT_EQ(note.at("footprint"), "surface");
        EXPECT_EQ(note.at("state").at("step"), session_->state().instant.step);
        EXPECT_EQ(note.at("state").at("isosurfaces")[0].at("isovalue"),
                  session_->state().isovalue());
        for (int i = 0; i < kRate; ++i)
            frame();
        picture(*client_);
        EXPECT_TRUE(given == pixels_) << "it is the picture at rest";
    }
}

TEST_P(SteeredSession, AScreenshotShowsWhatWasToldWithIt) {
    begin();
    wait();
    Commands told = at(6, 2);
    told.screenshot = true;
    tell(*client_, told);
    EXPECT_TRUE(eventually([&] {
        frame();
        return captured(*session_);
    }));
    const json note = told_by(stereo::read_note(folder_.path() / "isochron_0001.png"));
    EXPECT_EQ(note.at("footprint"), "surface");
    EXPECT_EQ(note.at("state").at("step"), 2);
    EXPECT_EQ(note.at("state").at("isosurfaces")[0].at("isovalue"), 6);
}

TEST_P(SteeredSession, APictureOfEndlessMotionAnswersOnlyWhoHasWaitedForSoLong) {
    constexpr double kFirst = 4, kOther = 6;
    test_support::Gate gate;
    begin([&, real = index::extract_from(file_)](const auto& query, std::stop_token stop) {
        if (query.isovalues.front() == kOther)
            gate.pass(stop);
        return real(query, std::move(stop));
    });
    tell(*client_, at(kFirst));
    wait();
    ControlClient other(control_->server().address());
    sway_until([frames = 0]() mutable { return ++frames == 3; });
    want_picture(*client_);
    const Seconds asked = now();
    sway_until([&] { return now() - asked > CaptureWait::kPatience - CaptureWait::kSteady / 2; });
    EXPECT_FALSE(client_->waits_for_more(0)) << "the motion may end yet";
    tell(other, at(kOther));
    want_picture(other);
    sway_until([&] { return client_->waits_for_more(0); });
    const json note = told_by(json::parse(client_->next()->line).at("note"));
    EXPECT_EQ(note.at("state").at("isosurfaces")[0].at("isovalue"), kFirst);
    EXPECT_FALSE(other.waits_for_more(0)) << "its cells are not there";
    gate.open();
    EXPECT_TRUE(eventually([&] {
        frame();
        return other.waits_for_more(0);
    }));
    const json late = told_by(json::parse(other.next()->line).at("note"));
    EXPECT_EQ(late.at("state").at("isosurfaces")[0].at("isovalue"), kOther);
    EXPECT_EQ(late.at("footprint"), "surface");
}

TEST_P(SteeredSession, AnEarlierFailureIsNoReasonToShowLess) {
    test_support::Gate gate;
    begin([&, real = index::extract_from(file_)](const auto& query, std::stop_token stop) {
        if (query.instant == index::Instant(1))
            throw std::runtime_error("damaged");
        if (query.instant == index::Instant(2))
            gate.pass(stop);
        return real(query, std::move(stop));
    });
    const auto first = session_->state().instant.step;
    tell(*client_, at(6, 1));
    EXPECT_EQ(picture(*client_).at("state").at("step"), first) << "these cells do not come";
    wait();
    tell(*client_, at(6, 2));
    want_picture(*client_);
    for (int i = 0; i < kRate; ++i)
        frame();
    EXPECT_FALSE(client_->waits_for_more(0));
    gate.open();
    EXPECT_TRUE(eventually([&] {
        frame();
        return client_->waits_for_more(0);
    }));
    const json note = told_by(json::parse(client_->next()->line).at("note"));
    EXPECT_EQ(note.at("state").at("step"), 2);
}

} // namespace
} // namespace isochron::app
