#pragma once

#include "base/progress.h"
#include "io/images/calibrated_photo.h"
#include "vcarve/scene.h"
#include "vcarve/tri_mesh.h"

#include <cstdint>
#include <span>
#include <vector>

namespace vcarve {

struct RefinedCounts {
    std::int64_t vertices = 0; ///< after dividing faces
    std::int64_t measured = 0; ///< vertices where the photographs can be trusted
    double pixel = 0.0;        ///< scene units per pixel of disparity, at the median vertex
};

/// Predicts the memory of the photographs in bytes, without the mesh.
double refine_bytes(std::span<const PhotographSize> photos, int size_px, double threads);

/// Refines a mesh by photo-consistency: divides its faces until they are about as fine as the
/// photographs, and moves the vertices to where neighboring photographs agree best (after H.-H. Vu,
/// P. Labatut, J.-P. Pons and R. Keriven, "High accuracy and visibility-consistent dense multiview
/// stereo", PAMI 2012). First with photographs of half the size, then with at most `size_px` pixels
/// along the longest side. Places without texture, and those where halves of the photographs
/// disagree, only become smoother. `photos` are in the frame of the mesh, `scene` is their model.
/// The result is the same for any thread count. Throws Cancelled. Cost: about 40 us per vertex of
/// the result; 100 bytes per vertex, 20 bytes per pixel of some ten photographs.
RefinedCounts refine_mesh(TriMesh& mesh, const Scene& scene,
                          const std::vector<CalibratedPhoto>& photos, int size_px,
                          const Progress& progress);

} // namespace vcarve
