#pragma once

#include "base/progress.h"
#include "vcarve/scene.h"

namespace vcarve {

/// Which views likely saw points of a dense cloud that their tracks do not tell of: stereo_fusion
/// lists only views whose own depths agreed with a point's, and where few did, the space before it
/// stays unproven. A point of fewer than five sights gets those views that saw points around it (of
/// the 64 that it stands amid, as spatial_sort() puts them, every fourth is asked), that stand
/// before its normal and that, beside it in the image, saw a point at a like distance and in its
/// own square none that is clearly nearer. Squares are twice as wide as the points that a view saw
/// stand apart in its image. So a wall without points still hides what lies behind it, of which its
/// views saw nothing. A scanner tells of all that it measured, and is asked for no more. Within a
/// row views ascend, and none is of the point's track.
///
/// Cost: O(sights log points) in parallel; 20 bytes a sight.
Tracks inferred_sights(const Scene& scene, const Progress& progress = {});

} // namespace vcarve
