// The control socket against clients that mean well and clients that do not; the test is the loop of frames.
#include "app/control/control_client.h"
#include "app/control/control_server.h"

#include "index/file/index_file.h"
#include "index/indexing/index_build.h"
#include "interaction/error.h"
#include "tests/support/eventually.h"
#include "tests/support/memory_series.h"
#include "tests/support/test_folder.h"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <atomic>
#include <functional>
#include <future>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include <fcntl.h>
#include <poll.h>
#include <sys/resource.h>
#include <sys/socket.h>
#include <sys/stat.h>

namespace isochron::app {
namespace {

using interaction::Seconds;
using nlohmann::json;
using test_support::eventually;

/// Calls a function at the end of its life.
class Finally {
  public:
    explicit Finally(std::function<void()> last) : last_(std::move(last)) {}
    ~Finally() { last_(); }
    Finally(const Finally&) = delete;
    Finally& operator=(const Finally&) = delete;

  private:
    std::function<void()> last_;
};

class ControlServerTest : public testing::Test {
  protected:
    ControlServerTest() {
        setenv("XDG_RUNTIME_DIR", folder_.path().c_str(), 1);
        index::TestField field({9, 8, 7}, 3, index::ValueType::f32, index::moving_sphere);
        index::MemorySeries series(field.view());
        build_index(series, folder_.path() / "a.isochron", {});
        file_ = index::IndexFile::open(folder_.path() / "a.isochron");
        desk_.set_file(file_);
        show();
    }
    void listen(const std::string& at = "", ControlServerOptions options = {}) {
        server_.emplace(control_address(at), desk_, std::move(options));
    }
    /// A frame of the loop: obeys what waits.
    void show() {
        if (const auto batch = desk_.take()) {
            taken_.push_back(batch->commands);
            auto next = std::make_shared<ExplorerState>(*state_);
            next->apply(batch->commands, file_->info().steps());
            state_ = next;
            obeyed_ = batch->last;
            obeyed_in_ = frames_ + 1;
        }
        desk_.show({.number = ++frames_, .obeyed = obeyed_, .state = state_, .report = {}});
    }
    /// Asks while frames go on.
    ControlClient::Answer ask(ControlClient& client, const ControlRequest& request) {
        std::atomic<bool> answered{false};
        auto answer = std::async(std::launch::async, [&] {
            const Finally tell([&] { answered = true; });
            return client.ask(request);
        });
        eventually([&] {
            show();
            return answered.load();
        });
        return answer.get();
    }
    static ControlRequest step(std::uint32_t number) {
        ControlRequest request;
        request.verb = ControlVerb::commands;
        request.commands.step = number;
        return request;
    }
    static ControlRequest verb(ControlVerb verb) {
        ControlRequest request;
        request.verb = verb;
        return request;
    }
    /// What is answered to these bytes, up to the connection's end, if nobody waits for more.
    std::string answer_to(const std::string& bytes, const ControlAddress& address) {
        const ControlSocket socket = connect_to(address);
        std::size_t sent = 0;
        while (sent < bytes.size()) {
            const ssize_t count =
                send(socket.get(), bytes.data() + sent, bytes.size() - sent, MSG_NOSIGNAL);
            if (count <= 0)
                break; // it has heard enough
            sent += static_cast<std::size_t>(count);
        }
        shutdown(socket.get(), SHUT_WR);
        std::string answer;
        std::array<char, 4096> piece;
        for (ssize_t count; (count = recv(socket.get(), piece.data(), piece.size(), 0)) > 0;)
            answer.append(piece.data(), static_cast<std::size_t>(count));
        return answer;
    }
    std::string answer_to(const std::string& bytes) { return answer_to(bytes, server_->address()); }

    test_support::TestFolder folder_;
    std::shared_ptr<const index::IndexFile> file_;
    ControlDesk desk_;
    std::shared_ptr<const ExplorerState> state_ = std::make_shared<ExplorerState>();
    std::uint64_t frames_ = 0, obeyed_ = 0, obeyed_in_ = 0;
    std::vector<interaction::Commands> taken_;
    std::atomic<double> now_{0}; ///< [s], of clocks; the server's threads may read it to their end
    std::optional<ControlServer> server_;
};

TEST_F(ControlServerTest, IsASocketThatItsUserAloneMayOpenAndIsGoneAtTheEnd) {
    listen();
    const auto path = default_control_path();
    struct stat socket{};
    ASSERT_EQ(stat(path.c_str(), &socket), 0);
    EXPECT_EQ(socket.st_mode & 0777, 0600u);
    EXPECT_THROW(ControlServer(control_address(""), desk_, {}), interaction::Error)
        << "it is in use";
    server_.reset();
    EXPECT_FALSE(std::filesystem::exists(path));
}

TEST_F(ControlServerTest, ReplacesASocketThatWasLeftBehindAndNothingElse) {
    ControlAddress address = control_address("");
    {
        const ControlSocket left = listen_at(address);
    }
    ASSERT_TRUE(std::filesystem::exists(address.path)) << "nobody has removed it";
    EXPECT_NO_THROW(listen());
    folder_.write("run42.isochron", "data");
    EXPECT_THROW(
        ControlServer(control_address((folder_.path() / "run42.isochron").string()), desk_, {}),
        interaction::Error);
    EXPECT_EQ(folder_.read("run42.isochron"), "data");
}

TEST_F(ControlServerTest, AnswersACommandWithTheFrameThatObeysIt) {
    listen();
    ControlClient client(server_->address());
    const auto answer = json::parse(ask(client, step(2)).line);
    EXPECT_EQ(answer.at("frame"), obeyed_in_);
    EXPECT_EQ(state_->step, 2u);
    const auto state = json::parse(ask(client, verb(ControlVerb::state)).line);
    EXPECT_EQ(state.at("state").at("step"), 2);
}

TEST_F(ControlServerTest, TheFrameThatObeysIsTheFirstAlsoOnceOthersHaveBeenShown) {
    ControlDesk desk;
    std::uint64_t number = 0;
    for (const std::uint64_t obeyed : {0u, 3u, 3u, 5u, 5u})
        desk.show({.number = ++number, .obeyed = obeyed, .state = state_, .report = {}});
    EXPECT_EQ(desk.frame_of(1), 2u);
    EXPECT_EQ(desk.frame_of(3), 2u);
    EXPECT_EQ(desk.frame_of(4), 4u);
    EXPECT_EQ(desk.frame_of(5), 4u);
}

TEST_F(ControlServerTest, RefusesWhatTheDataDoNotHave) {
    listen();
    ControlClient client(server_->address());
    EXPECT_THROW(ask(client, step(99)), interaction::Error);
    ControlRequest array = verb(ControlVerb::commands);
    array.commands.array = "nothing";
    EXPECT_THROW(ask(client, array), interaction::Error);
    EXPECT_TRUE(taken_.empty());
}

TEST_F(ControlServerTest, CommandsOfAFrameGoTogetherUnlessTheirOrderMatters) {
    interaction::Commands step_two, pick, iso, undo;
    step_two.step = 2;
    iso.isovalue = 1.0;
    pick.picked = 0;
    undo.undo = true;
    for (const auto& each : {step_two, iso, pick, undo, step_two})
        EXPECT_NE(desk_.post(each), 0u);
    std::vector<interaction::Commands> frames;
    while (const auto batch = desk_.take())
        frames.push_back(batch->commands);
    ASSERT_EQ(frames.size(), 4u);
    EXPECT_EQ(frames[0].isovalue, 1.0);
    EXPECT_EQ(frames[0].step, 2u);
    EXPECT_EQ(frames[1].picked, 0u) << "the isovalue before was of another surface";
    EXPECT_TRUE(frames[2].undo);
}

TEST_F(ControlServerTest, NoFrameBeforeTheCommandAnswersAPictureThatWasAskedForBehindIt) {
    interaction::Commands undo, redo; // for a frame of their own each
    undo.undo = redo.redo = true;
    EXPECT_EQ(desk_.want_picture(true), 1u);
    EXPECT_EQ(desk_.wishes().now, 1u) << "nothing is before it";
    desk_.post(undo);
    EXPECT_EQ(desk_.want_picture(false), 1u);
    desk_.post(redo);
    EXPECT_EQ(desk_.want_picture(true), 2u);
    EXPECT_EQ(desk_.want_picture(false), 2u);
    EXPECT_EQ(desk_.wishes().final, 0u);
    desk_.take();
    EXPECT_EQ(desk_.wishes().final, 1u);
    EXPECT_EQ(desk_.wishes().now, 1u);
    desk_.take();
    EXPECT_EQ(desk_.wishes().final, 2u);
    EXPECT_EQ(desk_.wishes().now, 2u);
}

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
    ControlClient client(server_->address());
    EXPECT_NO_THROW(ask(client, step(1)));
}

TEST_F(ControlServerTest, MoreClientsThanThereAreSeatsWaitUntilOneLeaves) {
    listen();
    std::vector<std::unique_ptr<ControlClient>> seated;
    for (std::size_t i = 0; i < ControlServer::kMostClients; ++i) {
        seated.push_back(std::make_unique<ControlClient>(server_->address()));
        ask(*seated.back(), verb(ControlVerb::state));
    }
    const ControlSocket late = connect_to(server_->address());
    const std::string line = "{\"verb\":\"state\"}\n";
    ASSERT_EQ(send(late.get(), line.data(), line.size(), MSG_NOSIGNAL), std::ssize(line));
    const auto is_answered = [&late] {
        pollfd socket{late.get(), POLLIN, 0};
        return poll(&socket, 1, 0) > 0;
    };
    ask(*seated.front(), step(1)); // the thread has looked at all of them since
    EXPECT_EQ(server_->clients(), ControlServer::kMostClients);
    EXPECT_FALSE(is_answered());
    EXPECT_THROW(ControlClient(server_->address(), {}, std::chrono::milliseconds(1)),
                 interaction::Error)
        << "a command does not wait for ever";
    seated.pop_back();
    EXPECT_TRUE(eventually(is_answered));
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
    const auto memory = [] {
        rusage use{};
        getrusage(RUSAGE_SELF, &use);
        return use.ru_maxrss; // [KiB]
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
    EXPECT_EQ(state_->step, (kMany - 1) % 3) << "the last one counts";
    EXPECT_LE(taken_.size(), frames_);
}

TEST_F(ControlServerTest, EventsTellWhatChangesAndNoMoreOftenThanAsked) {
    listen("", {.clock = [&] { return Seconds(now_.load()); }});
    ControlClient client(server_->address()), other(server_->address());
    ControlRequest subscribe = verb(ControlVerb::subscribe);
    subscribe.to[static_cast<std::size_t>(ControlTopic::time)] = true;
    subscribe.rate = 1;
    ask(client, subscribe);
    const auto event = [&] { return json::parse(client.next()->line); };
    EXPECT_EQ(event().at("time").at("step"), 0);
    ask(other, step(1));
    ask(other, step(2));
    EXPECT_FALSE(client.waits_for_more(0)) << "a second has not passed";
    now_ = 2;
    ask(other, verb(ControlVerb::state));
    show();
    EXPECT_EQ(event().at("time").at("step"), 2) << "the newest, not each";
}

TEST_F(ControlServerTest, LoopbackAsksForATokenThatOnlyTheUserCanRead) {
    listen("127.0.0.1:0");
    const auto token = control_token_file(server_->address().port);
    struct stat file{};
    ASSERT_EQ(stat(token.c_str(), &file), 0);
    EXPECT_EQ(file.st_mode & 0777, 0600u);
    EXPECT_NE(answer_to("{\"verb\":\"state\"}\n{\"verb\":\"state\"}\n").find("token is wrong"),
              std::string::npos);
    EXPECT_EQ(answer_to("{\"verb\":\"hello\",\"token\":\"00000000000000000000000000000000\"}\n{"
                        "\"verb\":\"state\"}\n"),
              "{\"id\":null,\"ok\":false,\"error\":\"hello: the token is wrong or missing\"}\n");
    ControlClient client(server_->address());
    EXPECT_NO_THROW(ask(client, step(1)));
    server_.reset();
    EXPECT_FALSE(std::filesystem::exists(token));
}

TEST_F(ControlServerTest, WhoSaysNoTokenIsNotWaitedFor) {
    listen("localhost:0", {.clock = [&] { return Seconds(now_.load()); }});
    const ControlSocket silent = connect_to(server_->address());
    EXPECT_TRUE(eventually([&] { return server_->clients() == 1; }));
    now_ = 11;
    const ControlSocket next = connect_to(server_->address()); // which wakes it
    char byte = 0;
    EXPECT_EQ(recv(silent.get(), &byte, 1, 0), 0) << "its end";
}

TEST(ControlAddress, IsOfThisMachineAlone) {
    EXPECT_EQ(control_address("127.0.0.1:4242").port, 4242);
    EXPECT_EQ(control_address("./a:b").path, "./a:b");
    for (const char* wrong : {"0.0.0.0:4242", "192.168.1.5:4242", "example.org:80", "[::]:1",
                              "127.0.0.1:70000", "127.0.0.1:"})
        EXPECT_THROW(control_address(wrong), interaction::Error) << wrong;
    EXPECT_THROW(control_address(std::string(200, 'x')), interaction::Error);
}

TEST_F(ControlServerTest, AReplayIsOnlyWatched) {
    listen("", {.only_watches = true});
    ControlClient client(server_->address());
    EXPECT_THROW(ask(client, step(1)), interaction::Error);
    EXPECT_THROW(ask(client, verb(ControlVerb::cells)), interaction::Error);
    EXPECT_NO_THROW(ask(client, verb(ControlVerb::state)));
}

TEST_F(ControlServerTest, APictureAnswersAllWhoWaitForItsKind) {
    listen();
    ControlClient one(server_->address()), other(server_->address());
    ControlRequest now = verb(ControlVerb::picture);
    now.now = true;
    one.send(now);
    other.send(verb(ControlVerb::picture));
    ASSERT_TRUE(eventually([&] { return desk_.wishes().now == 1 && desk_.wishes().final == 1; }));
    const auto given = [](std::uint8_t gray, PictureWishes answers) {
        ControlPicture picture;
        picture.image = {.width = 1, .height = 1, .rgba = {gray, gray, gray, 255}};
        picture.answers = answers;
        return picture;
    };
    desk_.give(given(10, {.now = 1, .final = 0}));
    EXPECT_EQ(one.next()->bytes, std::vector<std::byte>(3, std::byte{10}));
    desk_.give(given(20, {.now = 1, .final = 1}));
    const auto picture = other.next();
    EXPECT_EQ(picture->bytes, std::vector<std::byte>(3, std::byte{20}));
    EXPECT_EQ(json::parse(picture->line).at("format"), "rgb8");
}

} // namespace
} // namespace isochron::app
