// Renders a mesh to a PNG, from the pose of a model's image or from a direction, to look at it.
// Back faces are magenta.
#include "compare/reference.h"
#include "io/colmap/colmap_model.h"
#include "io/colmap/find_model.h"
#include "model/camera.h"
#include "render/picture.h"
#include "render/raster.h"
#include "render/shade.h"
#include "vcarve/error.h"
#include "vcarve/io.h"

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <exception>
#include <string>

namespace vcarve {
namespace {

struct Request {
    std::string mesh;
    std::string out;
    std::string model;
    std::string image; ///< id or name; the first if empty
    std::array<double, 3> from{-1.0, -2.0, 1.5};
    std::array<double, 3> up{0.0, 0.0, 1.0};
    int width_px = 1000;
    bool plain = false;
    bool edges = false;
};

Eigen::Vector3d to_vector(const std::array<double, 3>& values)
{
    return {values[0], values[1], values[2]};
}

const View& find_view(const Scene& scene, const std::string& image)
{
    const auto found = std::find_if(scene.views.begin(), scene.views.end(), [&](const View& view) {
        return image.empty() || view.name == image || std::to_string(view.id) == image;
    });
    if (found == scene.views.end()) {
        throw UsageError(fmt::format("the model has no image with the id or name {}", image));
    }
    return *found;
}

/// Lens distortion and skew are left out.
render::Pinhole pinhole(const Camera& camera)
{
    const auto lens = intrinsics(camera);
    if (!lens) {
        throw UsageError(fmt::format("camera {} has no known focal length", camera.id));
    }
    render::Pinhole view;
    view.focal_px = lens->focal_px;
    view.principal_px = lens->principal_px;
    view.width_px = static_cast<int>(camera.width_px);
    view.height_px = static_cast<int>(camera.height_px);
    return view;
}

render::Pinhole scaled_to(const render::Pinhole& view, int width_px)
{
    const double scale = static_cast<double>(width_px) / view.width_px;
    render::Pinhole result = view;
    result.focal_px *= scale;
    result.principal_px *= scale;
    result.width_px = width_px;
    result.height_px = static_cast<int>(std::lround(view.height_px * scale));
    return result;
}

render::Pinhole view_of_model(const Request& request, const TriMesh& mesh)
{
    const FoundModel found = find_model(request.model);
    const Scene scene = read_colmap_model(found.folder, found.format);
    const View& view = find_view(scene, request.image);
    render::Pinhole result = scaled_to(pinhole(scene.cameras[view.camera]), request.width_px);
    result.cam_from_world = view.cam_from_world.toRotationMatrix();
    result.center = view.center + scene.offset - mesh.offset;
    return result;
}

void declare(CLI::App& app, Request& request)
{
    app.add_option("mesh", request.mesh, "PLY file")->required();
    app.add_option("out", request.out, "PNG file")->required();
    app.add_option("--model", request.model, "render from an image of this COLMAP model");
    app.add_option("--image", request.image, "id or name of the image; the first if not given");
    app.add_option("--from", request.from, "without a model: direction from mesh to camera");
    app.add_option("--up", request.up, "without a model: what is up");
    app.add_option("--width", request.width_px, "width of the picture, px")
        ->check(CLI::Range(16, 8000));
    app.add_flag("--plain", request.plain, "grey instead of the mesh's colours");
    app.add_flag("--edges", request.edges, "draw the edges of the faces");
}

void run(const Request& request)
{
    const TriMesh mesh = in_frame(read_ply(request.mesh), Eigen::Vector3d::Zero());
    const render::Look look{to_vector(request.from), to_vector(request.up)};
    const render::Pinhole view = request.model.empty()
                                     ? render::view_of_whole(mesh, look, request.width_px)
                                     : view_of_model(request, mesh);
    const render::ShadeOptions options{!request.plain, request.edges};
    render::write_png(request.out, render::shade(mesh, view, options));
}

} // namespace
} // namespace vcarve

int main(int argc, char** argv)
{
    vcarve::Request request;
    CLI::App app("Renders a mesh to a PNG. Back faces are magenta.", "render_mesh");
    vcarve::declare(app, request);
    CLI11_PARSE(app, argc, argv);
    try {
        vcarve::run(request);
    } catch (const std::exception& error) {
        fmt::print(stderr, "render_mesh: {}\n", error.what());
        return 1;
    }
    return 0;
}
