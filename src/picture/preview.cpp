#include "picture/preview.h"

#include "base/text.h"
#include "picture/picture.h"
#include "picture/shade.h"

#include <fmt/format.h>

#include <utility>

namespace vcarve {

namespace {

const Eigen::Array3f kPaper{255.0F, 255.0F, 255.0F};
const Eigen::Array3f kInk{34.0F, 38.0F, 46.0F};
const Eigen::Array3f kFaintInk{110.0F, 116.0F, 126.0F};
constexpr int kGapPx = 8; ///< between panels, and around captions

/// The text scale for a panel width.
int text_scale(int width_px)
{
    return width_px >= 900 ? 2 : 1;
}

int caption_height_px(int panel_width_px)
{
    return text_scale(panel_width_px) * kTextHeight + kGapPx;
}

/// Draws the name and `rest` on the left, and the meaning of the flat color on the right.
void draw_caption(const std::string& name, const std::string& rest, int panel_width_px,
                  Picture& row)
{
    const int scale = text_scale(panel_width_px);
    const int top_px = (kGapPx + scale * 4) / 2;
    draw_text(name, {kGapPx, top_px}, scale, kInk, row);
    draw_text(rest, {kGapPx + scale * (text_width(name) + 12), top_px}, scale, kFaintInk, row);
    const std::string backs = "backs of faces";
    const int left_px = row.width_px - kGapPx - scale * text_width(backs);
    draw_text(backs, {left_px, top_px}, scale, kFaintInk, row);
    const int side_px = scale * 7;
    fill_box({left_px - kGapPx - side_px, top_px}, {left_px - kGapPx, top_px + side_px}, kBack,
             row);
}

} // namespace

Preview::Preview(Eye eye, double panel_pixels) : eye_(std::move(eye)), panel_pixels_(panel_pixels)
{
}

std::int64_t Preview::add(const std::string& name, const TriMesh& mesh, const Texture& texture)
{
    const Looks looks = look_at(mesh, texture, eye_, panel_pixels_);
    const int width_px = looks.shaded.width_px;
    const int caption_px = caption_height_px(width_px);
    Picture row = even_picture(2 * width_px + kGapPx, caption_px + looks.shaded.height_px, kPaper);
    paste(looks.shaded, 0, caption_px, row);
    paste(looks.normals, width_px + kGapPx, caption_px, row);
    draw_caption(name,
                 fmt::format("{} faces from {}",
                             grouped_digits(static_cast<std::int64_t>(mesh.faces.size())),
                             eye_.name),
                 width_px, row);
    rows_.push_back(std::move(row));
    return static_cast<std::int64_t>(looks.shaded.pixels.size());
}

Picture Preview::picture() const
{
    Picture all;
    for (const Picture& row : rows_) {
        all.width_px = row.width_px;
        all.height_px += row.height_px;
        all.pixels.insert(all.pixels.end(), row.pixels.begin(), row.pixels.end());
    }
    return all;
}

} // namespace vcarve
