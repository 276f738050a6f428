#include "render/shapes.h"

#include <cmath>
#include <numbers>

namespace vcarve::render {

namespace {

constexpr double kTwoPi = 2.0 * std::numbers::pi;

/// Joins the rows of vertices of a ball, from pole to pole. Rows are counterclockwise from the last
/// pole.
struct BallRows {
    std::uint32_t bottom;
    std::uint32_t first;
    std::uint32_t top;
    int rings; ///< number of rows of vertices + 1
    int steps; ///< vertices per row
};

void join_ball(PartBuilder& builder, const BallRows& ball)
{
    const auto at = [&](int ring, int step) {
        return ball.first + (ring - 1) * ball.steps + step % ball.steps;
    };
    for (int step = 0; step < ball.steps; ++step) {
        builder.triangle(ball.bottom, at(1, step + 1), at(1, step));
        for (int ring = 1; ring + 1 < ball.rings; ++ring) {
            builder.quad(
                {at(ring, step), at(ring, step + 1), at(ring + 1, step + 1), at(ring + 1, step)});
        }
        builder.triangle(at(ball.rings - 1, step), at(ball.rings - 1, step + 1), ball.top);
    }
}

/// Adds a ball with these rings and steps. `place` maps the unit direction of a vertex to its
/// position.
template <typename Place>
void add_ball(PartBuilder& builder, int rings, int steps, const Place& place)
{
    BallRows ball{0, 0, 0, rings, steps};
    ball.bottom = builder.vertex(place(-Eigen::Vector3d::UnitZ()));
    ball.first = builder.next_vertex();
    for (int ring = 1; ring < rings; ++ring) {
        const double tilt = -kTwoPi / 4 + kTwoPi / 2 * ring / rings;
        for (int step = 0; step < steps; ++step) {
            const double turn = kTwoPi * step / steps;
            builder.vertex(place({std::cos(tilt) * std::cos(turn), std::cos(tilt) * std::sin(turn),
                                  std::sin(tilt)}));
        }
    }
    ball.top = builder.vertex(place(Eigen::Vector3d::UnitZ()));
    join_ball(builder, ball);
}

/// Joins `around` closed rows of `across` vertices each to a closed tube.
void join_torus(PartBuilder& builder, std::uint32_t first, int around, int across)
{
    const auto at = [&](int i, int k) { return first + (i % around) * across + k % across; };
    for (int i = 0; i < around; ++i) {
        for (int k = 0; k < across; ++k) {
            builder.quad({at(i, k), at(i, k + 1), at(i + 1, k + 1), at(i + 1, k)});
        }
    }
}

/// Adds the quads of a board, which share no vertices.
class BoardFaces {
  public:
    BoardFaces(PartBuilder& builder, const Board& board) : builder_(builder), board_(board) {}

    void add_all()
    {
        for (std::size_t i = 0; i + 1 < board_.x.size(); ++i) {
            for (std::size_t k = 0; k + 1 < board_.z.size(); ++k) {
                add_cell(i, k);
            }
        }
    }

  private:
    using Corners = std::array<Eigen::Vector3d, 4>;

    /// The front of a cell; cells outside of the grid are holes.
    double front(std::size_t i, std::size_t k) const
    {
        if (i >= board_.x.size() - 1 || k >= board_.z.size() - 1) return board_.back;
        return std::min(board_.recess(i, k), board_.back);
    }

    void add(const Corners& corners)
    {
        std::array<std::uint32_t, 4> v;
        for (int i = 0; i < 4; ++i) {
            v[i] = builder_.vertex(corners[i]);
        }
        builder_.quad(v);
    }

    /// Adds the front, the back, and the sides towards neighbors with a deeper front.
    void add_cell(std::size_t i, std::size_t k)
    {
        const double y = front(i, k);
        const double x0 = board_.x[i];
        const double x1 = board_.x[i + 1];
        const double z0 = board_.z[k];
        const double z1 = board_.z[k + 1];
        if (y < board_.back) {
            const double back = board_.back;
            add({{{x0, y, z0}, {x1, y, z0}, {x1, y, z1}, {x0, y, z1}}});
            add({{{x0, back, z0}, {x0, back, z1}, {x1, back, z1}, {x1, back, z0}}});
        }
        // Indices below 0 wrap around and are outside of the grid.
        if (const double d = front(i - 1, k); d > y) {
            add({{{x0, y, z0}, {x0, y, z1}, {x0, d, z1}, {x0, d, z0}}});
        }
        if (const double d = front(i + 1, k); d > y) {
            add({{{x1, y, z0}, {x1, d, z0}, {x1, d, z1}, {x1, y, z1}}});
        }
        if (const double d = front(i, k - 1); d > y) {
            add({{{x0, y, z0}, {x0, d, z0}, {x1, d, z0}, {x1, y, z0}}});
        }
        if (const double d = front(i, k + 1); d > y) {
            add({{{x0, y, z1}, {x1, y, z1}, {x1, d, z1}, {x0, d, z1}}});
        }
    }

    PartBuilder& builder_;
    const Board& board_;
};

} // namespace

void PartBuilder::begin_part(const Paint& paint)
{
    parts_.paint_of_part.push_back(paint);
    first_vertex_ = next_vertex();
    first_face_ = parts_.mesh.faces.size();
}

std::uint32_t PartBuilder::next_vertex() const
{
    return static_cast<std::uint32_t>(parts_.mesh.positions.size());
}

std::uint32_t PartBuilder::vertex(const Eigen::Vector3d& position)
{
    parts_.mesh.positions.push_back(position);
    return next_vertex() - 1;
}

void PartBuilder::triangle(std::uint32_t a, std::uint32_t b, std::uint32_t c)
{
    parts_.mesh.faces.push_back({a, b, c});
    parts_.part_of_face.push_back(static_cast<std::uint32_t>(parts_.paint_of_part.size() - 1));
}

void PartBuilder::quad(const std::array<std::uint32_t, 4>& v)
{
    triangle(v[0], v[1], v[2]);
    triangle(v[0], v[2], v[3]);
}

void PartBuilder::move_part(const Eigen::Isometry3d& move)
{
    for (std::uint32_t i = first_vertex_; i < next_vertex(); ++i) {
        parts_.mesh.positions[i] = move * parts_.mesh.positions[i];
    }
}

std::vector<Eigen::Vector3d> PartBuilder::part_corners() const
{
    std::vector<Eigen::Vector3d> result;
    for (std::size_t i = first_face_; i < parts_.mesh.faces.size(); ++i) {
        for (const std::uint32_t corner : parts_.mesh.faces[i]) {
            result.push_back(parts_.mesh.positions[corner]);
        }
    }
    return result;
}

void add_box(PartBuilder& builder, const StandingBox& box, const Paint& paint)
{
    builder.begin_part(paint);
    const Eigen::AngleAxisd turn(box.turn_deg * kTwoPi / 360.0, Eigen::Vector3d::UnitZ());
    std::array<std::uint32_t, 8> v;
    for (int i = 0; i < 8; ++i) {
        const Eigen::Vector3d share((i & 1) - 0.5, ((i >> 1) & 1) - 0.5, (i >> 2) & 1);
        v[i] = builder.vertex(box.place + turn * share.cwiseProduct(box.size));
    }
    builder.quad({v[0], v[2], v[3], v[1]});
    builder.quad({v[4], v[5], v[7], v[6]});
    builder.quad({v[0], v[1], v[5], v[4]});
    builder.quad({v[2], v[6], v[7], v[3]});
    builder.quad({v[0], v[4], v[6], v[2]});
    builder.quad({v[1], v[3], v[7], v[5]});
}

void add_bar(PartBuilder& builder, const Bar& bar, const Paint& paint)
{
    const Eigen::Vector3d along = bar.to - bar.from;
    add_box(builder, {{0.0, 0.0, 0.0}, {bar.thickness, bar.thickness, along.norm()}}, paint);
    Eigen::Isometry3d move(Eigen::Translation3d(bar.from));
    move.rotate(Eigen::Quaterniond::FromTwoVectors(Eigen::Vector3d::UnitZ(), along));
    builder.move_part(move);
}

void add_sphere(PartBuilder& builder, const Eigen::Vector3d& middle, double radius,
                const Paint& paint)
{
    builder.begin_part(paint);
    add_ball(builder, 24, 48,
             [&](const Eigen::Vector3d& way) -> Eigen::Vector3d { return middle + radius * way; });
}

void add_ring(PartBuilder& builder, const Eigen::Vector3d& middle, const Eigen::Vector2d& radii,
              const Paint& paint)
{
    constexpr int kAround = 64;
    constexpr int kAcross = 24;
    builder.begin_part(paint);
    const std::uint32_t first = builder.next_vertex();
    for (int i = 0; i < kAround; ++i) {
        const double around = kTwoPi * i / kAround;
        const Eigen::Vector3d out(std::cos(around), 0.0, std::sin(around));
        for (int k = 0; k < kAcross; ++k) {
            const double across = kTwoPi * k / kAcross;
            builder.vertex(middle + (radii[0] + radii[1] * std::cos(across)) * out +
                           radii[1] * std::sin(across) * Eigen::Vector3d::UnitY());
        }
    }
    join_torus(builder, first, kAround, kAcross);
}

void add_column(PartBuilder& builder, const Column& column, const Paint& paint)
{
    constexpr int kSteps = 48;
    builder.begin_part(paint);
    const std::uint32_t bottom = builder.vertex(column.place);
    const Eigen::Vector3d end = column.place + column.height * Eigen::Vector3d::UnitZ();
    const std::uint32_t top = builder.vertex(end);
    const std::uint32_t first = builder.next_vertex();
    for (int step = 0; step < kSteps; ++step) {
        const double turn = kTwoPi * step / kSteps;
        const Eigen::Vector3d out(std::cos(turn), std::sin(turn), 0.0);
        builder.vertex(column.place + column.bottom_radius * out);
        builder.vertex(end + column.top_radius * out);
    }
    const auto at = [&](int step, int above) { return first + 2 * (step % kSteps) + above; };
    for (int step = 0; step < kSteps; ++step) {
        builder.triangle(bottom, at(step + 1, 0), at(step, 0));
        builder.quad({at(step, 0), at(step + 1, 0), at(step + 1, 1), at(step, 1)});
        builder.triangle(at(step, 1), at(step + 1, 1), top);
    }
}

void add_board(PartBuilder& builder, const Board& board, const Paint& paint)
{
    builder.begin_part(paint);
    BoardFaces(builder, board).add_all();
}

void add_blob(PartBuilder& builder, const Eigen::Vector3d& middle,
              const std::function<double(const Eigen::Vector3d&)>& reach, const Paint& paint)
{
    builder.begin_part(paint);
    add_ball(builder, 72, 144, [&](const Eigen::Vector3d& way) -> Eigen::Vector3d {
        return middle + reach(way) * way;
    });
}

void add_tube(PartBuilder& builder, const Tube& tube, const Paint& paint)
{
    constexpr int kAround = 240;
    constexpr int kAcross = 32;
    builder.begin_part(paint);
    const std::uint32_t first = builder.next_vertex();
    for (int i = 0; i < kAround; ++i) {
        const double along = static_cast<double>(i) / kAround;
        constexpr double kStep = 1e-5;
        const Eigen::Vector3d ahead = tube.curve(along + kStep) - tube.curve(along - kStep);
        const Eigen::Vector3d side = ahead.cross(Eigen::Vector3d::UnitZ()).normalized();
        const Eigen::Vector3d up = ahead.cross(side).normalized();
        for (int k = 0; k < kAcross; ++k) {
            const double across = static_cast<double>(k) / kAcross;
            const double turn = kTwoPi * across;
            builder.vertex(tube.curve(along) + tube.radius(along, across) *
                                                   (std::cos(turn) * side + std::sin(turn) * up));
        }
    }
    join_torus(builder, first, kAround, kAcross);
}

} // namespace vcarve::render
