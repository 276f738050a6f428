#pragma once

#include "base/progress.h"
#include "model/scene_check.h"
#include "vcarve/scene.h"

#include <Eigen/Core>

#include <filesystem>
#include <optional>

namespace vcarve {

/// The points of a laser scan, and where its scanners stood.
struct ScanFile {
    std::filesystem::path cloud; ///< PLY
    /// Where the scanner of all points stood, in the coordinates of the file; nothing where the
    /// file tells.
    std::optional<Eigen::Vector3d> scanner;
};

/// A scene of the points of a scan, all of them and in their order, and of its scanners, which are
/// its views (see add_scanner_views); points have what dense ones have (see read_dense_scene). A
/// point that is not finite has no sight. Throws InputError naming file and place, and Cancelled.
/// Cost: as read_ply_cloud and add_scanner_views.
Scene read_scan_scene(const ScanFile& file, const Progress& progress = {});

/// How large the scene will be, by the cloud's header; nothing where that is too large or has no
/// vertices, which reading will tell of. Throws InputError where the header is broken. Cost: none.
std::optional<SceneSize> scan_size_before_reading(const ScanFile& file);

} // namespace vcarve
