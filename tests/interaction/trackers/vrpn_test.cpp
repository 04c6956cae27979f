// VRPN with its own servers, in this process and over loopback.
#include "interaction/trackers/vrpn_input.h"

#include "tests/interaction/controls/control_desk.h"
#include "tests/support/eventually.h"

#include <vrpn_Analog.h>
#include <vrpn_Button.h>
#include <vrpn_Connection.h>
#include <vrpn_Tracker.h>

#include <chrono>

namespace isochron::interaction {
namespace {

constexpr int kPort = 38830;
constexpr const char* kServer = "localhost:38830";

/// Servers that a test sets values of.
struct Servers {
    vrpn_Connection* connection = vrpn_create_server_connection(kPort);
    vrpn_Tracker_Server tracker{"Tracker0", connection, 2};
    vrpn_Button_Server button{"Button0", connection, 4};
    vrpn_Analog_Server analog{"Analog0", connection, 2};
    ~Servers() { connection->removeReference(); }

    void send(double x, bool down, double value) {
        timeval now;
        vrpn_gettimeofday(&now, nullptr);
        const vrpn_float64 elsewhere[3] = {9, 9, 9}, place[3] = {x, 1.5, -0.5};
        const vrpn_float64 straight[4] = {0, 0, 0, 1}, turned[4] = {0, 0.6, 0, 0.8};
        tracker.report_pose(0, now, elsewhere, straight);
        tracker.report_pose(1, now, place, turned);
        button.set_button(2, down);
        analog.channels()[1] = value;
        analog.report();
        tracker.mainloop();
        button.mainloop();
        analog.mainloop();
        timeval wait{0, 2000}; // for the clients, or this long
        connection->mainloop(&wait);
    }
};

VrpnOptions options() {
    VrpnDevice wand;
    wand.device.name = "wand";
    wand.device.prediction.on = false;
    wand.tracker = std::string("Tracker0@") + kServer;
    wand.buttons = std::string("Button0@") + kServer;
    wand.analog = std::string("Analog0@") + kServer;
    wand.sensor = 1;
    return {{wand}};
}

/// Session time runs with the wall clock: VRPN has a thread and a clock of its own.
class Session {
  public:
    Seconds now() const { return Clock::now() - start_; }

  private:
    using Clock = std::chrono::steady_clock;
    Clock::time_point start_ = Clock::now();
};

TEST(VrpnInput, PosesButtonsAndValuatorsArriveAndRestWhenTheServerGoes) {
    Session session;
    DeviceState wand;
    VrpnInput input(options());
    EXPECT_EQ(input.poll(session.now()).find("wand")->tracking(), Tracking::lost);
    {
        Servers servers;
        // Buttons and valuators are sent when they change. The test's limit ends a hang.
        bool turn = false;
        do {
            turn = !turn;
            servers.send(0.25, turn, turn ? -0.5 : -0.25);
            wand = *input.poll(session.now()).find("wand");
        } while (!wand.pose || wand.buttons == 0 || wand.valuators.size() < 2 ||
                 wand.valuators[1] == 0);
        EXPECT_EQ(wand.tracking(), Tracking::tracked);
        expect_near(wand.pose->position, {0.25, 1.5, -0.5}, 1e-6);
        EXPECT_LT(glm::length(rotation_between(wand.pose->orientation, {0.8f, 0, 0.6f, 0})), 1e-5);
        EXPECT_EQ(wand.buttons, 4u);
        EXPECT_LT(wand.valuators[1], 0);
        ASSERT_TRUE(wand.device_time && wand.measured);
        EXPECT_GT(wand.device_time->count(), 1e9);
        do {
            servers.send(0.3, false, 0);
            wand = *input.poll(session.now()).find("wand");
        } while (wand.buttons != 0);
        EXPECT_NE(input.status()[0].find(": connected"), std::string::npos);
    }
    EXPECT_TRUE(test_support::eventually([&] {
        wand = *input.poll(session.now()).find("wand");
        return wand.tracking() == Tracking::lost;
    }));
    expect_near(wand.pose->position, {0.3, 1.5, -0.5}, 0.051);
}

} // namespace
} // namespace isochron::interaction
