// Sets of random cells, and checks of their contents on the GPU.
#pragma once

#include "tests/render/cells/extractions.h"
#include "tests/support/drawing/gl_test.h"

#include <algorithm>
#include <set>
#include <tuple>
#include <vector>

namespace isochron::render {

constexpr std::size_t kEnough = std::size_t{1} << 30; ///< bytes a frame

class CellUploadTest : public GlTest {
  protected:
    using Cell = std::tuple<unsigned, index::CellId>; ///< surface, id
    static std::vector<Cell> cells_of(const index::Extraction& set) {
        std::vector<Cell> all;
        for (unsigned s = 0; s < set.surfaces.size(); ++s)
            for (const index::CellId id : set.surfaces[s].ids)
                all.emplace_back(s, id);
        return all;
    }
    /// What is drawn, from GPU memory.
    std::vector<index::CellPoint> drawn_points(const CellBuffers& buffers) {
        gl_.BindTextureUnit(0, buffers.texture());
        gl_.ActiveTexture(GL_TEXTURE0);
        GLint buffer = 0;
        gl_.GetIntegerv(GL_TEXTURE_BUFFER_DATA_STORE_BINDING, &buffer);
        std::vector<index::CellPoint> points(buffers.size());
        if (!points.empty())
            gl_.GetNamedBufferSubData(GLuint(buffer), 0,
                                      GLsizeiptr(points.size() * sizeof points[0]), points.data());
        return points;
    }
    std::vector<Cell> drawn(const CellBuffers& buffers) {
        const auto points = drawn_points(buffers);
        std::vector<Cell> all;
        for (std::size_t slot = 0; slot < points.size(); ++slot) {
            const index::CellPoint& p = points[slot];
            const CellPlace& place = buffers.slots().places[slot];
            EXPECT_EQ((CellPlace{p.x, p.y, p.z, p.style}), place) << "slot " << slot;
            all.emplace_back(p.style & 7u, (index::CellId{p.z} * kSide + p.y) * kSide + p.x);
        }
        std::ranges::sort(all);
        return all;
    }
    void expect_whole(const CellBuffers& buffers) {
        ASSERT_TRUE(buffers.shown());
        EXPECT_EQ(drawn(buffers), cells_of(*buffers.shown()));
    }
    std::vector<index::CellId> random_ids(std::size_t count) {
        std::set<index::CellId> ids;
        while (ids.size() < count)
            ids.insert(index::CellId(random_() % (kSide * kSide * kSide)));
        return {ids.begin(), ids.end()};
    }
    index::ExtractionPtr random_set(std::size_t count) {
        return extractions_.of_cells(std::uint32_t(random_() % 2), {random_ids(count)});
    }

    static constexpr unsigned kSide = 19; ///< cells
    index::TestField field_{{kSide + 1, kSide + 1, kSide + 1},
                            2,
                            index::ValueType::u8,
                            index::scaled(index::white_noise(random_), 100, 100)};
    Extractions extractions_{field_.view()};
};

} // namespace isochron::render
