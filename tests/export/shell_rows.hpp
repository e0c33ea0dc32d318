// Random shells: the rows that stages read, and the table and varyings that exported functions have
// in their place.
#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <string_view>
#include <vector>

#include "export/fragments.hpp"
#include "export/shell_inputs.hpp"
#include "quadrel/relief/shell/prism_strip.hpp"
#include "quadrel/relief/shell/shell_table.hpp"

namespace quadrel::export_tests {

class RandomShells {
  public:
    explicit RandomShells(test::Random& random) {
        make_triangles(random);
        for (int i = 0; i < row_count; ++i) {
            add(faces_, random_face(random));
            add(prisms_, random_prism(random));
            add(strips_, random_strip(random));
        }
        for (int i = 0; i < row_count; ++i) add(faces_, random_cell(random, i));
    }

    /// Whether a stage reads rows of a shell.
    static bool are_read_by(std::string_view id) {
        return id.starts_with("frame-shell") || id.starts_with("frame-prism") ||
               id.starts_with("displace-prism") || id.starts_with("shadow-shell") ||
               id.starts_with("prism-pom") || id.starts_with("prism-gs") || id == "prism-exact";
    }

    /// What a call of the stage reads, and the same as inputs of its function.
    void bind(std::string_view id, StageCall& call, SlotArrays& inputs) {
        for (std::size_t i = 0; i < 3; ++i) call.edges[i] = edges_[i].data();
        call.primitive = primitive_.data();
        call.primitives = triangles_.data();
        const Rows& rows = id.ends_with("@published")                ? strips_
                           : id == "frame-prism" || id == "prism-gs" ? prisms_
                                                                     : faces_;
        call.vertices = rows.rows.data();
        table_.view.texels = rows.texels.data();
        for (int lane = 0; lane < call.lanes; lane += 4) set_inputs(Quads{call, lane}, inputs);
    }
    const SampledTexture& table() const { return table_; }

  private:
    /// More than a line of the table has.
    static constexpr int row_count = 3 * shell_rows_a_line;

    struct Rows {
        std::vector<PrimitiveVertices> rows;
        std::vector<float> texels = std::vector<float>(4 * shell_table_width * lines);
    };
    static constexpr int lines = 2 * row_count / shell_rows_a_line;

    /// A quad, as readers of rows want to see a stage's values.
    struct Quads {
        using Number = Quad<float>;
        static constexpr bool reads_vertices = true;
        const StageCall& of;
        int lane;
        const StageCall& call() const { return of; }
        int first_lane() const { return lane; }
    };

    template <class Row>
    static void add(Rows& rows, const Row& row) {
        if constexpr (!std::is_same_v<Row, PrismStrip>) {
            const ShellTexels texels = texels_of(row);
            const std::size_t place = rows.rows.size() * texels.size() * 4;
            for (std::size_t k = 0; k < texels.size(); ++k)
                std::copy_n(texels[k].begin(), 4,
                            rows.texels.begin() + std::ptrdiff_t(place + 4 * k));
        }
        rows.rows.push_back(std::bit_cast<PrimitiveVertices>(row));
    }

    static float number(test::Random& random, double low, double high) {
        return static_cast<float>(random.uniform(low, high));
    }
    template <std::size_t n>
    static void fill(float (&to)[n], test::Random& random, double low, double high) {
        for (float& x : to) x = number(random, low, high);
    }

    /// Quads lie in triangles of any perspective, some lanes beside them.
    void make_triangles(test::Random& random) {
        triangles_.resize(row_count);
        for (PrimitiveData& triangle : triangles_) fill(triangle.w, random, 0.5, 2);
        primitive_.resize(batch_lanes);
        for (auto& edge : edges_) edge.resize(batch_lanes);
        for (std::size_t lane = 0; lane < batch_lanes; ++lane) {
            primitive_[lane] = lane % 4 == 0 ? random.below(row_count) : primitive_[lane - 1];
            for (auto& edge : edges_) edge[lane] = random.integer(-2000, 20000);
        }
    }

    static ShellFace random_face(test::Random& random) {
        ShellFace face{};
        fill(face.s, random, 0, 1);
        for (auto& weights : face.weights) fill(weights, random, 0, 1);
        for (auto& gradient : face.gradient) fill(gradient, random, -1, 1);
        fill(face.J, random, -1, 1);
        fill(face.s_gradient, random, -1, 1);
        face.to_floor = static_cast<float>(random.integer(-1, 2));
        face.snap = 0x1p-8f;
        face.cell = row_count + random.below(row_count);
        return face;
    }

    /// Around the points where fragments are, so that rays leave it somewhere.
    static PrismFace random_prism(test::Random& random) {
        PrismFace face{};
        fill(face.s, random, 0, 1);
        for (auto& weights : face.weights) fill(weights, random, 0, 1);
        static constexpr float corners[3][2] = {{-4, -3}, {4, -3}, {0, 5}};
        face.turned = random.chance(0.5) ? 1.0f : -1.0f;
        for (int k = 0; k < 3; ++k) {
            for (int i = 0; i < 2; ++i) {
                face.bottom[k][i] = corners[k][i] + number(random, -1, 1);
                face.top[k][i] = corners[k][i] + number(random, -1, 1);
            }
            face.bottom[k][2] = -2 - face.turned * number(random, 1, 3);
            face.top[k][2] = -2 + face.turned * number(random, 1, 3);
            fill(face.uv[k], random, -1, 1);
        }
        if (face.turned < 0)
            for (auto* const corner : {face.bottom, face.top})
                for (int k = 0; k < 3; ++k) corner[k][2] = -4 - corner[k][2];
        face.snap = 0x1p-8f;
        return face;
    }

    static PrismStrip random_strip(test::Random& random) {
        PrismStrip strip{};
        const bool base = random.chance(0.5);
        const float side = base ? 0.0f : static_cast<float>(random.integer(-1, 1));
        for (int v = 0; v < 3; ++v) {
            fill(strip.nv[v], random, -1, 1);
            fill(strip.tv[v], random, -1, 1);
            fill(strip.bv[v], random, -1, 1);
            strip.height[v] = base ? 0.0f : number(random, 0, 1);
            strip.side[v] = side;
        }
        strip.front_facing = random.chance(0.5) ? 1.0f : -1.0f;
        return strip;
    }

    /// Neighbours lie further on, so that no ray goes round in circles.
    static ShellCell random_cell(test::Random& random, int index) {
        ShellCell cell{};
        for (float& x : cell.origin) x = number(random, -1, 1);
        cell.origin[2] -= 2;
        for (auto& gradient : cell.gradient) fill(gradient, random, -1, 1);
        for (auto& uv : cell.uv) fill(uv, random, -1, 1);
        fill(cell.s, random, 0, 1);
        for (std::int32_t& link : cell.link) {
            const int on = index + 1 + random.below(4);
            link = random.chance(0.1) ? ShellCell::below
                   : on < row_count   ? ShellCell::link_to(row_count + on, random.below(4))
                                      : ShellCell::outside;
        }
        return cell;
    }

    static void set_inputs(const Quads& quad, SlotArrays& inputs) {
        using F = Quad<float>;
        const auto set = [&](const char* name, int component, const F& values) {
            for (int i = 0; i < 4; ++i)
                inputs.at(shell_slot(shell_input(name)) + component)[quad.lane + i] =
                    values.lane[i];
        };
        const auto set3 = [&](const char* name, const vec3<F>& values) {
            for (int c = 0; c < 3; ++c) set(name, c, values[c]);
        };
        // Of rows of another kind this is nonsense, which their stages do not read.
        const PrismFaces<F> face(quad);
        for (int k = 0; k < 3; ++k) set("corner_weights", k, face.weight(k));
        set("shell_depth", 0, face.s());
        set("shell_row", 0, F(static_cast<float>(quad.of.primitive[quad.lane])));
        const StripRows<F> strip(quad);
        set3("strip_nv", strip.nv());
        set3("strip_tv", strip.tv());
        set3("strip_bv", strip.bv());
        set("strip_height", 0, strip.height());
        set("strip_side", 0, strip.side());
        set("front_facing", 0, strip.front_facing());
    }

    static SampledTexture make_table() {
        SampledTexture table{};
        table.view.channels = 4;
        table.view.faces = table.view.levels = 1;
        table.view.width[0] = shell_table_width;
        table.view.height[0] = lines;
        return table;
    }

    std::vector<PrimitiveData> triangles_;
    std::array<std::vector<double>, 3> edges_;
    std::vector<std::int32_t> primitive_;
    Rows faces_, prisms_, strips_;
    SampledTexture table_ = make_table();
};

}  // namespace quadrel::export_tests
