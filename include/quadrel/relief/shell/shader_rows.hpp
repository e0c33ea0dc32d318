// What texts read of a shell's rows, on Shader: varyings of a face's vertices, and texels of the
// table (shell_table.hpp) by the number of its row. To be included before the rows.
#pragma once

#include "quadrel/num/shader/named.hpp"
#include "quadrel/quad/shader_io.hpp"
#include "quadrel/relief/shell/prism_strip.hpp"
#include "quadrel/relief/shell/shell_table.hpp"

namespace quadrel {

namespace recorded {

inline vec3<Shader> varying3(const char* name) {
    return unpack<3>(Recorder::current().input(Type::vec3, name));
}
inline Shader varying(const char* name) {
    return Shader(Recorder::current().input(Type::real, name));
}

/// What the texels of a row are called.
using TexelNames = std::array<const char*, shell_texels_a_row>;

/// A row of the table.
class ShellRow {
  public:
    ShellRow(const ShaderInt& row, const TexelNames& names)
        : column_(named("column",
                        (row & ShaderInt(shell_rows_a_line - 1)) * ShaderInt(shell_texels_a_row))),
          line_(named("table_line", shift_right<shell_rows_bits>(row))),
          names_(names) {}

    vec4<Shader> texel(int k) const {
        Node* const table = Recorder::current().uniform(
            Type::integer, {"shell_table", "sampler2D", 0, "rows of shells, 8 texels each"});
        const ShaderInt column = k == 0 ? column_ : column_ + ShaderInt(k);
        Node* const texel = call(Type::vec4, "texelFetch",
                                 {table, column.node(), line_.node(), literal(Type::integer, 0)});
        give_name(texel, names_[static_cast<std::size_t>(k)]);
        return unpack<4>(texel);
    }
    vec3<Shader> vector(int k) const {
        const vec4<Shader> of = texel(k);
        return {of.x, of.y, of.z};
    }

  private:
    ShaderInt column_, line_;
    TexelNames names_;
};

inline constexpr TexelNames prism_texels = {"bottom_a", "bottom_b", "bottom_c", "top_a",
                                            "top_b",    "top_c",    "prism",    ""};
inline constexpr TexelNames face_texels = {"gradient_a", "gradient_b", "gradient_c", "gradient_u",
                                           "gradient_v", "gradient_s", "",           ""};
inline constexpr TexelNames cell_texels = {"gradient_0", "gradient_1", "gradient_2", "gradient_3",
                                           "uv_01",      "uv_23",      "links",      "origin"};

/// The row of the fragment's face.
inline ShellRow row_of_face(const TexelNames& names) {
    return {named("row", to_int(varying("shell_row"))), names};
}

/// What both kinds of faces interpolate.
class ShellVaryings {
  public:
    Shader s() const { return varying("shell_depth"); }
    Shader weight(int k) const { return varying3("corner_weights")[k]; }
};

}  // namespace recorded

template <>
class PrismFaces<Shader> : public recorded::ShellVaryings {
  public:
    template <class Io>
    explicit PrismFaces(const Io&) : row_(recorded::row_of_face(recorded::prism_texels)) {
        static_assert(Io::reads_vertices, "the stage does not declare reads_vertices");
    }

    vec3<Shader> corner(int k) const { return row_.vector(k); }
    vec2<Shader> uv(int k) const { return {row_.texel(k).w, row_.texel(3 + k).w}; }
    Shader turned() const { return row_.texel(6).x; }
    Shader snap() const { return row_.texel(6).y; }

  private:
    recorded::ShellRow row_;
};

template <>
class ShellFaces<Shader> : public recorded::ShellVaryings {
  public:
    template <class Io>
    explicit ShellFaces(const Io&) : row_(recorded::row_of_face(recorded::face_texels)) {
        static_assert(Io::reads_vertices, "the stage does not declare reads_vertices");
    }

    vec3<Shader> gradient(int k) const { return row_.vector(k); }
    vec3<Shader> grad_u() const { return row_.vector(3); }
    vec3<Shader> grad_v() const { return row_.vector(4); }
    vec3<Shader> s_gradient() const { return row_.vector(5); }
    Shader to_floor() const { return row_.texel(0).w; }
    Shader snap() const { return row_.texel(1).w; }
    ShaderInt cell() const { return to_int(row_.texel(2).w); }

  private:
    recorded::ShellRow row_;
};

template <>
class ShellCells<Shader> {
  public:
    template <class Io>
    explicit ShellCells(const Io& io)
        : row_(named("cell", max(ShellFaces<Shader>(io).cell(), ShaderInt(0)))) {}

    ShaderInt follow(const ShaderMask& mask, const ShaderInt& link) {
        const ShaderInt place = select(mask, link - ShaderInt(ShellCell::first_link), ShaderInt(0));
        const ShaderInt row = shift_right<2>(place);
        row_ = select(mask, row, row_);
        return place - row * ShaderInt(4);
    }

    vec3<Shader> origin() const { return row().vector(7); }
    vec3<Shader> gradient(int corner) const { return row().vector(corner); }
    vec2<Shader> uv(int corner) const {
        const vec4<Shader> two = row().texel(4 + corner / 2);
        return corner % 2 == 0 ? vec2<Shader>(two.x, two.y) : vec2<Shader>(two.z, two.w);
    }
    Shader s(int corner) const { return row().texel(corner).w; }
    ShaderInt link(int corner) const { return to_int(row().texel(6)[corner]); }

  private:
    recorded::ShellRow row() const { return {row_, recorded::cell_texels}; }

    ShaderInt row_;
};

template <>
class StripRows<Shader> {
  public:
    template <class Io>
    explicit StripRows(const Io&) {
        static_assert(Io::reads_vertices, "the stage does not declare reads_vertices");
    }

    vec3<Shader> nv() const { return recorded::varying3("strip_nv"); }
    vec3<Shader> tv() const { return recorded::varying3("strip_tv"); }
    vec3<Shader> bv() const { return recorded::varying3("strip_bv"); }
    Shader height() const { return recorded::varying("strip_height"); }
    Shader side() const { return recorded::varying("strip_side"); }
    /// The rasterizer's.
    Shader front_facing() const { return recorded::varying("front_facing"); }
};

}  // namespace quadrel
