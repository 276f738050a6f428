#pragma once

#include "io/colmap/find_model.h"
#include "io/dense/dense_scene.h"
#include "io/dense/scanner_views.h"
#include "vcarve/io.h"

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace vcarve {

/// What is read: a model with its own points, or its views with the points of a cloud, or a scan,
/// which needs no model.
struct FoundInput {
    FoundModel model; ///< without a folder where there is none beside a scan
    std::optional<DenseFiles> dense;
    std::optional<ScanFile> scan;
    std::vector<std::string> notes;            ///< sentences: what was taken and what not
    SightsFrom sights = SightsFrom::automatic; ///< of the points of the model

    /// Whether the views of points are the nearest ones, since no file says which saw them.
    bool takes_nearest_views() const
    {
        return sights == SightsFrom::nearest ||
               (dense && dense->visibility.empty() && !dense->takes_lists);
    }
};

/// Finds what `input` and the options mean, see read_model. Throws UsageError where they contradict
/// each other, and InputError where there is no model, or no cloud or visibility that they ask for.
FoundInput find_input(const std::filesystem::path& input, const PointsOptions& options);

/// The files that nothing may be written to, since `input` is made of them, read or not: of models
/// in any format, the cloud that was found and what tells of its views, what COLMAP keeps beside
/// (the database, the dense workspace, images). Cost: a look at each file in the folders images and
/// stereo.
std::vector<std::filesystem::path> input_files(const std::filesystem::path& input,
                                               const FoundInput& found);

/// Whether a file is an image of the views that were found, by the end of its path once links are
/// followed. Cost: that of reading the views, where it has the name of an image.
bool is_image_of_views(const std::filesystem::path& file, const FoundInput& found);

} // namespace vcarve
