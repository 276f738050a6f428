#pragma once

#include "base/progress.h"
#include "model/photograph.h"
#include "texture/calibrated_photo.h"
#include "vcarve/log.h"
#include "vcarve/tri_mesh.h"

#include <cstddef>
#include <vector>

namespace vcarve {

/// How a surface looks beside photographs that played no part in its colours.
struct PhotoLikeness {
    double psnr_db = 0.0;   ///< of all channels of all pixels that show the surface's front
    double structure = 0.0; ///< mean structural similarity of squares of 8 x 8 pixels
    double covered = 0.0;   ///< share of the photographs' pixels that show the surface's front
    std::size_t photos = 0; ///< that were left out
};

/// Compares a surface, in its texture or its colours, with photographs, each at most a million
/// pixels large: a photograph that is larger is asked for the mean of the pixels around. The
/// structural similarity is that of Z. Wang, A. Bovik, H. Sheikh and E. Simoncelli, "Image quality
/// assessment: from error visibility to structural similarity", IEEE TIP 2004, of grey levels.
PhotoLikeness compare_with_photos(const TriMesh& mesh, const Texture& texture,
                                  const std::vector<CalibratedPhoto>& photos,
                                  const Progress& progress);

/// Which photographs are left out, and which are not: every fourth.
struct SplitPhotos {
    std::vector<CalibratedPhoto> kept;
    std::vector<CalibratedPhoto> left_out;
};
SplitPhotos split_photos(const std::vector<CalibratedPhoto>& photos);

} // namespace vcarve
