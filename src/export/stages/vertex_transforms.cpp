#include "export/stages/vertex_transforms.hpp"

#include "export/print/wrapped_line.hpp"

namespace quadrel::recorded {
namespace {

/// By rows.
const Uniform to_eye{"model_view", "float", 16}, to_object{"inverse_model_view", "float", 16};

struct Transform {
    const char* name;
    const Uniform& matrix;
    enum class Of { point, vector, normal } of;
};
const Transform all[] = {{"point_to_eye", to_eye, Transform::Of::point},
                         {"vector_to_eye", to_eye, Transform::Of::vector},
                         {"point_to_object", to_object, Transform::Of::point},
                         {"vector_to_object", to_object, Transform::Of::vector},
                         {"normal_to_eye", to_object, Transform::Of::normal}};

class Text {
  public:
    Text(const Transform& of, const Dialect& dialect) : of_(of), dialect_(dialect) {}

    std::string function() const {
        return dialect_.helper_head(Type::vec3, of_.name, {{"v", Type::vec3}}) + "\n" +
               wrapped_line("    return " + value() + ";") + "\n}\n";
    }

  private:
    std::string element(int row, int column) const {
        return dialect_.use_of(of_.matrix,
                               of_.matrix.name + "[" + std::to_string(4 * row + column) + "]");
    }
    std::string vector(const std::string& x, const std::string& y, const std::string& z) const {
        return dialect_.type(Type::vec3) + "(" + x + ", " + y + ", " + z + ")";
    }
    std::string row(int r) const { return vector(element(r, 0), element(r, 1), element(r, 2)); }

    /// Of a vector without the translation times 0, which can change a zero's sign alone.
    std::string value() const {
        if (of_.of == Transform::Of::normal)
            return row(0) + " * v.x + " + row(1) + " * v.y + " + row(2) + " * v.z";
        const auto product = [&](int r) { return "dot(" + row(r) + ", v)"; };
        const std::string turned = vector(product(0), product(1), product(2));
        if (of_.of == Transform::Of::vector) return turned;
        return turned + " + " + vector(element(0, 3), element(1, 3), element(2, 3));
    }

    const Transform& of_;
    const Dialect& dialect_;
};

}  // namespace

const Uniform* matrix_of_transform(const Node& node) {
    if (node.kind != Node::Kind::call) return nullptr;
    for (const Transform& of : all)
        if (node.text == of.name) return &of.matrix;
    return nullptr;
}

std::vector<std::string> transform_names() {
    std::vector<std::string> names;
    for (const Transform& of : all) names.emplace_back(of.name);
    return names;
}

std::string transform_functions(const std::string& text, const Dialect& dialect) {
    std::string functions;
    for (const Transform& of : all)
        if (text.find(std::string(of.name) + "(") != std::string::npos)
            functions += Text(of, dialect).function();
    return functions.empty()
               ? functions
               : "// By the object's matrices, from space to space.\n" + functions + "\n";
}

}  // namespace quadrel::recorded
