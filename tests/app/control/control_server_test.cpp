// The control socket and clients that mean well; the test is the loop of frames.
#include "tests/app/control/control_fixture.h"

#include <nlohmann/json.hpp>

#include <sys/stat.h>

namespace isochron::app {
namespace {

using nlohmann::json;

TEST_F(ControlServerTest, IsASocketThatItsUserAloneMayOpenAndIsGoneAtTheEnd) {
    listen();
    const auto path = default_control_path();
    struct stat socket {};
    ASSERT_EQ(stat(path.c_str(), &socket), 0);
    EXPECT_EQ(socket.st_mode & 0777, 0600u);
    EXPECT_THROW(ControlServer(control_address(""), desk_, {}), interaction::Error)
        << "it is in use";
    server_.reset();
    EXPECT_FALSE(std::filesystem::exists(path));
}

TEST_F(ControlServerTest, ReplacesASocketThatWasLeftBehindAndNothingElse) {
    ControlAddress address = control_address("");
    { const ControlSocket left = listen_at(address); }
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
    EXPECT_EQ(state_->instant, index::Instant(2));
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
    step_two.instant.emplace(2u);
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
    EXPECT_EQ(frames[0].instant, index::Instant(2));
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
    struct stat file {};
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
