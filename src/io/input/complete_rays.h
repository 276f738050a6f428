#pragma once

#include "base/progress.h"
#include "io/colmap/colmap_model.h"
#include "io/input/find_input.h"
#include "vcarve/scene.h"

#include <filesystem>
#include <string>
#include <vector>

namespace vcarve {

/// Whether complete_rays() changes rays: if the user demands the nearest views, or most points have
/// fewer than two rays. Cost: O(points).
bool lacks_rays(const FoundInput& found, const Scene& scene);

/// Completes the rays of a model if most points have fewer than two, as with SLAM, networks without
/// matches, and many converters. The 2D points of the images supply them, as in COLMAP's mesher. If
/// most points still have fewer than two, these points also get the nearest views (see
/// nearest_rays), and `found.rays` becomes nearest. RaysFrom::nearest replaces all rays by the
/// nearest views; RaysFrom::file changes nothing. Returns notes for the user, also about the rays
/// that were `dropped`. Cost: reading images, and nearest_rays.
std::vector<std::string> complete_rays(FoundInput& found, const DroppedRays& dropped, Scene& scene,
                                       const Progress& progress = {});

/// Recognizes placeholders for unknown values. If all errors are zero, they become -1. Colors
/// count as missing if all are black (see has_colors). Returns notes for the user. Cost: O(points).
std::vector<std::string> forget_unknown_values(Scene& scene);

/// Returns a warning if points do not project into the images of their rays. If the inverse poses
/// fit, the poses seem to be camera-to-world, a common error of scripts. Otherwise points and poses
/// do not match. Returns an empty string if at most a quarter of the rays is wrong. Rays
/// of unknown lenses are not tested. If there are no rays, tests all images for each point.
/// `images` is the file that the warning mentions. Cost: tests all rays of about 1000 points.
std::string warning_of_poses(const Scene& scene, const std::filesystem::path& images);

/// Returns a warning if more than half of the points of a cloud project into no image, for example
/// if the cloud was scaled or centered. Otherwise returns an empty string. The warning mentions the
/// paths. Cost: tests about 1000 points in every view.
std::string warning_of_frames(const Scene& scene, const std::filesystem::path& cloud,
                              const std::filesystem::path& images);

} // namespace vcarve
