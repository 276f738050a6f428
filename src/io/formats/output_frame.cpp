#include "io/formats/output_frame.h"

#include "model/views.h"
#include "vcarve/error.h"
#include "vcarve/io.h"

#include <utility>

namespace vcarve {

Option up_option(WordOrVector& up)
{
    return {
        "Output",
        {.name = "up",
         .help =
             "Set the up direction of .glb, which becomes y, and record it in the file. auto: up "
             "in most cameras. back: opposite to the cameras' view, for cameras that look "
             "straight down. z, or x,y,z: a direction in output coordinates. none: keep y.",
         .min = -kUnlimited,
         .words = {"auto", "back", "z", "none"},
         .level = OptionLevel::advanced},
        &up};
}

Eigen::Vector3d offset_for(const Scene& model, const WordOrVector& wanted,
                           const std::optional<Similarity>& transform)
{
    if (wanted.word == WordOrVector::kNoWord) return wanted.vector;
    const bool automatic = static_cast<OffsetWord>(wanted.word) == OffsetWord::automatic;
    if (!automatic) return Eigen::Vector3d::Zero();
    if (!transform) return round_offset(model);
    Scene moved;
    moved.positions = model.positions;
    moved.offset = model.offset;
    move_positions(*transform, moved.positions, moved.offset);
    return round_offset(moved);
}

Eigen::Vector3d up_for(const Scene& model, const WordOrVector& wanted,
                       const std::optional<Similarity>& transform)
{
    if (wanted.word == WordOrVector::kNoWord) {
        if (wanted.vector.stableNormalized().isZero())
            throw UsageError("--up takes a direction, not 0,0,0");
        return wanted.vector.stableNormalized();
    }
    const auto word = static_cast<UpWord>(wanted.word);
    if (word == UpWord::none) return Eigen::Vector3d::Zero();
    if (word == UpWord::z) return Eigen::Vector3d::UnitZ();
    const Eigen::Vector3d up =
        word == UpWord::back ? back_of(model).value_or(up_of(model)) : up_of(model);
    return transform ? (transform->linear * up).normalized() : up;
}

Similarity turned_upright(const std::optional<Similarity>& transform, const Eigen::Vector3d& up)
{
    Similarity turned = transform.value_or(Similarity());
    const auto turn = Eigen::Quaterniond::FromTwoVectors(up, Eigen::Vector3d::UnitZ());
    turned.linear = turn * turned.linear;
    turned.translation = turn * turned.translation;
    return turned;
}

TriMesh transformed(TriMesh mesh, const Similarity& to)
{
    move_positions(to, mesh.positions, mesh.offset);
    const Eigen::Matrix3d rotation = to.linear / to.scale;
    for (Eigen::Vector3f& normal : mesh.normals) {
        normal = (rotation * normal.cast<double>()).stableNormalized().cast<float>();
    }
    return mesh;
}

} // namespace vcarve
