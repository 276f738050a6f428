#pragma once

#include "base/progress.h"
#include "io/images/calibrated_photo.h"
#include "texture/charts.h"
#include "texture/face_colors.h"
#include "texture/seams.h"
#include "vcarve/tri_mesh.h"

#include <cstdint>
#include <vector>

namespace vcarve {

/// The input of paint_pages().
struct PaintPlan {
    const TriMesh& mesh; ///< vertex colors are for faces without a photograph
    const std::vector<CalibratedPhoto>& photos;
    const std::vector<std::uint32_t>& photo_of_face;
    const Atlas& atlas;
    const Gains& gains;
    const CornerLevels& levels;
    const std::vector<std::vector<Blend>>& blends;
    std::size_t photos_at_a_time; ///< photographs in memory at once
};

/// Paints the pages of an atlas. Each texel is a position on the surface, projected into the
/// photograph through its lens, so neither perspective nor distortion remains. At seams both
/// photographs are blended. The colors of a chart extend over Atlas::kPadding texels around it; the
/// rest of a page has its mean color. Reads each photograph once. Cost: O(texels); 7 bytes each.
std::vector<Photograph> paint_pages(const PaintPlan& plan, const Progress& progress);

} // namespace vcarve
