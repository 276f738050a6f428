#pragma once

#include "io/images/calibrated_photo.h"
#include "texture/choose_photos.h"
#include "vcarve/tri_mesh.h"

#include <Eigen/Core>

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace vcarve {

/// The positions of faces in the pages of an atlas, in texels. (0, 0) is the upper left corner of a
/// page, (0.5, 0.5) the center of its first texel. Connected faces with the same photograph form a
/// chart and are laid out as in the photograph. Faces without a photograph are laid out in small
/// tiles. Charts are padded on all sides.
struct Atlas {
    static constexpr int kPadding = 4; ///< texels around a chart

    std::vector<Eigen::Array2i> page_sizes;
    std::vector<std::uint32_t> page_of_face;
    std::vector<std::array<Eigen::Vector2d, 3>> corners; ///< positions of each face's corners
    std::size_t num_charts = 0;
};

/// Texels per photograph pixel (along a side), and the maximum side of a page. A chart larger than
/// a page is scaled down. Cost: O(faces), and packing the charts by stb_rect_pack.
struct AtlasOptions {
    double scale = 1.0;
    int most_page_px = 4096;
};
Atlas lay_out_charts(const TriMesh& mesh, const std::vector<CalibratedPhoto>& photos,
                     const std::vector<std::uint32_t>& photo_of_face, const FacesBeside& beside,
                     const AtlasOptions& options);

} // namespace vcarve
