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

/// The maximum number of stations of a scene.
inline constexpr std::size_t kMostStations = 1024;

/// Adds views at the positions of laser scanners, and a ray from each point to its scanner.
/// `scanners` has one position per point, or one for all. Non-finite points get no ray.
/// Precondition: the scene has positions only.
///
/// Each distinct scanner position becomes a view, in the order of the points. A moving scanner has
/// a new position for every point. So if there are more than kMostStations, positions are grouped
/// by cubes with a side of 1/50 of the median range. The side doubles until at most kMostStations
/// cubes remain. The view of a cube is its first position, which is certainly in free space. Rays
/// start exactly at their points. Their directions are off by typically a degree if no side was
/// doubled.
///
/// A view is an equirectangular panorama that measures ranges (Camera::measures_range). Its pixels
/// are a quarter of the angular point spacing. That is the median of the spacings at 200 points,
/// which follow from the distance to the 8th nearest point of any station. The solid angle per
/// point would be a worse measure: most beams of a scanner in front of an object hit nothing, and
/// those of a profile scanner lie in a plane. Cost: O(points); the 200 searches run in parallel.
void add_scanner_views(const std::vector<Eigen::Vector3d>& scanners, Scene& scene);

/// The file of a laser scan, and its scanner position.
struct ScanFile {
    std::filesystem::path cloud; ///< PLY
    /// The scanner position of all points, in the coordinates of the file. Empty if the file has
    /// scanner positions.
    std::optional<Eigen::Vector3d> scanner;
};

/// Reads all points of a scan in file order, with views at the scanner positions
/// (add_scanner_views). Points have the attributes of dense points (read_dense_scene); points that
/// are not finite have no ray. Throws InputError with file and position, and Cancelled. Cost: as
/// read_ply_cloud and add_scanner_views.
Scene read_scan_scene(const ScanFile& file, const Progress& progress = {});

/// The size of the scene, from the header of the cloud. Empty if it has no or too many vertices,
/// which read_scan_scene() reports. Throws InputError if the header is broken. Cost: constant.
std::optional<SceneSize> scan_size_before_reading(const ScanFile& file);

} // namespace vcarve
