#pragma once

#include "io/ply/ply_entries.h"
#include "io/ply/ply_scanners.h"
#include "vcarve/scene.h"

#include <Eigen/Core>

#include <array>
#include <vector>

namespace vcarve {

/// What is kept of a vertex; all but the position is zero where the file has none.
struct PlyVertex {
    Eigen::Vector3d position = Eigen::Vector3d::Zero();
    Eigen::Vector3d scanner = Eigen::Vector3d::Zero(); ///< where it stood that measured the vertex
    Eigen::Vector3f normal = Eigen::Vector3f::Zero();
    Color color{};
};

/// Where position, normal, colour and scanner stand among the properties of the vertices, of which
/// all others are skipped.
class PlyVertexLayout {
  public:
    explicit PlyVertexLayout(const PlyElement& vertices);

    bool has_positions() const { return has_three_from(Slot::x); }
    bool has_normals() const { return has_three_from(Slot::nx); }
    bool has_colors() const { return has_three_from(Slot::red); }
    bool has_scanners() const { return has_three_from(Slot::scanner_x); }

    /// Reads the next vertex. Throws BadPlyEntry.
    template <typename Body>
    PlyVertex read(PlyEntries<Body>& entries) const
    {
        Values values{};
        for (const Property& property : properties_) {
            if (property.in_file.length_type) {
                entries.skip(property.in_file);
            } else {
                values[static_cast<std::size_t>(property.slot)] =
                    entries.number(property.in_file.type);
            }
        }
        return vertex_of(values);
    }

  private:
    /// Where a value of the file goes to.
    enum class Slot {
        x,
        y,
        z,
        nx,
        ny,
        nz,
        red,
        green,
        blue,
        scanner_x,
        scanner_y,
        scanner_z,
        none
    };
    struct Property {
        PlyProperty in_file;
        Slot slot = Slot::none;
    };
    using Values = std::array<double, 13>; ///< by slot; the last takes what is not kept

    static Slot slot_of(const PlyProperty& property, const PlyNames& scanner);
    bool has_three_from(Slot first) const;
    PlyVertex vertex_of(const Values& values) const;

    std::vector<Property> properties_;
    std::array<PlyType, 3> channel_types_{};
};

} // namespace vcarve
