#pragma once

#include "model/photograph.h"

#include <Eigen/Core>

#include <array>
#include <cstdint>
#include <vector>

namespace vcarve {

/// The images that cover a surface, and which part of them covers which face.
struct Texture {
    std::vector<Photograph> pages;
    std::vector<std::uint32_t> page_of_face; ///< parallel to the faces of the mesh
    /// Of each face where its corners lie in its page: (0, 0) is the page's upper left corner,
    /// (1, 1) its lower right one.
    std::vector<std::array<Eigen::Vector2f, 3>> places;

    bool is_empty() const { return pages.empty(); }
};

} // namespace vcarve
