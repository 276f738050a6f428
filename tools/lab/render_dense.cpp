// Simulates the dense workspace of a scene with known geometry. Usage: render_dense FOLDER SCENE
// [SIZE]. SIZE scales the sides of the images, by default 1. render_views --list prints the names
// of scenes. Writes FOLDER/fused.ply, FOLDER/fused.ply.vis, FOLDER/sparse and the truth,
// FOLDER/gt.ply.
#include "dense/stereo.h"
#include "observed/write_model.h"
#include "run_program.h"
#include "vcarve/io.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <string>

namespace vcarve::dense {

namespace {

render::Pinhole scaled(const render::Pinhole& view, double size)
{
    render::Pinhole result = view;
    result.width_px = static_cast<int>(std::lround(size * view.width_px));
    result.height_px = static_cast<int>(std::lround(size * view.height_px));
    result.focal_px *= size;
    result.principal_px *= size;
    return result;
}

/// Whether a view shows enough. Views inside of objects or close to them would not be matched.
bool shows_much(const DepthMap& map)
{
    constexpr double kLeastShare = 0.1;
    const auto without = static_cast<double>(std::ranges::count(map.depths, 0.0));
    return without < (1.0 - kLeastShare) * static_cast<double>(map.depths.size());
}

/// Transforms the views and the cloud to the frame of the truth.
Scene in_frame(const render::PhotoScene& scene, const FusedCloud& cloud)
{
    const render::Pinhole& lens = scene.views.front();
    const auto size_px = [](int size) { return static_cast<std::uint64_t>(size); };
    Scene result;
    result.cameras = {{.id = 1,
                       .model = 1,
                       .width_px = size_px(lens.width_px),
                       .height_px = size_px(lens.height_px),
                       .params = {lens.focal_px.x(), lens.focal_px.y(), lens.principal_px.x(),
                                  lens.principal_px.y()}}};
    for (const render::Pinhole& view : scene.views) {
        const auto id = static_cast<std::uint32_t>(result.views.size() + 1);
        result.views.push_back(
            {.id = id,
             .name = fmt::format("view_{:03}.png", id),
             .cam_from_world = Eigen::Quaterniond(view.cam_from_world) * scene.frame.turn.inverse(),
             .center = scene.frame(view.center)});
    }
    for (std::size_t i = 0; i < cloud.positions.size(); ++i) {
        result.positions.push_back(scene.frame(cloud.positions[i]));
        result.normals.emplace_back((scene.frame.turn * cloud.normals[i]).cast<float>());
        result.tracks.push_back(cloud.views[i]);
    }
    result.colors = cloud.colors;
    return result;
}

void write_all(const std::filesystem::path& folder, const std::string& name, double size)
{
    constexpr std::uint64_t kSeed = 11;
    render::PhotoScene scene = render::photo_scene(name);
    for (render::Pinhole& view : scene.views) {
        view = scaled(view, size);
    }
    std::vector<render::Pinhole> views;
    std::vector<DepthMap> maps;
    for (std::size_t view = 0; view < scene.views.size(); ++view) {
        DepthMap map = stereo_depths(scene, view, {}, kSeed);
        if (!shows_much(map)) continue;
        views.push_back(scene.views[view]);
        maps.push_back(std::move(map));
    }
    scene.views = views;
    const FusedCloud cloud = fuse(scene.views, std::move(maps), {});
    observed::write_workspace(folder, in_frame(scene, cloud), 0.0);
    TriMesh truth = scene.parts.mesh;
    for (Eigen::Vector3d& position : truth.positions) {
        position = scene.frame(position);
    }
    write_ply(folder / "gt.ply", truth, {.comments = {"the geometry behind " + name}});
    fmt::print("{}: {} points from {} views\n", name, cloud.positions.size(), scene.views.size());
}

} // namespace

} // namespace vcarve::dense

int main(int argc, char** argv)
{
    return vcarve::run_program(
        std::span(argv, static_cast<std::size_t>(argc)), "render_dense FOLDER SCENE [SIZE]", 2, 3,
        [](std::span<char*> words) {
            vcarve::dense::write_all(words[0], words[1],
                                     words.size() == 3 ? std::stod(words[2]) : 1.0);
        });
}
