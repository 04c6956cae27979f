// Runs code inside the fence, in a process of its own.
#include "tests/fence/inside.h"

#include "index/readers/decoders/fence.h"

#include <fmt/format.h>

#include <sys/wait.h>
#include <unistd.h>

#include <array>

namespace isochron::test_support {

std::string surprises_inside(std::span<const std::filesystem::path> readable,
                             const std::function<std::string()>& inside) {
    std::array<int, 2> told{};
    if (::pipe(told.data()) != 0)
        return "no pipe";
    const pid_t child = ::fork();
    if (child == 0) {
        ::close(told[0]);
        const std::string refused(index::fence_in(readable));
        const std::string found = refused.empty() ? inside() : "the system refuses " + refused;
        [[maybe_unused]] const auto size = ::write(told[1], found.data(), found.size());
        ::_exit(0);
    }
    ::close(told[1]);
    std::string found;
    std::array<char, 4096> piece{};
    for (ssize_t size; (size = ::read(told[0], piece.data(), piece.size())) > 0;)
        found.append(piece.data(), static_cast<std::size_t>(size));
    ::close(told[0]);
    int status = 0;
    ::waitpid(child, &status, 0);
    if (!WIFEXITED(status) || WEXITSTATUS(status) != 0)
        found += fmt::format("ended with status {:x}\n", status);
    return found;
}

} // namespace isochron::test_support
