#pragma once

#include "base/progress.h"
#include "texture/calibrated_photo.h"
#include "texture/charts.h"
#include "texture/face_colors.h"
#include "texture/seams.h"
#include "vcarve/tri_mesh.h"

#include <cstdint>
#include <vector>

namespace vcarve {

/// What is needed to paint the pages.
struct PaintPlan {
    const TriMesh& mesh; ///< with a colour a vertex: faces that no photograph shows are painted so
    const std::vector<CalibratedPhoto>& photos;
    const std::vector<std::uint32_t>& photo_of_face;
    const Atlas& atlas;
    const Gains& gains;
    const CornerLevels& levels;
    const std::vector<std::vector<Blend>>& blends;
    std::size_t photos_at_a_time; ///< in memory
};

/// The pages of an atlas. Each texel is a place of the surface, which the photograph is asked for
/// through its lens, so that neither perspective nor distortion is left; at seams both photographs
/// are asked. The colours of a chart go on over some texels around it, the rest of a page has its
/// mean colour. Reads each photograph once. Cost: O(texels); 7 bytes each.
std::vector<Photograph> paint_pages(const PaintPlan& plan, const Progress& progress);

} // namespace vcarve
