#include "cli/mesh_output.h"

#include "base/progress.h"
#include "base/stage_counts.h"
#include "base/text.h"
#include "io/colmap/sim3_text.h"
#include "io/formats/mesh_file.h"
#include "model/views.h"
#include "run/job.h"
#include "steps/6_surface/provenance.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <utility>

namespace vcarve::cli {

OutputFrame frame_of(const Scene& model, const MeshArguments& arguments, Log& log)
{
    const OutputOptions& output = arguments.output;
    OutputFrame frame = {arguments.transform, {}, up_for(model, output.up, arguments.transform)};
    const bool is_used = output.upright || lower_case_end(arguments.out) == ".glb";
    if (is_used && output.up.word == static_cast<int>(UpWord::automatic) &&
        look_in_one_direction(model)) {
        const Eigen::Vector3d shown = (frame.up * 100.0).array().round() / 100.0 + 0.0; // no -0.00
        log.note(fmt::format("all cameras look one way, so the top of their images is used as up, "
                             "direction {:.2f}; if they look straight down, use --up back",
                             fmt::join(shown, ", ")));
    }
    if (output.upright) {
        frame.transform = turned_upright(frame.transform, frame.up);
        frame.up = Eigen::Vector3d::UnitZ();
    }
    frame.offset = offset_for(model, output.offset, frame.transform);
    return frame;
}

std::vector<std::string> comments_of(const Digest& scene, const MeshArguments& arguments,
                                     const OutputFrame& frame, std::size_t tile_points)
{
    std::vector<std::string> comments = comments_of(scene, arguments.options);
    OutputOptions usual;
    OutputOptions given = arguments.output;
    if (frame.offset.isZero(0.0)) given.offset = {}; // has no effect
    given.quiet = given.verbose = false;
    const auto changed = changed_options(options_of(given), options_of(usual));
    comments.insert(comments.end(), changed.begin(), changed.end());
    if (tile_points > 0) comments.push_back(fmt::format("option tile-points={}", tile_points));
    return comments;
}

void write_surface(const MeshArguments& arguments, const Reconstruction& made,
                   const OutputFrame& frame, Log& log)
{
    MeshFormat format = {.ascii = arguments.output.ascii,
                         .comments = made.comments,
                         .texture = made.texture.is_empty() ? nullptr : &made.texture,
                         .offset = frame.offset,
                         .up = frame.up};
    std::optional<Provenance> provenance;
    if (arguments.output.attributes) {
        provenance = find_provenance(made.mesh, made.scene);
        format.provenance = &*provenance;
    }
    std::optional<TriMesh> moved;
    if (frame.transform) {
        moved = transformed(made.mesh, *frame.transform);
        format.comments.push_back("transform " + sim3_text(*frame.transform));
        log.note(
            fmt::format("output coordinates are those of the model{}{}",
                        arguments.transform ? " transformed by " + arguments.output.transform : "",
                        arguments.output.upright ? ", rotated so that z is up" : ""));
    }
    const TriMesh& mesh = moved ? *moved : made.mesh;
    if (!frame.offset.isZero(0.0)) {
        log.note(fmt::format("output coordinates are those of the model{} minus {}",
                             moved ? ", transformed," : "", fmt::join(frame.offset, ", ")));
    }
    Stage stage(log, "write");
    write_mesh(arguments.out, mesh, format);
    const double share = rounding_share(arguments.out, mesh, format);
    constexpr double kSeen = 1e-6;
    if (share > kSeen) {
        log.note(
            fmt::format("32-bit floats in {} move vertices by up to {:.1e} of the mesh's size; "
                        "use --offset auto",
                        arguments.out.string(), share));
    }
    stage.end({{counts::kOutput.faces, size_of(mesh.faces.size())},
               {counts::kOutput.vertices, size_of(mesh.positions.size())}});
}

} // namespace vcarve::cli
