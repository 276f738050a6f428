#pragma once

#include "model/photograph.h"
#include "picture/eye.h"
#include "picture/picture.h"
#include "vcarve/tri_mesh.h"

#include <cstdint>
#include <string>
#include <vector>

namespace vcarve {

/// The maximum number of pixels of one panel.
inline constexpr double kPanelPixels = 1280.0 * 960.0;

/// Draws meshes from one viewpoint, one row per mesh: a caption, the mesh in its colors or texture
/// on the left, its normals on the right. Cost: about 30 MB per row.
class Preview {
  public:
    explicit Preview(Eye eye, double panel_pixels = kPanelPixels);

    /// Adds a row. Returns the number of pixels of one panel. Cost: see look_at().
    std::int64_t add(const std::string& name, const TriMesh& mesh, const Texture& texture = {});

    /// Returns all rows, from top to bottom.
    Picture picture() const;

    const Eye& eye() const { return eye_; }

  private:
    Eye eye_;
    double panel_pixels_;
    std::vector<Picture> rows_;
};

} // namespace vcarve
