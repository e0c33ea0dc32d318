// Samplers and derivatives over arrays of numpy. Arrays are flat, of whole quads; what comes out is
// flat as well.
#include <pybind11/stl.h>

#include <type_traits>

#include "python/bindings.hpp"
#include "python/look_ups.hpp"

namespace quadrel::python {
namespace {

constexpr std::pair<std::string_view, LookUp> look_up_words[] = {{"implicit", LookUp::implicit},
                                                                 {"level", LookUp::level},
                                                                 {"gradients", LookUp::gradients},
                                                                 {"gather", LookUp::gather},
                                                                 {"fetch", LookUp::fetch}};
constexpr std::pair<std::string_view, Difference> difference_words[] = {
    {"x", Difference::x}, {"y", Difference::y}, {"width", Difference::width}};
constexpr std::pair<std::string_view, DerivativeMode> mode_words[] = {
    {"fine", DerivativeMode::fine}, {"coarse", DerivativeMode::coarse}};

/// What is asked of a texture.
struct Request {
    HeldTexture texture;
    SamplerState sampler;
    LookUp kind = LookUp::implicit;
    DerivativeMode mode = DerivativeMode::fine;
    int component = 0;
    py::dict arrays;

    SampledTexture sampled() const { return {texture.texture->view(), sampler}; }
};

Request make_request(const HeldTexture& texture, const SamplerState& sampler,
                     const std::string& kind, const std::string& mode, int component,
                     const py::dict& arrays) {
    return {texture,
            sampler,
            value_of("look-up", kind, look_up_words),
            value_of("mode", mode, mode_words),
            component,
            arrays};
}

/// The arrays of a request as T, and whole numbers.
template <class T>
class Arguments {
  public:
    explicit Arguments(const Request& request) {
        arguments_.mode = request.mode;
        arguments_.component = request.component;
        const auto numbers = [&](const char* name) { return take<T>(request.arrays, name); };
        const auto wholes = [&](const char* name) {
            return take<std::int32_t>(request.arrays, name);
        };
        arguments_.u = numbers("u");
        arguments_.v = numbers("v");
        arguments_.bias = numbers("bias");
        arguments_.level = numbers("level");
        arguments_.dudx = numbers("dudx");
        arguments_.dvdx = numbers("dvdx");
        arguments_.dudy = numbers("dudy");
        arguments_.dvdy = numbers("dvdy");
        arguments_.x = wholes("x");
        arguments_.y = wholes("y");
        arguments_.z = wholes("z");
        if (arguments_.lanes % 4 != 0) throw UsageError("look-up: expected whole quads");
    }

    const LookUpArguments<T>& operator*() const { return arguments_; }
    std::size_t lanes() const { return arguments_.lanes; }

  private:
    template <class Element>
    const Element* take(const py::dict& arrays, const char* name) {
        if (!arrays.contains(name)) return nullptr;
        const auto array =
            arrays[name].cast<py::array_t<Element, py::array::c_style | py::array::forcecast>>();
        const auto lanes = static_cast<std::size_t>(array.size());
        if (!kept_.empty() && lanes != arguments_.lanes)
            throw UsageError("look-up: expected arrays of one size");
        arguments_.lanes = lanes;
        kept_.push_back(array);
        return array.data();
    }

    LookUpArguments<T> arguments_;
    std::vector<py::array> kept_;
};

template <class T>
py::array look_up_as(const Request& request) {
    const Arguments<T> arguments(request);
    py::array_t<T> values({arguments.lanes(), std::size_t(4)});
    T* const out = values.mutable_data();
    const Unlocked unlocked;
    look_up<T>(request.sampled(), request.kind, *arguments, out);
    return values;
}

template <class T>
py::array levels_as(const Request& request) {
    const Arguments<T> arguments(request);
    py::array_t<T> records({arguments.lanes(), std::size_t(5)});
    T* const out = records.mutable_data();
    const Unlocked unlocked;
    levels_of_detail<T>(request.sampled(), request.kind, *arguments, out);
    return records;
}

template <class Element>
py::array_t<Element> zeros(std::vector<std::size_t> shape) {
    py::array_t<Element> array(std::move(shape));
    std::memset(array.mutable_data(), 0, static_cast<std::size_t>(array.nbytes()));
    return array;
}

template <class T>
py::tuple footprints_as(const Request& request) {
    const Arguments<T> arguments(request);
    const std::size_t lanes = arguments.lanes();
    auto count = zeros<std::int32_t>({lanes});
    auto level = zeros<std::int32_t>({lanes, most_taps});
    auto x = zeros<std::int32_t>({lanes, most_taps}), y = zeros<std::int32_t>({lanes, most_taps});
    auto border = zeros<bool>({lanes, most_taps});
    auto weight = zeros<double>({lanes, most_taps});
    auto value = zeros<float>({lanes, most_taps, 4});
    const TapArrays taps{count.mutable_data(), level.mutable_data(),  x.mutable_data(),
                         y.mutable_data(),     border.mutable_data(), weight.mutable_data(),
                         value.mutable_data()};
    {
        const Unlocked unlocked;
        footprints<T>(request.sampled(), request.kind, *arguments, taps);
    }
    return py::make_tuple(count, level, x, y, border, weight, value);
}

template <class T>
py::array differences_as(Difference which, DerivativeMode mode, const py::array& of) {
    const auto values = of.cast<py::array_t<T, py::array::c_style | py::array::forcecast>>();
    const auto lanes = static_cast<std::size_t>(values.size());
    if (lanes % 4 != 0) throw UsageError("derivative: expected whole quads");
    py::array_t<T> results(values.size());
    const T* const in = values.data();
    T* const out = results.mutable_data();
    const Unlocked unlocked;
    differences<T>(which, mode, lanes, in, out);
    return results;
}

}  // namespace

void bind_look_ups(py::module_& module) {
    py::class_<Request>(module, "LookUp")
        .def(py::init(&make_request), py::arg("texture"), py::arg("sampler"), py::arg("kind"),
             py::arg("mode"), py::arg("component"), py::arg("arrays"));
    module.def(
        "look_up",
        [](const Request& request, bool as_double) {
            return as_double ? look_up_as<double>(request) : look_up_as<float>(request);
        },
        py::arg("request"), py::arg("as_double"));
    module.def(
        "levels_of_detail",
        [](const Request& request, bool as_double) {
            return as_double ? levels_as<double>(request) : levels_as<float>(request);
        },
        py::arg("request"), py::arg("as_double"));
    module.def(
        "footprints",
        [](const Request& request, bool as_double) {
            return as_double ? footprints_as<double>(request) : footprints_as<float>(request);
        },
        py::arg("request"), py::arg("as_double"));
    module.def(
        "differences",
        [](const std::string& which, const std::string& mode, const py::array& values,
           bool as_double) {
            const Difference difference = value_of("derivative", which, difference_words);
            const DerivativeMode kind = value_of("mode", mode, mode_words);
            return as_double ? differences_as<double>(difference, kind, values)
                             : differences_as<float>(difference, kind, values);
        },
        py::arg("which"), py::arg("mode"), py::arg("values"), py::arg("as_double"));
}

}  // namespace quadrel::python
