// Renders the views of a scene, with a texture of solid noise. Usage: render_views FOLDER [SCENE],
// by default the still life of fixtures/scene. render_views --list prints the names of scenes.
// Writes FOLDER/images/*.png, FOLDER/truth.ply, FOLDER/cams.txt (name and true center of each
// view), FOLDER/camera.txt (COLMAP's PINHOLE parameters), FOLDER/features.txt (maximum number of
// features per view), FOLDER/pairs.txt (names of two views with similar directions and near
// centers per line) and FOLDER/max_error.txt (the maximum error of a reconstructed center, in the
// truth's units).
#include "picture/picture.h"
#include "render/photo_scene.h"
#include "render/photograph.h"
#include "run_program.h"
#include "vcarve/io.h"

#include <fmt/format.h>
#include <fmt/os.h>

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace vcarve::render {

namespace {

/// In the frame of the scenes, where views are at a distance of some meters.
constexpr double kMaxError = 0.02;
/// Cosine of 50 degrees; beyond this angle SIFT finds almost no matches.
constexpr double kLeastPairCosine = 0.64;

std::string name_of(std::size_t view)
{
    return fmt::format("view_{:02}.png", view);
}

void write_truth(const std::filesystem::path& folder, const PhotoScene& scene,
                 const std::string& comment)
{
    TriMesh mesh = scene.parts.mesh;
    for (Eigen::Vector3d& position : mesh.positions) {
        position = scene.frame(position);
    }
    write_ply(folder / "truth.ply", mesh, {false, {comment}});
    auto places = fmt::output_file((folder / "cams.txt").string());
    for (std::size_t i = 0; i < scene.views.size(); ++i) {
        const Eigen::Vector3d c = scene.frame(scene.views[i].center);
        places.print("{} {} {} {}\n", name_of(i), c.x(), c.y(), c.z());
    }
}

/// Writes the settings for COLMAP.
void write_settings(const std::filesystem::path& folder, const PhotoScene& scene)
{
    const Pinhole& view = scene.views.front();
    auto camera = fmt::output_file((folder / "camera.txt").string());
    camera.print("{},{},{},{}\n", view.focal_px.x(), view.focal_px.y(), view.principal_px.x(),
                 view.principal_px.y());
    auto features = fmt::output_file((folder / "features.txt").string());
    features.print("{}\n", scene.features);
    auto max_error = fmt::output_file((folder / "max_error.txt").string());
    max_error.print("{}\n", scene.frame.scale * kMaxError);
}

void write_pairs(const std::filesystem::path& path, const PhotoScene& scene)
{
    const std::vector<Pinhole>& views = scene.views;
    auto file = fmt::output_file(path.string());
    for (std::size_t i = 0; i < views.size(); ++i) {
        for (std::size_t k = i + 1; k < views.size(); ++k) {
            const double cosine =
                views[i].cam_from_world.row(2).dot(views[k].cam_from_world.row(2));
            const double distance = (views[i].center - views[k].center).norm();
            if (cosine < kLeastPairCosine || distance > scene.pair_reach) continue;
            file.print("{} {}\n", name_of(i), name_of(k));
        }
    }
}

void write_all(const std::filesystem::path& folder, const std::string& name)
{
    const PhotoScene scene = photo_scene(name);
    std::filesystem::create_directories(folder / "images");
    const bool is_fixture = name == photo_scene_names().front();
    write_truth(folder, scene,
                fmt::format("the geometry behind {}", is_fixture ? "fixtures/scene" : name));
    write_settings(folder, scene);
    write_pairs(folder / "pairs.txt", scene);
    for (std::size_t i = 0; i < scene.views.size(); ++i) {
        const Picture picture = photograph(scene.parts, scene.views[i]);
        write_png(folder / "images" / name_of(i),
                  grainy(picture, scene.grain, static_cast<std::uint32_t>(i)));
    }
}

} // namespace

} // namespace vcarve::render

int main(int argc, char** argv)
{
    return vcarve::run_program(
        std::span(argv, static_cast<std::size_t>(argc)),
        "render_views FOLDER [SCENE] | render_views --list", 1, 2, [](std::span<char*> words) {
            const std::vector<std::string> names = vcarve::render::photo_scene_names();
            if (std::string_view(words[0]) == "--list") {
                fmt::print("{}\n", fmt::join(names, "\n"));
            } else {
                vcarve::render::write_all(words[0], words.size() == 2 ? words[1] : names.front());
            }
        });
}
