#pragma once

#include "base/progress.h"
#include "model/scene_check.h"
#include "vcarve/scene.h"

#include <Eigen/Core>

#include <cstddef>
#include <filesystem>
#include <optional>
#include <vector>

namespace vcarve {

/// So many stations a scene has at most.
inline constexpr std::size_t kMostStations = 1024;

/// Makes the places of laser scanners the views of a scene, which has points and nothing else yet,
/// and gives every point a sight to where it was measured from. `scanners` is one place a point, or
/// one for all of them. A point that is not finite gets no sight.
///
/// Every place is a view, in the order of the points. A scanner that moves has a new place for
/// every point, though, and then there are stations instead: a cube whose side is a fiftieth of the
/// median range is one station, at the first place in it, which is in free space for certain; where
/// there are more than kMostStations of those or of places, cubes are twice as large until there
/// are not. So a sight is off by an angle of about a degree at most, and exact at its point.
///
/// A station looks all round, through an equirectangular lens, and measures ranges
/// (Camera::measures_range). Its pixels are a quarter as wide as points stand apart, seen from
/// their stations: the median over 200 points of the distance at which eight others stand around,
/// of all stations. The share of the sphere that a point has would say less: most beams of a
/// scanner that stands before a thing meet nothing, and that of a profile scanner's place lie in a
/// plane. Cost: O(points), in parallel but for a table of places.
void add_scanner_views(const std::vector<Eigen::Vector3d>& scanners, Scene& scene);

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
