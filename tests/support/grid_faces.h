#pragma once

#include "vcarve/tri_mesh.h"

#include <cstdint>
#include <vector>

namespace vcarve::testing {

/// The faces of a grid of side x side vertices, two per square, counterclockwise from above. The
/// vertex at (x, y) has the index x * side + y.
inline std::vector<Face> grid_faces(std::uint32_t side)
{
    std::vector<Face> faces;
    for (std::uint32_t x = 0; x + 1 < side; ++x) {
        for (std::uint32_t y = 0; y + 1 < side; ++y) {
            const std::uint32_t a = side * x + y;
            const std::uint32_t b = a + side;
            faces.push_back({a, b, b + 1});
            faces.push_back({a, b + 1, a + 1});
        }
    }
    return faces;
}

} // namespace vcarve::testing
