// Gaussian's cubes (.cube, .cub): values of quantum chemistry on a grid, as text.
//
// Fields after https://gaussian.com/cubegen: two lines of titles; number of atoms, origin and, if
// not 1, values at each point; for each axis, slowest first, its points and its step; the atoms; and,
// where the number of atoms is negative, the orbitals, whose values stand together.
#include "index/error.h"
#include "index/readers/formats/data_stream.h"
#include "index/readers/formats/own_formats.h"
#include "index/readers/formats/stored_file.h"
#include "index/readers/formats/text_header.h"

#include <fmt/format.h>

#include <cmath>
#include <cstdlib>
#include <string_view>
#include <utility>

namespace isochron::index {

namespace {

/// Whether `1 N` stands there, before numbers with points: the number of orbitals and that of the
/// orbital, which belong into files with a negative number of atoms only.
bool has_line_of_orbital(const std::string& head, std::size_t at) {
    const std::vector<std::string> words = words_of(take_line(head, at));
    return words.size() == 2 && words[0] == "1" &&
           words[1].find_first_not_of("0123456789") == std::string::npos &&
           take_line(head, at).find('.') != std::string::npos;
}

} // namespace

std::unique_ptr<VolumeFile> open_gaussian_cube(const std::filesystem::path& path,
                                               const ReadOptions& options) {
    constexpr std::size_t kMost = 1 << 20;
    const std::string name = path.string(), head = head_of(path, kMost);
    std::size_t at = 0;
    const auto text = [&](std::string_view what) {
        if (at >= head.size())
            throw Error("{}: not a Gaussian cube, or truncated: no {}", name, what);
        return take_line(head, at);
    };
    const auto line = [&](std::string_view what, std::size_t least) {
        std::vector<double> numbers = numbers_of(text(what), std::string(what), name);
        if (numbers.size() < least)
            throw Error("{}: not a Gaussian cube: {} with {} numbers, expected {}", name, what,
                        numbers.size(), least);
        return numbers;
    };
    const auto whole = [&](double number, std::string_view what, double most) {
        if (number != std::floor(number) || !(std::abs(number) <= most))
            throw Error("{}: {} {}, expected a whole number up to {}", name, number, what, most);
        return static_cast<std::int64_t>(number);
    };
    text("title");
    text("second title");
    const std::vector<double> first = line("number of atoms and origin", 4);
    constexpr double kMostAtoms = 100'000, kMostAlong = 65'537, kMostValues = 1'000;
    const std::int64_t atoms = whole(first[0], "atoms", kMostAtoms);
    std::int64_t components =
        first.size() > 4 ? whole(first[4], "values at each point", kMostValues) : 1;
    SeriesInfo info;
    info.grid.origin = {first[1], first[2], first[3]};
    std::array<std::int64_t, 3> sizes{};
    glm::dmat3 axes(1.0);
    bool in_angstrom = false;
    for (int axis = 2; axis >= 0; --axis) { // the last one is the fastest
        const std::vector<double> numbers = line("points and step of an axis", 4);
        const std::int64_t points = whole(numbers[0], "points", kMostAlong);
        in_angstrom = in_angstrom || points < 0;
        sizes[static_cast<std::size_t>(axis)] = std::abs(points);
        axes[axis] = {numbers[1], numbers[2], numbers[3]};
    }
    info.grid.vertices = checked_vertices(sizes, name);
    set_axes(info.grid, axes, name);
    info.length_unit = in_angstrom ? "angstrom" : "bohr";
    for (std::int64_t i = 0; i < std::abs(atoms); ++i)
        line("atom", 5);
    if (atoms < 0) {
        std::vector<double> orbitals = line("orbitals", 1);
        components = whole(orbitals[0], "orbitals", kMostValues);
        for (auto seen = static_cast<std::int64_t>(orbitals.size()) - 1; seen < components;)
            seen += static_cast<std::int64_t>(line("orbitals", 1).size());
    }
    if (atoms > 0 && has_line_of_orbital(head, at)) {
        text("orbital");
        info.notes.push_back("a line of orbitals follows the atoms, as Molden writes it");
    }
    if (components < 1)
        throw Error("{}: {} values at each point, expected at least 1", name, components);
    if (atoms != 0)
        info.notes.push_back(fmt::format("{} atom{} beside the values left out", std::abs(atoms),
                                         std::abs(atoms) == 1 ? "" : "s"));
    StoredLayout layout;
    layout.data = path;
    layout.offset = at;
    layout.ascii = true;
    layout.array = {"values", StoredType::f64, static_cast<std::uint32_t>(components)};
    return open_stored(path, std::move(info), layout, options);
}

} // namespace isochron::index
