// A team: processes that work together.
#include "index/system/team.h"

#include "index/error.h"
#include "index/system/module.h"

#include <fmt/format.h>

#include <cstdlib>
#include <exception>

namespace isochron::index {
namespace {

class Alone final : public Team {
  public:
    unsigned rank() const override { return 0; }
    unsigned size() const override { return 1; }
    std::vector<std::vector<std::byte>> gather(std::span<const std::byte> mine) override {
        return {{mine.begin(), mine.end()}};
    }
    void post(unsigned, std::span<const std::byte>) override {} // there is nobody else
    std::optional<Message> poll() override { return std::nullopt; }
    [[noreturn]] void abandon(int status) override { std::_Exit(status); }
};

} // namespace

void Team::together(const std::function<void()>& part) {
    std::exception_ptr failure;
    std::string what;
    try {
        part();
    } catch (const std::exception& error) {
        failure = std::current_exception();
        what = fmt::format("!{}", error.what()); // never empty
    }
    const auto said = gather(std::as_bytes(std::span(what)));
    if (failure)
        std::rethrow_exception(failure);
    for (const std::vector<std::byte>& other : said)
        if (!other.empty())
            throw Error(
                std::string(reinterpret_cast<const char*>(other.data()) + 1, other.size() - 1));
}

Team::Share Team::share(std::size_t count) const {
    return {count * rank() / size(), count * (rank() + 1) / size()};
}

std::unique_ptr<Team> alone() {
    return std::make_unique<Alone>();
}

std::unique_ptr<Team> join_team() {
    // Checks the variables of the launchers of Open MPI and MPICH, since MPI itself takes long to
    // load.
    const char* ranks = std::getenv("OMPI_COMM_WORLD_SIZE");
    if (!ranks)
        ranks = std::getenv("PMI_SIZE");
    if (!ranks || std::string(ranks) == "1")
        return alone();
    using Join = Team* (*)();
    const auto join = reinterpret_cast<Join>(module_symbol("isochron_mpi", "isochron_join_team"));
    return std::unique_ptr<Team>(join());
}

} // namespace isochron::index
