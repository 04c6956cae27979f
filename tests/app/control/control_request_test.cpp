// Requests of the control socket as lines, and the limits of their rate.
#include "app/control/control_connection.h"
#include "app/control/control_request.h"

#include "interaction/error.h"

#include <gtest/gtest.h>

#include <string>
#include <vector>

namespace isochron::app {
namespace {

using interaction::Seconds;

std::string refusal_of(const std::string& line) {
    std::string id;
    try {
        request_from(line, id);
    } catch (const interaction::Error& error) {
        return error.what();
    }
    return "none";
}

TEST(ControlRequest, ComesBackAsItWasWritten) {
    std::vector<ControlRequest> all(8);
    all[0].verb = ControlVerb::hello;
    all[0].token = "secret";
    all[1].verb = ControlVerb::state;
    all[2].verb = ControlVerb::commands;
    all[2].commands.instant = index::Instant(7);
    all[2].commands.stamps = {"here"};
    all[3].verb = ControlVerb::subscribe;
    all[3].to = {true, false, true, false};
    all[3].rate = 5;
    all[4].verb = ControlVerb::picture;
    all[4].now = true;
    all[5].verb = ControlVerb::cells;
    all[5].isovalue = 0.5;
    all[6].verb = ControlVerb::mesh;
    all[6].step = 3;
    all[6].array = "rho";
    all[7].verb = ControlVerb::profile;
    all[7].places = {{1, 2, 3}, {0.1, -4, 5e9}, {1, 1, 1}};
    all[7].step = 2;
    for (const ControlRequest& request : all) {
        std::string id;
        EXPECT_EQ(request_from(line_of(request, "\"a\""), id), request) << line_of(request);
        EXPECT_EQ(id, "\"a\"");
    }
}

TEST(ControlRequest, SaysWhatIsWrongInOneLine) {
    EXPECT_EQ(refusal_of("{"), "request: expected an object as JSON in one line");
    EXPECT_EQ(refusal_of("[]"), "request: expected an object, got []");
    EXPECT_EQ(refusal_of(std::string(100'000, '[')), "request: nested deeper than 16 levels");
    EXPECT_EQ(refusal_of("{}"), "request: \"verb\" is missing");
    EXPECT_EQ(refusal_of(R"({"verb":"fly"})"), "verb: expected hello, state, commands, subscribe, "
                                               "picture, cells, mesh, profile, got \"fly\"");
    EXPECT_EQ(refusal_of(R"({"verb":"state","x":1})"), "request: unknown key \"x\"");
    EXPECT_EQ(refusal_of(R"({"verb":"profile","places":[[1,2,3]]})"),
              "places: expected a list of 2 to 256, got [[1,2,3]]");
    EXPECT_EQ(refusal_of(R"({"verb":"profile","places":[[1,2,3],[1,2,"x"]]})"),
              "places: expected a finite number, got \"x\"");
    EXPECT_EQ(refusal_of(R"({"verb":"profile","isovalue":1})"),
              "request: unknown key \"isovalue\"");
    EXPECT_EQ(refusal_of(R"({"verb":"state","id":[1]})"),
              "id: expected a whole number or a text, got [1]");
    EXPECT_EQ(refusal_of(R"({"verb":"commands","commands":{"undo":true,"step":1}})"),
              "commands: undo and redo stand alone");
    EXPECT_EQ(refusal_of(R"({"verb":"commands","commands":{"isovalue":1e999}})"),
              "request: expected an object as JSON in one line");
    EXPECT_EQ(refusal_of(R"({"verb":"subscribe","to":["state"],"rate":1e6})"),
              "rate: expected a number from 0.1 to 120, got 1000000.0");
}

TEST(RequestRate, IsMetOverAnyTimeAndGivesSomeAtOnceAfterAPause) {
    RequestRate rate;
    int taken = 0;
    for (int asked = 0; asked < 100'000; ++asked)
        taken += rate.take(Seconds(0));
    EXPECT_EQ(taken, static_cast<int>(kMostAtOnce));
    taken = 0;
    for (int millisecond = 1; millisecond <= 100; ++millisecond)
        for (int asked = 0; asked < 1000; ++asked)
            taken += rate.take(Seconds(millisecond * 1e-3));
    EXPECT_NEAR(taken, kMostRequestsASecond * 0.1, 1);
}

} // namespace
} // namespace isochron::app
