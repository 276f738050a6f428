#pragma once

#include "io/ply/ply_data.h"
#include "vcarve/scene.h"

#include <Eigen/Core>

#include <array>
#include <cstdint>
#include <string_view>
#include <vector>

namespace vcarve {

/// The properties of a Gaussian (3D Gaussian splatting) in addition to its center.
struct Splat {
    float opacity_logit = 0.0F; ///< the opacity is its sigmoid
    float log_axis = 0.0F;      ///< natural logarithm of the largest half-axis
};

/// The values of a vertex. Missing values are zero, except that log_axis is -infinity.
struct PlyVertex {
    Eigen::Vector3d position = Eigen::Vector3d::Zero();
    Eigen::Vector3d scanner = Eigen::Vector3d::Zero(); ///< position of its scanner
    Eigen::Vector3f normal = Eigen::Vector3f::Zero();
    Color color{};
    Splat splat{};
};

/// Maps the vertex properties of a file to position, normal, color, scanner and Gaussian. Other
/// properties are skipped. Gaussians without a color use the constant term of their spherical
/// harmonics.
class PlyVertexLayout {
  public:
    explicit PlyVertexLayout(const PlyElement& vertices);

    bool has_positions() const { return has_three_from(kPosition); }
    bool has_normals() const { return has_three_from(kNormal); }
    bool has_colors() const { return has_three_from(kColor); }
    bool are_splats() const { return are_splats_; }
    /// Whether vertices have OpenMVS's list of the images that saw them.
    bool has_images() const;

    /// Reads the next vertex. Appends the images of its list to `images` unless null. Throws
    /// BadPlyEntry.
    PlyVertex read(PlyData& data, std::vector<std::uint32_t>* images = nullptr) const;

  private:
    /// Slots of values in read(), the first of three for vectors. kNowhere is for skipped values.
    static constexpr std::size_t kPosition = 0;
    static constexpr std::size_t kNormal = 3;
    static constexpr std::size_t kColor = 6;
    static constexpr std::size_t kScanner = 9;
    static constexpr std::size_t kOpacity = 12;
    static constexpr std::size_t kAxes = 13;
    static constexpr std::size_t kNowhere = 16;
    struct Property {
        PlyProperty in_file;
        std::size_t slot;
    };

    bool has_three_from(std::size_t first) const;

    std::vector<Property> properties_;
    std::array<PlyType, 3> channel_types_{};
    bool are_splats_ = false;
    bool colors_are_harmonics_ = false;
};

/// The property names of three coordinates.
using PlyNames = std::array<std::string_view, 3>;

/// The element that PCL writes after the vertices, and the properties of the sensor position.
inline constexpr std::string_view kPlyCamera = "camera";
inline constexpr PlyNames kPlyCameraPlace = {"view_px", "view_py", "view_pz"};

/// The points for which a file has scanner positions.
enum class PlyScanners { none, one_for_all, each };

/// Detects scanner positions of the vertices, or otherwise a camera for all vertices. Incomplete
/// coordinates count, too; reading them throws.
PlyScanners scanners_in(const PlyHeader& header);

/// The names of the scanner coordinates: x_origin, y_origin and z_origin, or scanner_x, scanner_y
/// and scanner_z. Returns the names of which the element has most, the first ones if equal.
const PlyNames& names_of_scanner(const PlyElement& vertices);

/// The number of names that are scalar properties of an element.
int count_names(const PlyElement& element, const PlyNames& names);

} // namespace vcarve
