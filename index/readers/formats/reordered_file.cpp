// Reads interleaved steps as components, and stacked components as steps, of a plain file.
#include "index/readers/formats/reordered_file.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

namespace isochron::index {
namespace {

class InterleavedSteps final : public VolumeFile {
  public:
    InterleavedSteps(std::filesystem::path header, SeriesInfo info, StoredLayout layout,
                     const ReadOptions& options)
        : header_(std::move(header)), plain_(std::move(info)), layout_(std::move(layout)),
          options_(options), steps_(layout_.steps) {
        expect_few_steps(steps_, header_.string());
        layout_.array.components = static_cast<std::uint32_t>(steps_);
        layout_.steps = 1;
        open(0);
        info_ = file_->info();
        info_.array = layout_.array.name;
        info_.time_unit = plain_.time_unit;
        give_times(info_, layout_, steps_);
    }

    const SeriesInfo& info() const override { return info_; }
    std::size_t steps() const override { return steps_; }
    std::vector<std::filesystem::path> beside() const override { return file_->beside(); }

    void read(std::size_t step, std::span<std::byte> out) override {
        open_for(step);
        file_->read(0, out);
    }
    void stream(std::size_t step, const TakePiece& take) override {
        open_for(step);
        file_->stream(0, take);
    }

  private:
    void open_for(std::size_t step) {
        if (step != open_)
            open(step);
    }

    void open(std::size_t step) {
        ReadOptions options = options_;
        options.component = std::to_string(step);
        file_ = open_stored(header_, plain_, layout_, options);
        open_ = step;
    }

    std::filesystem::path header_;
    SeriesInfo plain_; ///< the description before the file is opened
    StoredLayout layout_;
    ReadOptions options_;
    std::size_t steps_;
    SeriesInfo info_;
    std::unique_ptr<VolumeFile> file_; ///< opened for one step
    std::size_t open_ = 0;
};

class StackedComponents final : public VolumeFile {
  public:
    StackedComponents(const std::filesystem::path& header, SeriesInfo info, StoredLayout layout,
                      bool in_each_step, const ReadOptions& options)
        : chosen_(choose_scalar(std::span(&layout.array, 1), options, header.string())),
          steps_(layout.steps), in_each_step_(in_each_step) {
        expect_few_steps(steps_, header.string());
        const std::string time_unit = info.time_unit;
        const StoredLayout timed = layout;
        layout.steps = steps_ * std::exchange(layout.array.components, 1);
        ReadOptions plain = options;
        plain.array.reset();
        plain.component.reset();
        file_ = open_stored(header, std::move(info), layout, plain);
        info_ = file_->info();
        chosen_.describe(info_);
        info_.time_unit = time_unit;
        give_times(info_, timed, steps_);
    }

    const SeriesInfo& info() const override { return info_; }
    std::size_t steps() const override { return steps_; }
    std::vector<std::filesystem::path> beside() const override { return file_->beside(); }

    void read(std::size_t step, std::span<std::byte> out) override {
        if (chosen_.component != ChosenScalar::kMagnitude)
            return file_->read(place(chosen_.component, step), out);
        const std::size_t count = info_.grid.vertex_count();
        std::vector<double> squares(count);
        std::vector<std::byte> part(file_->info().step_bytes());
        for (std::size_t component = 0; component < chosen_.array.components; ++component) {
            file_->read(place(component, step), part);
            visit_value_type(file_->info().type, [&]<class T>(std::type_identity<T>) {
                const T* values = reinterpret_cast<const T*>(part.data());
                for (std::size_t i = 0; i < count; ++i)
                    squares[i] += static_cast<double>(values[i]) * static_cast<double>(values[i]);
            });
        }
        visit_value_type(info_.type, [&]<class T>(std::type_identity<T>) {
            T* values = reinterpret_cast<T*>(out.data());
            for (std::size_t i = 0; i < count; ++i)
                values[i] = static_cast<T>(std::sqrt(squares[i]));
        });
    }

    void stream(std::size_t step, const TakePiece& take) override {
        if (chosen_.component != ChosenScalar::kMagnitude)
            return file_->stream(place(chosen_.component, step), take);
        std::vector<std::byte> whole(info_.step_bytes());
        read(step, whole);
        take(whole);
    }

  private:
    /// The plain file's step.
    std::size_t place(std::size_t component, std::size_t step) const {
        return in_each_step_ ? step * chosen_.array.components + component
                             : component * steps_ + step;
    }

    ChosenScalar chosen_;
    std::size_t steps_;                ///< steps that each component has
    bool in_each_step_;
    std::unique_ptr<VolumeFile> file_; ///< all steps of each component, one after the other
    SeriesInfo info_;
};

class AxisBetween final : public VolumeFile {
  public:
    AxisBetween(const std::filesystem::path& header, SeriesInfo info, StoredLayout layout,
                int below, const ReadOptions& options)
        : chosen_(choose_scalar(std::span(&layout.array, 1), options, header.string())),
          steps_(layout.steps) {
        expect_few_steps(steps_, header.string());
        const auto [nx, ny, nz] = info.grid.vertices;
        along_ = std::max<std::size_t>(steps_, layout.array.components);
        const auto along = static_cast<std::uint32_t>(along_);
        row_ = below == 1 ? nx : std::size_t{nx} * ny;
        SeriesInfo blocks = info; // a step of the plain file is a block with all of the axis
        blocks.grid = {};
        blocks.grid.vertices = below == 1 ? std::array{nx, along, ny} : std::array{nx, ny, along};
        const StoredLayout timed = layout;
        layout.steps = nz;
        layout.array.components = 1;
        ReadOptions plain = options;
        plain.array.reset();
        plain.component.reset();
        plain.spacing.reset();
        file_ = open_stored(header, blocks, layout, plain);
        info_ = file_->info();
        info_.grid = info.grid;
        info_.times = info.times;
        info_.time_unit = info.time_unit;
        chosen_.describe(info_);
        if (info_.times.empty())
            give_times(info_, timed, steps_);
        block_.resize(file_->info().step_bytes());
    }

    const SeriesInfo& info() const override { return info_; }
    std::size_t steps() const override { return steps_; }
    std::vector<std::filesystem::path> beside() const override { return file_->beside(); }

    void read(std::size_t step, std::span<std::byte> out) override {
        if (chosen_.component != ChosenScalar::kMagnitude)
            return take(steps_ > 1 ? step : chosen_.component, out);
        const std::size_t count = info_.grid.vertex_count();
        std::vector<double> squares(count);
        std::vector<std::byte> part(count * size_of(file_->info().type));
        for (std::size_t component = 0; component < along_; ++component) {
            take(component, part);
            visit_value_type(file_->info().type, [&]<class T>(std::type_identity<T>) {
                const T* values = reinterpret_cast<const T*>(part.data());
                for (std::size_t i = 0; i < count; ++i)
                    squares[i] += static_cast<double>(values[i]) * static_cast<double>(values[i]);
            });
        }
        visit_value_type(info_.type, [&]<class T>(std::type_identity<T>) {
            T* values = reinterpret_cast<T*>(out.data());
            for (std::size_t i = 0; i < count; ++i)
                values[i] = static_cast<T>(std::sqrt(squares[i]));
        });
    }

    void stream(std::size_t step, const TakePiece& take_piece) override {
        std::vector<std::byte> whole(info_.step_bytes());
        read(step, whole);
        take_piece(whole);
    }

  private:
    /// Copies what lies at one place along the axis.
    void take(std::size_t at, std::span<std::byte> out) {
        const std::size_t bytes = row_ * size_of(file_->info().type);
        std::byte* to = out.data();
        for (std::size_t z = 0; z < file_->steps(); ++z) {
            file_->read(z, block_);
            for (std::size_t from = at * bytes; from < block_.size(); from += along_ * bytes)
                to = std::copy_n(block_.data() + from, bytes, to);
        }
    }

    ChosenScalar chosen_;
    std::size_t steps_, along_ = 1, row_ = 0; ///< row: values that lie together
    std::unique_ptr<VolumeFile> file_;
    std::vector<std::byte> block_;
    SeriesInfo info_;
};

} // namespace

std::unique_ptr<VolumeFile> open_axis_between(const std::filesystem::path& header, SeriesInfo info,
                                              const StoredLayout& layout, int below,
                                              const ReadOptions& options) {
    return std::make_unique<AxisBetween>(header, std::move(info), layout, below, options);
}

std::unique_ptr<VolumeFile> open_interleaved_steps(const std::filesystem::path& header,
                                                   SeriesInfo info, const StoredLayout& layout,
                                                   const ReadOptions& options) {
    return std::make_unique<InterleavedSteps>(header, std::move(info), layout, options);
}

std::unique_ptr<VolumeFile> open_stacked_components(const std::filesystem::path& header,
                                                    SeriesInfo info, const StoredLayout& layout,
                                                    bool in_each_step, const ReadOptions& options) {
    return std::make_unique<StackedComponents>(header, std::move(info), layout, in_each_step,
                                               options);
}

} // namespace isochron::index
