// Draws the normals of surfaces side by side, from a camera of a model. Usage: picture_surfaces
// OUT.png WIDTH_PX MODEL VIEW MESH... VIEW is the name of an image, or auto for the camera that
// sees most. A panel is about WIDTH_PX wide; it is drawn at twice this size and reduced.
#include "picture/eye.h"
#include "picture/picture.h"
#include "picture/shade.h"
#include "run_program.h"
#include "vcarve/io.h"

#include <fmt/format.h>

#include <filesystem>
#include <span>
#include <string>
#include <vector>

namespace vcarve {

namespace {

Picture side_by_side(const std::vector<Picture>& panels)
{
    constexpr int kGapPx = 6;
    const int step_px = panels.front().width_px + kGapPx;
    const int count = static_cast<int>(panels.size());
    Picture all = even_picture(count * step_px - kGapPx, panels.front().height_px,
                               Eigen::Array3f::Constant(255.0F));
    for (int i = 0; i < count; ++i) {
        paste(panels[static_cast<std::size_t>(i)], i * step_px, 0, all);
    }
    return all;
}

void draw(std::span<char*> words)
{
    const std::filesystem::path out = words[0];
    const double width_px = 2.0 * std::stod(words[1]);
    Log silent;
    const Eye eye = choose_eye(read_model(words[2], silent), words[3]);
    const double height_px = width_px * static_cast<double>(eye.camera.height_px) /
                             static_cast<double>(eye.camera.width_px);
    std::vector<Picture> panels;
    for (const char* mesh : words.subspan(4)) {
        panels.push_back(shrunk(look_at(read_ply(mesh), {}, eye, width_px * height_px).normals, 2));
    }
    write_png(out, side_by_side(panels));
}

} // namespace

} // namespace vcarve

int main(int argc, char** argv)
{
    return vcarve::run_program(std::span(argv, static_cast<std::size_t>(argc)),
                               "picture_surfaces OUT.png WIDTH_PX MODEL VIEW MESH...", 5, 1000,
                               [](std::span<char*> words) { vcarve::draw(words); });
}
