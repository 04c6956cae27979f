// A tracker is heard however many other datagrams come in on its port.
#include "interaction/trackers/datagram_receiver.h"

#include "tests/support/eventually.h"
#include "tests/support/tracker_packets.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

namespace isochron::interaction {
namespace {

using test_support::UdpSender;

constexpr int kFlood = 20'000; // many times what a socket's queue holds

Worth worth_by_name(std::string_view bytes) {
    return bytes.starts_with("useful")     ? Worth::useful
           : bytes.starts_with("sensible") ? Worth::sensible
                                           : Worth::nonsense;
}

class OfEachFamily : public testing::TestWithParam<const char*> {
  protected:
    ReceiverOptions options(DatagramAges ages) const {
        return {.endpoint = {GetParam(), 0}, .ages = ages, .worth = worth_by_name};
    }
};
INSTANTIATE_TEST_SUITE_P(Datagrams, OfEachFamily, testing::Values("127.0.0.1", "::1"));

TEST_P(OfEachFamily, OfOneSenderAloneAreHeardWhereTheKernelDropsOthers) {
    UdpSocket socket({GetParam(), 0});
    const UdpSender tracker(socket.endpoint()), other(socket.endpoint());
    ASSERT_TRUE(tracker.send("first"));
    const auto first = socket.take(1);
    ASSERT_EQ(first.size(), 1u);
    ASSERT_TRUE(socket.hear_only(first[0].sender));
    for (int i = 0; i < kFlood; ++i)
        other.send("of a stranger");
    ASSERT_TRUE(tracker.send("second"));
    const auto second = socket.take(8);
    ASSERT_EQ(second.size(), 1u);
    EXPECT_EQ(second[0].bytes, "second");
    ASSERT_TRUE(socket.hear_only(std::nullopt));
    ASSERT_TRUE(other.send("of anybody"));
    EXPECT_EQ(socket.take(8).size(), 1u);
}

TEST_P(OfEachFamily, OfLittleWorthTakeNoPlaceOfOthers) {
    DatagramReceiver receiver(options(DatagramAges::none));
    const UdpSender tracker(receiver.endpoint());
    for (int round = 0; round < 3; ++round) {
        tracker.send("useful 1");
        for (int i = 0; i < 100; ++i) {
            tracker.send("noise");
            tracker.send("sensible");
        }
        tracker.send("useful 2");
        std::string useful;
        const auto taken = receiver.take(4);
        for (const Datagram& each : taken)
            if (each.bytes.starts_with("useful"))
                useful += each.bytes;
        EXPECT_EQ(useful, "useful 1useful 2");
        EXPECT_EQ(taken.size(), 2u + 4 + 4);
        EXPECT_EQ(receiver.thrown_away(), 2u * 96 * static_cast<unsigned>(round + 1));
    }
}

TEST_P(OfEachFamily, AreTakenByAThreadUntilTheyAreAskedFor) {
    DatagramReceiver receiver(options(DatagramAges::measured));
    const UdpSender tracker(receiver.endpoint());
    // More than the queue holds: what nobody takes meanwhile, the kernel throws away.
    std::uint64_t sent = 0;
    EXPECT_TRUE(test_support::eventually([&] {
        for (int i = 0; i < 100; ++i)
            sent += tracker.send(fmt::format("useful {}", sent)) ? 1 : 0;
        return receiver.thrown_away() > 1000;
    }));
    const auto kept = receiver.take(4);
    ASSERT_EQ(kept.size(), 4u);
    EXPECT_EQ(kept.back().bytes, fmt::format("useful {}", sent - 1));
}

} // namespace
} // namespace isochron::interaction
