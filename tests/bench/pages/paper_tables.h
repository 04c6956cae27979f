// Tables 1, 2 and 3 of the paper, for comparison with the figures measured here.
#pragma once

#include <array>
#include <cstdint>

namespace isochron::bench {

/// One column: the moving sphere, 61 x 50 x 60 vertices, on a dual AMD Athlon MP of 1.2 GHz.
struct PublishedThi {
    std::uint32_t l, max_variation;
    std::uint64_t steps;
    double percent_of_raw, percent_false_positives; ///< of the isovalue's cells
    double search_ms, incremental_ms, speed_up;
};

inline constexpr std::array kTable1{
    PublishedThi{32, 2, 25, 25.0, 5.3, 2.12, 0.46, 4.64},
    PublishedThi{32, 2, 55, 21.4, 2.1, 2.45, 0.65, 3.75},
    PublishedThi{64, 2, 25, 37.2, 1.3, 2.14, 0.74, 2.90},
    PublishedThi{64, 2, 55, 33.0, 0.5, 2.86, 0.88, 3.26},
    PublishedThi{128, 2, 25, 57.0, 0.3, 1.97, 0.89, 2.21},
    PublishedThi{128, 2, 55, 48.9, 0.1, 2.50, 1.00, 2.50},
};

inline constexpr std::array kTable2{
    PublishedThi{64, 1, 25, 116.2, 0.09, 2.07, 0.93, 2.23},
    PublishedThi{64, 1, 55, 107.6, 0.08, 2.32, 0.83, 2.79},
    PublishedThi{64, 2, 25, 37.2, 1.3, 2.14, 0.74, 2.90},
    PublishedThi{64, 2, 55, 33.0, 0.5, 2.86, 0.88, 3.26},
    PublishedThi{64, 3, 25, 26.3, 3.9, 2.36, 0.59, 4.00},
    PublishedThi{64, 3, 55, 22.8, 1.4, 2.93, 0.88, 3.34},
};

/// Frames per second of extraction and rendering together.
struct PublishedRates {
    const char* mode;
    const char* footprint; ///< of the rows measured here
    double sphere, vorticity;
};

inline constexpr std::array kTable3{PublishedRates{"high quality", "gaussian", 50.30, 46.29},
                                    PublishedRates{"fast", "quad", 250.85, 284.42}};

} // namespace isochron::bench
