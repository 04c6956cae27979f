// Messages between program and reader arrive as they were sent, and all others are refused.
#include "index/readers/process/reader_messages.h"

#include "index/error.h"
#include "index/readers/process/message_socket.h"
#include "tests/support/test_seed.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <sys/socket.h>
#include <unistd.h>

#include <limits>
#include <random>
#include <thread>

namespace isochron::index {
namespace {

using testing::HasSubstr;

std::vector<ReaderRequest> every_request() {
    ReadOptions options;
    options.array = "p";
    options.component = "magnitude";
    options.dims = {3, 4, 5};
    options.type = ValueType::u16;
    options.big_endian = true;
    options.allow_surplus = true;
    options.times_from_names = true;
    options.keep_first = true;
    options.header_bytes = 12;
    options.spacing = glm::dvec3(1, 2, 3);
    options.time_step = 0.25;
    options.value_unit = "K";
    return {OpenFile{"netcdf", "a/b\xff.nc", options, 3},
            OpenFile{"vti", "", {}, 0},
            UseMemory{4096},
            ReadSlab{7, {64, 32}, 1 << 20, 3},
            ReadCollection{"s.pvd"},
            CloseFile{3},
            ReadModel{"hull.stl"},
            TakeModel{}};
}

std::vector<ReaderReply> every_reply() {
    SeriesInfo info;
    info.array = "velocity.2";
    info.length_unit = "mm";
    info.anatomy = Anatomy::enu;
    info.grid.vertices = {2, 3, 4};
    info.grid.origin = {-1, 0.5, std::numeric_limits<double>::infinity()};
    info.grid.direction[1] = {0, 0, -1};
    info.type = ValueType::f64;
    info.scaling = {-2, 3};
    info.times = {0, 0.5, 2};
    info.sources = {"a", ""};
    info.notes = {"cell data averaged to vertices"};
    return {Ready{kReaderVersion},
            Described{info, 3, 2},
            SlabRead{},
            Collected{{{"t0.vti", 0.0, "1"}, {"t1.vti", 1e300}}},
            Closed{},
            Refused{"a.vti: no"},
            ModelRead{{1, 2e300, -3}, 4, 1ull << 40}};
}

// Encoding again shows every field, since all that is encoded is decoded or the end is not met.
TEST(ReaderMessages, ComeAsTheyWereSent) {
    for (const ReaderRequest& request : every_request())
        EXPECT_EQ(encoded(request_from(encoded(request))), encoded(request));
    for (const ReaderReply& reply : every_reply())
        EXPECT_EQ(encoded(reply_from(encoded(reply))), encoded(reply));
    const ReaderRequest open = request_from(encoded(every_request()[0]));
    EXPECT_EQ(std::get<OpenFile>(open).path, "a/b\xff.nc");
    EXPECT_EQ(std::get<OpenFile>(open).options.dims, (std::array<std::uint32_t, 3>{3, 4, 5}));
    EXPECT_EQ(std::get<OpenFile>(open).options.length_unit, std::nullopt);
    const ReaderReply described = reply_from(encoded(every_reply()[1]));
    const SeriesInfo& info = std::get<Described>(described).info;
    EXPECT_EQ(info.grid.direction[1], glm::dvec3(0, 0, -1));
    EXPECT_EQ(info.times, (std::vector<double>{0, 0.5, 2}));
    EXPECT_EQ(info.anatomy, Anatomy::enu);
}

TEST(ReaderMessages, CutShortOrTooLongAreRefused) {
    for (const ReaderReply& reply : every_reply()) {
        std::vector<std::byte> bytes = encoded(reply);
        for (std::size_t size = 0; size < bytes.size(); ++size)
            EXPECT_THROW(reply_from(std::span(bytes).first(size)), Error) << size;
        bytes.push_back({});
        EXPECT_THROW(reply_from(bytes), Error);
    }
    for (const ReaderRequest& request : every_request()) {
        const std::vector<std::byte> bytes = encoded(request);
        for (std::size_t size = 0; size < bytes.size(); ++size)
            EXPECT_THROW(request_from(std::span(bytes).first(size)), Error) << size;
    }
}

TEST(ReaderMessages, WithRandomBytesAreReadOrRefused) {
    SCOPED_TRACE(test_seed());
    std::mt19937 random(test_seed());
    int refused = 0;
    for (int round = 0; round < 2000; ++round)
        for (const ReaderReply& reply : every_reply()) {
            std::vector<std::byte> bytes = encoded(reply);
            for (int change = 0; change < 3; ++change)
                bytes[random() % bytes.size()] = static_cast<std::byte>(random());
            try {
                // What is accepted is a message: it can be sent again.
                const ReaderReply read = reply_from(bytes);
                EXPECT_EQ(encoded(reply_from(encoded(read))), encoded(read));
            } catch (const Error&) {
                ++refused;
            }
        }
    EXPECT_GT(refused, 1000);
}

TEST(ReaderMessages, OfAKindThatIsNoneAreRefused) {
    const std::vector<std::byte> ninth{std::byte{9}};
    EXPECT_THROW(request_from(ninth), Error);
    try {
        reply_from(ninth);
        FAIL();
    } catch (const Error& error) {
        EXPECT_THAT(error.what(), HasSubstr("kind 9, expected 0 to 7"));
    }
}

TEST(MessageSocket, CarriesLongMessagesAndDescriptors) {
    auto [one, other] = MessageSocket::pair();
    MessageSocket here(std::move(one)), there(std::move(other));
    const std::vector<std::byte> large(5'000'000, std::byte{7});
    std::thread sender([&] {
        EXPECT_TRUE(here.send({}));
        EXPECT_TRUE(here.send(large));
        EXPECT_TRUE(here.send(large, STDOUT_FILENO));
    });
    EXPECT_TRUE(there.receive()->bytes.empty());
    EXPECT_EQ(there.receive()->bytes, large);
    const auto last = there.receive();
    sender.join();
    EXPECT_EQ(last->bytes, large);
    EXPECT_TRUE(last->attached);
}

TEST(MessageSocket, SaysWhenNobodyIsThere) {
    auto [one, other] = MessageSocket::pair();
    MessageSocket here(std::move(one));
    // Gone in the midst of a message.
    const std::uint64_t length = 100;
    ASSERT_EQ(::write(other.number(), &length, sizeof length), ssize_t{sizeof length});
    other.reset();
    EXPECT_EQ(here.receive(), std::nullopt);
    EXPECT_FALSE(here.send({}));
}

TEST(MessageSocket, RefusesALengthThatNoMessageHas) {
    auto [one, other] = MessageSocket::pair();
    MessageSocket here(std::move(one));
    const std::uint64_t length = std::uint64_t{1} << 60;
    ASSERT_EQ(::write(other.number(), &length, sizeof length), ssize_t{sizeof length});
    EXPECT_THROW(here.receive(), Error);
}

TEST(MessageSocket, AsksWhetherToWaitOn) {
    auto [one, other] = MessageSocket::pair();
    MessageSocket here(std::move(one));
    int asked = 0;
    EXPECT_THROW(here.receive([&] {
        if (++asked == 3)
            throw Error("enough");
    }),
                 Error);
    EXPECT_EQ(asked, 3);
}

} // namespace
} // namespace isochron::index
