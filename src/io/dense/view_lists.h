#pragma once

#include "vcarve/scene.h"

#include <cstdint>
#include <optional>
#include <span>
#include <string>

namespace vcarve {

/// The tracks of points, by lists of the images that saw each, as OpenMVS writes them into its
/// clouds. It counts images as they stood in the file it imported, so `file_order` turns their
/// numbers into views; of `scene` the views and positions are looked at. Nothing, and why in
/// `note`, where the lists are those of another model: they name images that are not there, or in
/// fewer than nine of ten the point does not show. Cost: linear, and looking at some thousand
/// points.
std::optional<Tracks> tracks_of_lists(const Tracks& lists,
                                      std::span<const std::uint32_t> file_order, const Scene& scene,
                                      std::string& note);

} // namespace vcarve
