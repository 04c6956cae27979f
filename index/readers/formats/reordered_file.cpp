// Reads interleaved steps as components, and stacked components as steps, of a plain file.
#include "index/readers/formats/reordered_file.h"

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
                      const ReadOptions& options)
        : chosen_(choose_scalar(std::span(&layout.array, 1), options, header.string())),
          steps_(layout.steps) {
        expect_few_steps(steps_, header.string());
        const std::string time_unit = info.time_unit;
        const StoredLayout timed = layout;
        layout.steps = steps_ * std::exchange(layout.array.components, 1);
        ReadOptions plain = options;
        plain.array.reset();
        plain.component.reset();
        file_ = open_stored(header, std::move(info), layout, plain);
        info_ = file_->info();
        info_.array = chosen_.label();
        info_.arrays = chosen_.offered;
        info_.type = chosen_.value_type();
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
        for (std::size_t at = step; at < file_->steps(); at += steps_) {
            file_->read(at, part);
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
        return component * steps_ + step;
    }

    ChosenScalar chosen_;
    std::size_t steps_;                ///< steps that each component has
    std::unique_ptr<VolumeFile> file_; ///< all steps of each component, one after the other
    SeriesInfo info_;
};

} // namespace

std::unique_ptr<VolumeFile> open_interleaved_steps(const std::filesystem::path& header,
                                                   SeriesInfo info, const StoredLayout& layout,
                                                   const ReadOptions& options) {
    return std::make_unique<InterleavedSteps>(header, std::move(info), layout, options);
}

std::unique_ptr<VolumeFile> open_stacked_components(const std::filesystem::path& header,
                                                    SeriesInfo info, const StoredLayout& layout,
                                                    const ReadOptions& options) {
    return std::make_unique<StackedComponents>(header, std::move(info), layout, options);
}

} // namespace isochron::index
