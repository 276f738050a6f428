#include "io/formats/output_frame.h"

#include "base/text.h"
#include "io/colmap/sim3_text.h"
#include "io/colmap/transforms_json.h"
#include "model/views.h"
#include "vcarve/error.h"
#include "vcarve/io.h"

#include <fmt/format.h>

#include <charconv>
#include <cmath>
#include <system_error>
#include <utility>

namespace vcarve {

std::optional<Similarity> transform_of(const std::string& text, const FoundModel& model)
{
    if (text.empty()) return std::nullopt;
    double scale = 0.0;
    const char* const end = text.data() + text.size();
    const auto [stop, error] = std::from_chars(text.data(), end, scale);
    if (lower_case_end(text) == ".json") {
        const bool has_poses = model.format == ModelFormat::transforms;
        return read_nerfstudio_transform(text, has_poses ? model.folder : std::filesystem::path());
    }
    if (error == std::errc::invalid_argument || stop != end) return read_sim3(text);
    if (error != std::errc() || !(scale > 0.0) || !std::isfinite(scale)) {
        throw UsageError(
            fmt::format("--transform takes a file or a scale above 0, not \"{}\"", text));
    }
    return Similarity{.scale = scale, .linear = scale * Eigen::Matrix3d::Identity()};
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
