// The control socket and clients that do harm: floods, nonsense, deafness, too many of them.
#include "tests/app/control/control_fixture.h"

#include <fstream>
#include <random>
#include <thread>

#include <fcntl.h>
#include <sys/ioctl.h>
#include <unistd.h>

namespace isochron::app {
namespace {

TEST_F(ControlServerTest, HasAnEndOfWhatWaitsForFrames) {
    interaction::Commands undo;
    undo.undo = true;
    std::size_t taken = 0;
    while (taken < 1000 && desk_.post(undo) != 0)
        ++taken;
    EXPECT_EQ(taken, ControlDesk::kMostBatches);
}

TEST_F(ControlServerTest, HalfLinesHugeLinesAndNonsenseEndInAnAnswerAndHarmNobody) {
    listen();
    ControlClient other(server_->address());
    EXPECT_EQ(answer_to("{\"verb\":\"sta"), "") << "a line without its end is none";
    EXPECT_EQ(answer_to("GET / HTTP/1.1\r\n\r\n"),
              "{\"id\":null,\"ok\":false,\"error\":\"request: expected an object as JSON in one "
              "line\"}\n");
    EXPECT_NE(answer_to(std::string(10'000'000, 'x')).find("a line of more than"),
              std::string::npos);
    EXPECT_NE(answer_to(std::string(60'000, '[') + "\n").find("nested deeper"), std::string::npos);
    EXPECT_NE(answer_to(std::string("\0\xff\n{\"verb\":\"state\"}\n", 20)).find("\"ok\":true"),
              std::string::npos)
        << "the next line is read all the same";
    EXPECT_NO_THROW(ask(other, verb(ControlVerb::state)));
}

TEST_F(ControlServerTest, AClientThatReadsNothingIsNotReadFromForever) {
    listen();
    const ControlSocket deaf = connect_to(server_->address());
    fcntl(deaf.get(), F_SETFL, O_NONBLOCK);
    const std::string line = "{\"verb\":\"state\"}\n";
    std::string many;
    for (int i = 0; i < 4000; ++i)
        many += line;
    std::size_t sent = 0, refused = 0;
    ControlClient other(server_->address());
    EXPECT_TRUE(eventually([&] {
        const ssize_t count = send(deaf.get(), many.data(), many.size(), MSG_NOSIGNAL);
        sent += static_cast<std::size_t>(std::max<ssize_t>(count, 0));
        refused = count < 0 ? refused + 1 : 0;
        ask(other, verb(ControlVerb::state)); // which is answered meanwhile
        return refused > 20;
    })) << sent;
    EXPECT_LT(sent, std::size_t{64} << 20);
}

TEST_F(ControlServerTest, ClientsThatVanishLeaveNothingBehind) {
    listen();
    for (int i = 0; i < 50; ++i) {
        const ControlSocket socket = connect_to(server_->address());
        const std::string asks = "{\"verb\":\"subscribe\",\"to\":[\"state\"]}\n{\"verb\":"
                                 "\"picture\"}\n{\"verb\":\"mesh\",\"isovalue\":0}\n{\"ver";
        send(socket.get(), asks.data(), asks.size(), MSG_NOSIGNAL);
    }
    EXPECT_TRUE(eventually([&] {
        show();
        return server_->clients() == 0;
    }));
    EXPECT_TRUE(eventually([&] { // some may not have been let in before
        try {
            ControlClient client(server_->address());
            ask(client, step(1));
            return true;
        } catch (const interaction::Error&) {
            return false;
        }
    }));
}

TEST_F(ControlServerTest, MoreClientsThanThereAreSeatsAreToldSoAtOnce) {
    listen();
    std::vector<std::unique_ptr<ControlClient>> seated;
    for (std::size_t i = 0; i < ControlServer::kMostClients; ++i) {
        seated.push_back(std::make_unique<ControlClient>(server_->address()));
        ask(*seated.back(), verb(ControlVerb::state));
    }
    const auto complaint = [&] {
        try {
            const ControlClient late(server_->address());
        } catch (const interaction::Error& error) {
            return std::string(error.what());
        }
        return std::string();
    };
    for (std::size_t i = 0; i < 3 * ControlServer::kMostTurnedAway; ++i)
        EXPECT_EQ(complaint(), "busy: the session has 16 clients, as many as it takes; try again "
                               "when one has ended");
    EXPECT_EQ(server_->clients(), ControlServer::kMostClients);
    EXPECT_NO_THROW(ask(*seated.front(), verb(ControlVerb::state)));
    seated.pop_back();
    EXPECT_TRUE(eventually([&] { return complaint().empty(); }));
}

TEST_F(ControlServerTest, WhoSaysNothingWithoutASeatKeepsNobodyOut) {
    listen("", {.clock = [this] { return Seconds(now_); }});
    std::vector<ControlSocket> silent;
    for (std::size_t i = 0; i < ControlServer::kMostClients + ControlServer::kMostTurnedAway; ++i)
        silent.push_back(connect_to(server_->address()));
    ASSERT_TRUE(eventually([&] { return server_->clients() == ControlServer::kMostClients; }));
    now_ = 2;
    EXPECT_NE(answer_to("{\"verb\":\"state\"}\n").find("busy"), std::string::npos);
}

TEST_F(ControlServerTest, WhatIsFoundForOneWhoReadsNothingIsLittleAndKeepsNobodyForLong) {
    std::mt19937 random(1);
    index::TestField field({25, 25, 25}, 1, index::ValueType::f32, index::white_noise(random));
    index::MemorySeries series(field.view());
    build_index(series, folder_.path() / "large.isochron", {});
    file_ = index::IndexFile::open(folder_.path() / "large.isochron");
    desk_.set_file(file_);
    listen("", {.clock = [this] { return Seconds(now_); }, .most_held = 1});
    const ControlSocket deaf = connect_to(server_->address());
    std::string lines;
    for (int i = 0; i < 20; ++i)
        lines += "{\"verb\":\"mesh\",\"isovalue\":0}\n";
    ASSERT_EQ(send(deaf.get(), lines.data(), lines.size(), MSG_NOSIGNAL), std::ssize(lines));
    const auto unread = [&] {
        int bytes = 0;
        ioctl(deaf.get(), FIONREAD, &bytes);
        return bytes;
    };
    ASSERT_TRUE(eventually([&] { return unread() > 10'000; }))
        << "a mesh larger than a socket holds";
    ControlClient other(server_->address());
    other.send(verb(ControlVerb::cells));
    EXPECT_NO_THROW(ask(other, verb(ControlVerb::state)));
    EXPECT_FALSE(other.waits_for_more(50)) << "the other's mesh is kept until it is read";
    now_ = ControlServer::kTakesNothing.count() + 1;
    const auto cells = other.next();
    ASSERT_TRUE(cells);
    EXPECT_GT(cells->bytes.size(), 0u);
    EXPECT_TRUE(eventually([&] { return server_->clients() == 1; }));
}

/// A listener that answers so many lines, and then nothing.
class Hanging {
  public:
    Hanging(const std::filesystem::path& path, int answers)
        : address_{.path = path}, listener_(listen_at(address_)),
          thread_([this, answers](const std::stop_token& stop) {
              const ControlSocket client(accept(listener_.get(), nullptr, nullptr));
              for (int i = 0; i < answers; ++i) {
                  std::array<char, 4096> line;
                  if (recv(client.get(), line.data(), line.size(), 0) <= 0)
                      return;
                  const std::string answer = "{\"id\":null,\"ok\":true}\n";
                  send(client.get(), answer.data(), answer.size(), MSG_NOSIGNAL);
              }
              while (!stop.stop_requested())
                  std::this_thread::sleep_for(std::chrono::milliseconds(1));
          }) {}
    const ControlAddress& address() const { return address_; }

  private:
    ControlAddress address_;
    ControlSocket listener_;
    std::jthread thread_;
};

TEST_F(ControlServerTest, ASessionThatHangsIsNotWaitedForForEver) {
    using std::chrono::milliseconds;
    const Hanging at_once(folder_.path() / "at_once", 0);
    EXPECT_THROW(ControlClient(at_once.address(), {}, milliseconds(1)), interaction::Error);
    for (const auto& request : {verb(ControlVerb::state), step(1), verb(ControlVerb::picture)}) {
        const Hanging hangs(folder_.path() / "hangs", 1);
        ControlClient client(hangs.address(), {}, milliseconds(50));
        EXPECT_THROW(client.ask(request), interaction::Error);
    }
}

TEST_F(ControlServerTest, ASessionThatLivesIsWaitedForLongerThanItTakesToSayThatItHangs) {
    listen();
    ControlClient client(server_->address(), {}, std::chrono::seconds(1));
    auto answer = std::async(std::launch::async, [&] { return client.ask(step(1)); });
    EXPECT_EQ(answer.wait_for(std::chrono::milliseconds(1200)), std::future_status::timeout);
    EXPECT_TRUE(eventually([&] {
        show();
        return answer.wait_for(std::chrono::seconds(0)) == std::future_status::ready;
    }));
    EXPECT_NO_THROW(answer.get());
}

TEST_F(ControlServerTest, PicturesThatNobodyReadsTakeLittleMemory) {
    listen();
    ControlClient deaf(server_->address()), other(server_->address());
    ControlRequest now = verb(ControlVerb::picture);
    now.now = true;
    const auto give = [&](std::size_t pixels) {
        ControlPicture picture;
        picture.image = {.width = static_cast<int>(pixels), .height = 1, .rgba = {}};
        picture.image.rgba.resize(4 * pixels);
        picture.answers = desk_.wishes();
        desk_.give(std::move(picture));
        for (int i = 0; i < 2; ++i) // the thread has answered with the picture before the second
            ask(other, verb(ControlVerb::state));
    };
    const auto memory = [] { // [KiB]; not the most so far, which another test may have set
        long all = 0, resident = 0;
        std::ifstream("/proc/self/statm") >> all >> resident;
        return resident * (sysconf(_SC_PAGESIZE) / 1024);
    };
    const auto wait_for = [&](std::uint64_t wishes) {
        return eventually([&] { return desk_.wishes().now == wishes; });
    };
    constexpr std::uint64_t kMany = 300;
    for (std::uint64_t i = 0; i < kMany; ++i)
        deaf.send(now);
    ASSERT_TRUE(wait_for(kMany));
    const auto before = memory();
    give(100'000);
    EXPECT_LT(memory() - before, 40'000) << "all have the same bytes";
    for (std::uint64_t i = 0; i < kMany; ++i)
        EXPECT_EQ(deaf.next()->bytes.size(), 300'000u);

    for (std::uint64_t i = 1; i <= 2; ++i) {
        deaf.send(now);
        ASSERT_TRUE(wait_for(kMany + i));
        give(kMostBehind / 6 + 1);
    }
    deaf.send(now);
    ask(other, verb(ControlVerb::state));
    ask(other, verb(ControlVerb::state));
    EXPECT_EQ(desk_.wishes().now, kMany + 2) << "it has two pictures to read";
    deaf.next();
    EXPECT_TRUE(wait_for(kMany + 3));
}

TEST_F(ControlServerTest, AFloodOfCommandsIsOneOfEachKindInAFrame) {
    listen();
    constexpr int kMany = 300;
    std::string lines;
    for (int i = 0; i < kMany; ++i)
        lines += "{\"verb\":\"commands\",\"commands\":{\"step\":" + std::to_string(i % 3) + "}}\n";
    std::atomic<bool> answered{false};
    auto answers = std::async(std::launch::async, [&] {
        const Finally tell([&] { answered = true; });
        return answer_to(lines);
    });
    EXPECT_TRUE(eventually([&] {
        show();
        return answered.load();
    }));
    const std::string all = answers.get();
    EXPECT_EQ(std::ranges::count(all, '\n'), kMany) << "each is answered";
    EXPECT_EQ(state_->instant, index::Instant((kMany - 1) % 3)) << "the last one counts";
    EXPECT_LE(taken_.size(), frames_);
}

} // namespace
} // namespace isochron::app
