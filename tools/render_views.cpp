// Renders the views that fixtures/scene is reconstructed from: the still life with a texture of
// solid noise, seen from two rows of cameras. Usage: render_views FOLDER Writes
// FOLDER/images/*.png, FOLDER/truth.ply, FOLDER/cams.txt (name and true centre of each view) and
// FOLDER/camera.txt (COLMAP's PINHOLE parameters).
#include "io/ply.h"
#include "render/picture.h"
#include "render/raster.h"
#include "render/solid_noise.h"
#include "render/still_life.h"

#include <Eigen/Geometry>
#include <fmt/format.h>
#include <fmt/os.h>

#include <cmath>
#include <exception>
#include <filesystem>
#include <numbers>
#include <string>
#include <vector>

namespace {

using namespace vcarve;
using namespace vcarve::render;

constexpr int kWidth_px = 800;
constexpr int kHeight_px = 600;
constexpr double kFocal_px = 760.0;
constexpr int kSamplesASide = 2;
constexpr int kViewsARow = 12;

Pinhole looking_at(const Eigen::Vector3d& center, const Eigen::Vector3d& target)
{
    Pinhole view;
    view.center = center;
    view.focal_px.setConstant(kFocal_px);
    view.principal_px = {kWidth_px / 2.0, kHeight_px / 2.0};
    view.width_px = kWidth_px;
    view.height_px = kHeight_px;
    const Eigen::Vector3d ahead = (target - center).normalized();
    const Eigen::Vector3d right = ahead.cross(Eigen::Vector3d::UnitZ()).normalized();
    view.cam_from_world << right.transpose(), ahead.cross(right).transpose(), ahead.transpose();
    return view;
}

/// Two rows of cameras on arcs before the scene, the upper one half a step aside.
std::vector<Pinhole> cameras()
{
    const Eigen::Vector3d target(0.0, 0.35, 0.4);
    std::vector<Pinhole> result;
    for (int row = 0; row < 2; ++row) {
        for (int i = 0; i < kViewsARow; ++i) {
            const double turn_deg = -72.0 + 12.0 * (i + 0.5 * row);
            const double turn_rad = turn_deg * std::numbers::pi / 180.0;
            const double radius = row == 0 ? 2.9 : 2.6;
            const Eigen::Vector3d center(radius * std::sin(turn_rad),
                                         target.y() - radius * std::cos(turn_rad),
                                         row == 0 ? 0.9 : 1.9);
            result.push_back(looking_at(center, target));
        }
    }
    return result;
}

/// Diffuse light from one side over an even one, so that corners show.
float light(const Eigen::Vector3d& normal)
{
    const Eigen::Vector3d sun = Eigen::Vector3d(-0.4, -0.7, 0.9).normalized();
    return static_cast<float>(0.55 + 0.45 * std::max(0.0, normal.dot(sun)));
}

Picture photograph(const StillLife& scene, const Pinhole& view)
{
    const SolidNoise noise{0.5, 8, 2000};
    const Pinhole fine = enlarged(view, kSamplesASide);
    const std::vector<Hit> hits = rasterize(scene.mesh, fine);
    Picture picture{fine.width_px, fine.height_px, {}};
    picture.pixels.assign(hits.size(), Eigen::Array3f::Constant(128.0F));
    for (std::size_t i = 0; i < hits.size(); ++i) {
        const Hit& hit = hits[i];
        if (hit.face == Hit::kNoFace) continue;
        const Eigen::Vector2d pixel(static_cast<double>(i % fine.width_px) + 0.5,
                                    std::floor(static_cast<double>(i / fine.width_px)) + 0.5);
        const Eigen::Vector3d place = fine.center + hit.depth * fine.ray(pixel);
        const std::uint32_t part = scene.part_of_face[hit.face];
        const Eigen::Vector3d apart = place + 10.0 * part * Eigen::Vector3d::Ones();
        const auto pattern = static_cast<float>(0.15 + 0.85 * noise.at(apart));
        const float brightness = 255.0F * light(face_normal(scene.mesh, hit.face)) * pattern;
        picture.pixels[i] = brightness * scene.tint_of_part[part];
    }
    return shrunk(picture, kSamplesASide);
}

void write_all(const std::filesystem::path& folder)
{
    std::filesystem::create_directories(folder / "images");
    const StillLife scene = still_life();
    write_ply(folder / "truth.ply", scene.mesh, {false, {"the geometry behind fixtures/scene"}});
    auto camera = fmt::output_file((folder / "camera.txt").string());
    camera.print("{},{},{},{}\n", kFocal_px, kFocal_px, kWidth_px / 2, kHeight_px / 2);
    auto places = fmt::output_file((folder / "cams.txt").string());
    const std::vector<Pinhole> views = cameras();
    for (std::size_t i = 0; i < views.size(); ++i) {
        const std::string name = fmt::format("view_{:02}.png", i);
        const Eigen::Vector3d& c = views[i].center;
        places.print("{} {} {} {}\n", name, c.x(), c.y(), c.z());
        write_png(folder / "images" / name, photograph(scene, views[i]));
    }
}

} // namespace

int main(int argc, char** argv)
{
    if (argc != 2) {
        fmt::print(stderr, "usage: render_views FOLDER\n");
        return 2;
    }
    try {
        write_all(argv[1]);
    } catch (const std::exception& error) {
        fmt::print(stderr, "render_views: {}\n", error.what());
        return 1;
    }
    return 0;
}
