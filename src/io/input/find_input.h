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

/// The input: a model with its points, the views of a model with the points of a cloud, or a scan,
/// which needs no model.
struct FoundInput {
    FoundModel model; ///< without a folder if a scan has no model
    std::optional<DenseFiles> dense;
    std::optional<ScanFile> scan;
    std::vector<std::string> notes;      ///< sentences about used and ignored files
    RaysFrom rays = RaysFrom::automatic; ///< for the points of the model

    /// Whether points get the nearest views, because no file has the views that saw them.
    bool takes_nearest_views() const
    {
        return rays == RaysFrom::nearest ||
               (dense && dense->visibility.empty() && !dense->takes_lists);
    }
};

/// Finds the files that `input` and the options select, see read_model. Throws UsageError if they
/// contradict each other, and InputError if the model, or a selected file, is missing.
FoundInput find_input(const std::filesystem::path& input, const PointsOptions& options);

/// Returns the files of `input`, read or not, which must not be overwritten. These are models in
/// all formats, the found cloud and the file with its views, and COLMAP's files beside them
/// (database, dense workspace, images). Cost: visits each file in the folders images and stereo.
std::vector<std::filesystem::path> input_files(const std::filesystem::path& input,
                                               const FoundInput& found);

/// Whether a file is the image of a view, which is so if its path, with links resolved, ends with
/// the view's name. Cost: reads the views if the file has the extension of an image.
bool is_image_of_views(const std::filesystem::path& file, const FoundInput& found);

} // namespace vcarve
