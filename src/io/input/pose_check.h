#pragma once

#include "vcarve/scene.h"

#include <filesystem>
#include <string>

namespace vcarve {

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
