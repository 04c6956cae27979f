// `isochron serve`: what it prints opens its files, and what it writes is a site.
#include "tests/app/commands/command_line.h"
#include "tests/support/child_process.h"

#include <arpa/inet.h>
#include <csignal>
#include <netinet/in.h>
#include <regex>
#include <sys/socket.h>
#include <unistd.h>

namespace isochron::app {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;
using testing::StartsWith;

/// The answer of a server on this machine to a request, whole.
std::string asked(int port, const std::string& request) {
    const int to = socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0);
    sockaddr_in where{};
    where.sin_family = AF_INET;
    where.sin_port = htons(static_cast<std::uint16_t>(port));
    where.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    std::string answer;
    if (connect(to, reinterpret_cast<sockaddr*>(&where), sizeof where) == 0 &&
        write(to, request.data(), request.size()) == static_cast<ssize_t>(request.size())) {
        char block[4096];
        for (ssize_t count; (count = read(to, block, sizeof block)) > 0;)
            answer.append(block, static_cast<std::size_t>(count));
    }
    close(to);
    return answer;
}

class ServeCommand : public CommandLine {
  protected:
    ServeCommand() { EXPECT_EQ(isochron(build_of("t*.raw")).status, 0); }
};

TEST_F(ServeCommand, SendsRangesToWhoeverHasTheLinkUntilItIsEnded) {
    int said[2];
    ASSERT_EQ(pipe(said), 0);
    const pid_t server = fork();
    ASSERT_GE(server, 0);
    if (server == 0) {
        dup2(said[1], STDOUT_FILENO);
        close(said[0]);
        const std::string program = test_support::binary_root() + "/isochron";
        const std::string file = (folder.path() / "a.isochron").string();
        execl(program.c_str(), program.c_str(), "serve", file.c_str(), nullptr);
        _exit(127);
    }
    close(said[1]);
    std::string link;
    for (char c; read(said[0], &c, 1) == 1 && c != '\n';)
        link += c;
    std::smatch parts;
    ASSERT_TRUE(std::regex_match(link, parts,
                                 std::regex(R"(http://127\.0\.0\.1:(\d+)/#token=([0-9a-f]{32}))")))
        << link;
    const int port = std::stoi(parts[1]);
    const auto get = [&](const std::string& path, const std::string& more) {
        return asked(port, fmt::format("GET {} HTTP/1.1\r\nHost: 127.0.0.1:{}\r\nConnection: "
                                       "close\r\n{}\r\n",
                                       path, port, more));
    };
    const std::string token = fmt::format("Authorization: Bearer {}\r\n", parts[2].str());
    const std::string file = folder.read("a.isochron");
    const std::string part = get("/a.isochron", token + "Range: bytes=0-7\r\n");
    EXPECT_THAT(part, StartsWith("HTTP/1.1 206"));
    EXPECT_TRUE(part.ends_with("\r\n\r\nISOCHRON")) << part;
    const std::string whole = get("/a.isochron", token);
    EXPECT_TRUE(whole.ends_with(file));
    const std::string two = get("/a.isochron", token + "Range: bytes=0-2,4-7\r\n");
    EXPECT_THAT(two, HasSubstr("\r\n\r\nISO\r\n--"));
    EXPECT_THAT(two, HasSubstr("\r\n\r\nHRON\r\n--"));
    EXPECT_THAT(get("/a.isochron", ""), StartsWith("HTTP/1.1 401"));
    EXPECT_THAT(get("/t0.raw", token), StartsWith("HTTP/1.1 404"));
    EXPECT_THAT(get("/", ""), HasSubstr("<title>Isochron</title>"));
    EXPECT_THAT(asked(port, "GET / HTTP/1.1\r\nHost: evil.example\r\nConnection: close\r\n\r\n"),
                StartsWith("HTTP/1.1 403"));
    // A head that does not end, and one that is too long, end the connection and not the server.
    EXPECT_THAT(asked(port, "GET /" + std::string(100000, 'a') + " HTTP/1.1\r\n\r\n"),
                testing::Not(StartsWith("HTTP/1.1 2")));
    EXPECT_THAT(get("/site.json", token), HasSubstr("a.isochron"));
    kill(server, SIGTERM);
    int status = 0;
    ASSERT_EQ(waitpid(server, &status, 0), server);
    EXPECT_TRUE(WIFEXITED(status));
    close(said[0]);
}

TEST_F(ServeCommand, WritesASiteIntoAFolderOfItsOwn) {
    const ChildResult wrote = isochron({"serve", "a.isochron", "--write-site", "site"});
    ASSERT_EQ(wrote.status, 0) << wrote.err;
    EXPECT_EQ(folder.read("site/a.isochron"), folder.read("a.isochron"));
    EXPECT_THAT(folder.read("site/index.html"), HasSubstr("<title>Isochron</title>"));
    EXPECT_THAT(folder.read("site/site.json"), HasSubstr("a.isochron"));
    EXPECT_EQ(isochron({"serve", "a.isochron", "--write-site", "site"}).status, 0) << "its own";
    fs::create_directory(folder.path() / "foreign");
    folder.write("foreign/letter", "x");
    const ChildResult refused = isochron({"serve", "a.isochron", "--write-site", "foreign"});
    EXPECT_NE(refused.status, 0);
    EXPECT_THAT(refused.err, HasSubstr("nothing is written"));
    EXPECT_EQ(std::distance(fs::directory_iterator(folder.path() / "foreign"), {}), 1);
}

TEST_F(ServeCommand, RefusesWhatItCannotServe) {
    for (const auto& [arguments, said] :
         std::vector<std::pair<std::vector<std::string>, std::string>>{
             {{"serve", "t0.raw"}, "t0.raw"},
             {{"serve", "gone.isochron"}, "gone.isochron"},
             {{"serve", "a.isochron", "--address", "not.an.address"}, "--address"},
             {{"serve", "a.isochron", "--port", "70000"}, "--port"},
             {{"serve", "a.isochron", "--certificate", "t0.raw"}, "--key"},
             {{"serve", "a.isochron", "--certificate", "t0.raw", "--key", "t0.raw"}, "PEM"}}) {
        const ChildResult refused = isochron(arguments);
        EXPECT_NE(refused.status, 0);
        EXPECT_THAT(refused.err, HasSubstr(said));
    }
}

} // namespace
} // namespace isochron::app
