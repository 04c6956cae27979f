// Changes inputs of the fuzz targets at random, the same for the same seed: without a compiler that
// watches coverage, for the tests of every day.
#pragma once

#include "tests/fuzz/targets.h"

#include <cstdint>
#include <filesystem>
#include <random>
#include <string>
#include <vector>

namespace isochron::fuzz {

using Input = std::vector<std::uint8_t>;

/// The files of these folders, each once, in the order of their names; folders need not exist.
std::vector<Input> inputs_in(const std::vector<std::filesystem::path>& folders);

/// The words of a libFuzzer dictionary; none where there is no such file.
std::vector<std::string> words_in(const std::filesystem::path& dictionary);

class Changes {
  public:
    /// @param inputs at least one
    Changes(std::vector<Input> inputs, std::vector<std::string> words, std::uint64_t seed)
        : inputs_(std::move(inputs)), words_(std::move(words)), random_(seed) {}

    /// One of the inputs with one to four changes: bits, bytes, numbers and words in other places,
    /// pieces that are missing, doubled, or of another input. What is compressed in it is changed as
    /// it is inside, half of the time.
    Input next();

  private:
    std::size_t below(std::size_t end);
    void change(Input& input);

    std::vector<Input> inputs_;
    std::vector<std::string> words_;
    std::mt19937_64 random_;
};

} // namespace isochron::fuzz
