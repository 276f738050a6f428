#pragma once

#include "texture/calibrated_photo.h"
#include "texture/choose_photos.h"
#include "vcarve/tri_mesh.h"

#include <Eigen/Core>

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace vcarve {

/// Where the faces lie in the pages of an atlas, in texels: (0, 0) is the upper left corner of a
/// page, the middle of its first texel (0.5, 0.5). Faces that are covered with the same photograph
/// and hang together are a chart and lie as they do in the photograph; faces that none shows lie in
/// small tiles. Between charts there is room on all sides.
struct Atlas {
    static constexpr int kPadding = 4; ///< texels around a chart

    std::vector<Eigen::Array2i> page_sizes;
    std::vector<std::uint32_t> page_of_face;
    std::vector<std::array<Eigen::Vector2d, 3>> corners; ///< of each face
    std::size_t num_charts = 0;
};

/// Texels a pixel of the photographs, and the longest side of a page. A chart that is larger than a
/// page is made smaller. Cost: O(faces), and the packing of the charts by stb_rect_pack.
struct AtlasOptions {
    double scale = 1.0;
    int most_page_px = 4096;
};
Atlas lay_out_charts(const TriMesh& mesh, const std::vector<CalibratedPhoto>& photos,
                     const std::vector<std::uint32_t>& photo_of_face, const FacesBeside& beside,
                     const AtlasOptions& options);

} // namespace vcarve
