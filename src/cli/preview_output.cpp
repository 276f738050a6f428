#include "cli/preview_output.h"

#include "base/text.h"
#include "picture/eye.h"
#include "vcarve/error.h"

#include <fmt/format.h>

namespace vcarve::cli {

OptionList preview_options(PreviewArguments& preview)
{
    constexpr const char* kStage = "Output";
    return {
        {kStage,
         {.name = "preview",
          .help = "Also draw the surface, as PNG: in its colours, backs of faces in magenta, "
                  "beside its normals as colours."},
         &preview.out},
        {kStage,
         {.name = "view",
          .help = "From where --preview looks. auto: through the camera that sees most. top, "
                  "orbit: from outside, above or obliquely, through the backs of walls. Else the "
                  "image of that name.",
          .words = {"auto", "top", "orbit"}},
         &preview.view},
    };
}

void check_preview(const PreviewArguments& preview, const ParsedArguments& given)
{
    if (given.has("view") && preview.out.empty()) {
        throw UsageError("--view says from where --preview looks, but there is no --preview");
    }
    if (!preview.out.empty() && lower_case_end(preview.out) != ".png") {
        throw UsageError(fmt::format("cannot write {}: the name of a picture must end with .png",
                                     preview.out.string()));
    }
}

void PreviewOutput::stand_in(const Scene& scene)
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
    stage.end({{"pixels of " + name, pixels}});
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
