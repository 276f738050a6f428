#include "pipeline/predicted_time.h"

#include "pipeline/memory.h"
#include "pipeline/stages.h"

namespace vcarve {

PredictedTimes predicted_times(const SceneSize& read, const Options& options, int threads)
{
    constexpr double kLeftOfCloud = 0.5; // a cloud of stereo holds each place about twice
    const RunSize size = size_before_thinning(read, options);
    Needs needs = needs_of(size, threads);
    needs.left = needs.read;
    if (size.in_parts) needs.left.points *= kLeftOfCloud;
    PredictedTimes times = {.stages = {}, .points = needs.left.points};
    for (const RunStage& stage : all_stages()) {
        if (stage.seconds == nullptr || !stage.applies(needs)) continue;
        times.stages.push_back({stage.name, stage.seconds(needs)});
    }
    return times;
}

} // namespace vcarve
