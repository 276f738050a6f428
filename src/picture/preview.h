#pragma once

#include "model/photograph.h"
#include "picture/eye.h"
#include "picture/picture.h"
#include "vcarve/tri_mesh.h"

#include <cstdint>
#include <string>
#include <vector>

namespace vcarve {

/// Pixels of one view of a mesh, at most.
inline constexpr double kPanelPixels = 1280.0 * 960.0;

/// A picture of meshes from one place: a row each, with the mesh in its colours or texture on the
/// left, its normals on the right, and a line above that names it. About 30 MB a row.
class Preview {
  public:
    explicit Preview(Eye eye, double panel_pixels = kPanelPixels);

    /// Adds a row, and tells how many pixels a view of it has. Cost: as look_at().
    std::int64_t add(const std::string& name, const TriMesh& mesh, const Texture& texture = {});

    /// All rows, one below the other.
    Picture picture() const;

    const Eye& eye() const { return eye_; }

  private:
    Eye eye_;
    double panel_pixels_;
    std::vector<Picture> rows_;
};

} // namespace vcarve
