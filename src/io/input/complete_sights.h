#pragma once

#include "base/progress.h"
#include "io/colmap/colmap_model.h"
#include "io/input/find_input.h"
#include "vcarve/scene.h"

#include <filesystem>
#include <string>
#include <vector>

namespace vcarve {

/// Sees to the sights of a model's points, where most of them have fewer than two, as those of
/// SLAM, of networks that need no matches, and of many converters have: takes them from the 2D
/// points of the images, as COLMAP's own mesher does, and where that leaves most points with fewer
/// than two, adds to these points the nearest views (see nearest_sights). With SightsFrom::nearest
/// all points have only those, with SightsFrom::file none. Sets `found.sights` to nearest if
/// nearest views were added. Returns what the user should know, in sentences; of the sights that
/// were `dropped`, too. Cost: that of reading images, and nearest_sights.
std::vector<std::string> complete_sights(FoundInput& found, const DroppedSights& dropped,
                                         Scene& scene, const Progress& progress = {});

/// Takes for unknown what exporters write where they know nothing: errors that are zero at every
/// point, which become -1, and colours that are all black (see has_colors). Returns what the user
/// should know, in sentences. Cost: O(points).
std::vector<std::string> forget_unknown_values(Scene& scene);

/// A warning where the images do not show the points that they are said to have seen: that the
/// poses look like camera-to-world, where these do if they are turned round, as programs of one's
/// own often write them; else that points and poses do not belong together. Empty where a quarter
/// of the sights at most is amiss, and where that cannot be told, as of lenses that are not known.
/// Where there are no sights, each image is asked for each point. `images` is the file to look at.
/// Cost: a look at every sight of a thousand points.
std::string warning_of_poses(const Scene& scene, const std::filesystem::path& images);

/// A warning where more than half of the points of a cloud show in no image, as where these were
/// scaled or moved to the middle; empty else. The paths are for the words. Cost: a look at a
/// thousand points through every view.
std::string warning_of_frames(const Scene& scene, const std::filesystem::path& cloud,
                              const std::filesystem::path& images);

} // namespace vcarve
