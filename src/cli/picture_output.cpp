#include "cli/picture_output.h"

#include "base/stage_counts.h"
#include "base/text.h"
#include "io/formats/textured_files.h"
#include "picture/eye.h"
#include "vcarve/error.h"

#include <fmt/format.h>

namespace vcarve::cli {

namespace fs = std::filesystem;

std::vector<Output> texture_outputs(const fs::path& out)
{
    constexpr std::size_t kManyPages = 64;
    std::vector<Output> outputs;
    for (const fs::path& file : files_beside(out, kManyPages)) {
        outputs.push_back({"the texture", file});
    }
    return outputs;
}

void require_texture_name(const fs::path& out)
{
    const std::string end = lower_case_end(out);
    if (end == ".glb" || end == ".obj" || end == ".ply") return;
    throw UsageError(fmt::format("cannot write {} with --texture: the name of a textured mesh must "
                                 "end with .glb, .obj or .ply",
                                 out.string()));
}

OptionList preview_options(PreviewArguments& preview)
{
    constexpr const char* kStage = "Output";
    return {
        {kStage,
         {.name = "preview",
          .help = "Draw a picture of the mesh, OUT.png. It shows the colors (back faces are "
                  "magenta) beside the normals as colors."},
         &preview.out},
        {kStage,
         {.name = "view",
          .help = "Choose the viewpoint of --preview. auto: the camera that sees most. top, "
                  "orbit: a viewpoint outside, above or oblique, that looks through the backs of "
                  "walls. Otherwise the name of an image.",
          .words = {"auto", "top", "orbit"},
          .level = OptionLevel::advanced},
         &preview.view},
    };
}

void check_preview(const PreviewArguments& preview, const ParsedArguments& given)
{
    if (given.has("view") && preview.out.empty()) {
        throw UsageError("--view needs --preview OUT.png");
    }
    if (!preview.out.empty() && lower_case_end(preview.out) != ".png") {
        throw UsageError(fmt::format("cannot write {}: the name of a picture must end with .png",
                                     preview.out.string()));
    }
}

bool needs_view(const PreviewArguments& preview)
{
    return !preview.out.empty() && preview.view != "auto" && preview.view != "top" &&
           preview.view != "orbit";
}

void PreviewOutput::set_scene(const Scene& scene)
{
    if (!arguments_.out.empty()) preview_.emplace(choose_eye(scene, arguments_.view));
}

void PreviewOutput::add(const std::string& name, const TriMesh& mesh, const Texture& texture,
                        Log& log)
{
    if (!preview_) return;
    Stage stage(log, "preview");
    const std::int64_t pixels = preview_->add(name, mesh, texture);
    is_empty_ = false;
    stage.end({{counts::kOutput.pixels, pixels, kNoTotal, name}});
}

void PreviewOutput::write()
{
    if (!preview_) return;
    if (is_empty_) preview_->add("no surface", {});
    write_png(arguments_.out, preview_->picture());
}

Json PreviewOutput::record() const
{
    if (!preview_) return nullptr;
    return {{"file", arguments_.out.string()}, {"view", preview_->eye().name}};
}

} // namespace vcarve::cli
