// Who takes an image band by band, while later bands are drawn.
#pragma once

#include <functional>
#include <memory>
#include <vector>

#include "quadrel/film/film.hpp"

namespace quadrel {

/// What is to be done with a band; either may be none.
struct BandStep {
    std::function<void()> work;    ///< on any thread, beside the work on other bands
    std::function<void()> finish;  ///< after it, in the order of the bands, one at a time
};

/// Bands are films: whole rows of the image's window, each beginning where the one before ends.
class BandSink {
  public:
    virtual ~BandSink() = default;

    /// Takes the next band from the top; never two at a time, on any thread. Who is done with it
    /// lets go of it: its memory is drawn into again.
    virtual BandStep take(std::shared_ptr<const Film> band) = 0;

    /// After the last band's finish, on the thread that asked for the image.
    virtual void end() {}
};

/// Several sinks of one image, at least one.
std::unique_ptr<BandSink> join_sinks(std::vector<std::unique_ptr<BandSink>> sinks);

/// Makes a sink, once it is settled what comes: frame, window, and planes without values.
using BandSinkMaker = std::function<std::unique_ptr<BandSink>(const Film& layout)>;

}  // namespace quadrel
