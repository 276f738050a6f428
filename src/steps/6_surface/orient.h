#pragma once

#include "vcarve/scene.h"

#include <cstdint>

namespace vcarve {

class HalfEdgeMesh;

/// How well a surface faces the views that saw it (Akgunduz, Zetu, Banerjee 2000, section 4.5).
struct ViewAgreement {
    std::int64_t sights = 0; ///< pairs of a face corner and a view that saw its point
    std::int64_t facing = 0; ///< those where the face's normal is within 90 degrees of the view
};

/// Counts, without changing anything: orientation comes from the labels and is right by
/// construction; this checks it. Corners without a point do not count. Cost: O(faces x track
/// length), in parallel.
ViewAgreement view_agreement(const HalfEdgeMesh& mesh, const Scene& scene);

} // namespace vcarve
