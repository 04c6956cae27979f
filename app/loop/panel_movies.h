// The movies and recordings that the panel asks for, and the folder of pictures that it chooses.
#pragma once

#include "app/loop/companion.h"
#include "app/loop/live_recording.h"
#include "app/loop/movie_maker.h"

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

namespace isochron::app {

class PanelMovies final : public Companion {
  public:
    /// @param recording of the session: movies are made of it, and its thread writes their files
    PanelMovies(MovieOrders orders, std::shared_ptr<LiveRecording> recording);

    void after_frame(Session& session, const LiveFrame& frame) override;
    std::vector<std::string> messages() override { return movies_.messages(); }
    FrameOutlook outlook(interaction::Seconds now) const override {
        return {.final = true,
                .until = movies_.busy() ? now + kLookForWords : FrameOutlook::kNever};
    }
    std::string why_stay() const override;
    std::vector<std::string> finish(const Session&) override {
        movies_.finish();
        return movies_.messages();
    }

  private:
    std::filesystem::path chosen_folder(const Session& session) const;
    void place_pictures(Session& session);
    void begin_or_end_recording(Session& session);
    void make_figure(const Session& session, MovieManner manner);
    void save_story(Session& session);

    const std::shared_ptr<LiveRecording> recording_;
    MovieMaker movies_;
    std::string picture_folder_; ///< that the user has chosen; empty: none
};

} // namespace isochron::app
