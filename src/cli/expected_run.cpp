#include "cli/expected_run.h"

#include <algorithm>

namespace vcarve::cli {

PredictedTimes expected_run(const SceneSize& read, const Options& options,
                            const ExpectedOutputs& outputs, int threads)
{
    // Measured as those of predicted_times(). Over as many faces a surface is simplified for the
    // page.
    constexpr double kPreview = 1.5;
    constexpr double kPreviewPoint = 1e-6;
    constexpr double kReportPoint = 0.6e-6;
    constexpr double kReportFace = 20e-6;
    constexpr double kFacesPerPoint = 1.8;
    constexpr double kFacesOnPage = 200'000;
    PredictedTimes times = predicted_times(read, options, threads);
    if (outputs.photo_pixels > 0.0) {
        constexpr double kPhotosFace = 45e-6;
        constexpr double kReadPixel = 20e-9;
        constexpr double kPaintPixel = 30e-9;
        const double faces = kFacesPerPoint * times.points;
        times.stages.push_back({"photos", kPhotosFace * faces / threads});
        times.stages.push_back({"colors", kReadPixel * outputs.photo_pixels / threads});
        if (outputs.texture) {
            times.stages.push_back({"texture", kPaintPixel * outputs.photo_pixels / threads});
        }
    }
    if (outputs.preview) {
        const double seconds = kPreview / threads + kPreviewPoint * times.points;
        times.stages.push_back({"preview", seconds});
    }
    if (outputs.report) {
        const double fewer = std::max(kFacesPerPoint * times.points - kFacesOnPage, 0.0);
        times.stages.push_back({"report", kReportPoint * times.points + kReportFace * fewer});
    }
    return times;
}

} // namespace vcarve::cli
