#pragma once

#include "io/colmap/colmap_model.h"
#include "io/images/find_photographs.h"
#include "io/input/find_input.h"
#include "vcarve/io.h"
#include "vcarve/log.h"
#include "vcarve/options.h"

#include <cstdint>
#include <filesystem>
#include <vector>

namespace vcarve {

/// What the user typed, resolved once: the files of a run.
struct RunInput {
    std::filesystem::path path; ///< as typed
    FoundInput found;
    Scene views{};                           ///< cameras and views; without points
    std::vector<std::uint32_t> file_order{}; ///< of the views, see ColmapViews
    RunImages images{};
};

/// Finds the model or cloud, and the photographs and masks that the options need. Reads the views
/// for that, or if `needs_views`. Throws the exceptions of find_input(), read_colmap_views() and
/// find_images(), and InputError if a scan is to have photographs. Cost: reading the views, and the
/// header of each photograph.
RunInput resolve_input(const std::filesystem::path& path, const PointsOptions& points,
                       const Options& options, bool needs_views, Log& log);

} // namespace vcarve
