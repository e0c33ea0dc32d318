// Films whose planes are arrays of numpy.
#include <pybind11/stl.h>

#include "python/bindings.hpp"
#include "quadrel/film/channels.hpp"
#include "quadrel/film/heatmap.hpp"
#include "quadrel/film/preview.hpp"

namespace quadrel::python {
namespace {

using Box = std::array<int, 4>;

Box box_of(const Window& window) { return {window.x0, window.y0, window.x1, window.y1}; }

Window window_of(const Box& box) { return {box[0], box[1], box[2], box[3]}; }

std::vector<std::string> names_of(const NamedFilm& named) {
    std::vector<std::string> names;
    for (const Plane& plane : named.film.planes) names.push_back(plane.name);
    return names;
}

/// A view: rows of the window from the top, float32 or uint32. It keeps the film.
py::array plane_array(const py::object& self, const std::string& name) {
    NamedFilm& named = self.cast<NamedFilm&>();
    Plane* const plane = named.film.find(name);
    if (plane == nullptr) throw py::key_error(name);
    const py::dtype type = plane->type == ChannelType::float32 ? py::dtype::of<float>()
                                                               : py::dtype::of<std::uint32_t>();
    const auto width = static_cast<py::ssize_t>(named.film.window.width());
    const auto height = static_cast<py::ssize_t>(named.film.window.height());
    const py::ssize_t size = sizeof(std::uint32_t);
    return py::array(type, {height, width}, {width * size, size}, plane->bits.data(), self);
}

/// Of arrays by channel, which are copied. Integers stay integers; `codes` are channels whose
/// floats were codes of so many bits.
std::shared_ptr<NamedFilm> film_of_arrays(const py::dict& arrays, const Box& frame,
                                          const Box& window,
                                          const std::map<std::string, int>& codes) {
    auto named = std::make_shared<NamedFilm>();
    named->film.frame = window_of(frame);
    named->film.window = window_of(window);
    if (named->film.window.width() < 1 || named->film.window.height() < 1 ||
        !contains(named->film.frame, named->film.window))
        throw UsageError("film: expected a window of at least a pixel within the frame");
    for (const auto& [key, value] : arrays) {
        const std::string name = key.cast<std::string>();
        const auto array = py::cast<py::array>(value);
        const bool whole = array.dtype().kind() != 'f';
        if (array.ndim() != 2 || array.shape(0) != named->film.window.height() ||
            array.shape(1) != named->film.window.width())
            throw UsageError("film: \"" + name + "\" has not the size of the window");
        Plane& plane = named->film.add(name, whole ? ChannelType::uint32 : ChannelType::float32);
        const auto copy = [&]<class T>(T) {
            const auto typed =
                py::array_t<T, py::array::c_style | py::array::forcecast>::ensure(array);
            if (!typed) throw py::error_already_set();
            std::memcpy(plane.bits.data(), typed.data(), plane.bits.size() * sizeof(T));
        };
        if (whole)
            copy(std::uint32_t());
        else
            copy(float());
    }
    for (const auto& [name, bits] : codes)
        named->stored[name] = bits == 8 ? Storage::unorm8 : Storage::unorm16;
    canonicalize(named->film);
    return named;
}

py::array_t<std::uint8_t> picture_array(const Picture& picture) {
    py::array_t<std::uint8_t> array({picture.height, picture.width, 3});
    std::memcpy(array.mutable_data(), picture.rgb.data(), picture.rgb.size());
    return array;
}

std::shared_ptr<NamedFilm> read_film(const std::string& file, const std::string& layer,
                                     const std::string& part) {
    const Unlocked unlocked;
    ExrFile read;
    const auto named = std::make_shared<NamedFilm>();
    named->source = inputs_of([&] { read = read_exr(file, {layer, part}); });
    named->film = std::move(read.film);
    named->attributes = std::move(read.attributes);
    return named;
}

void write_film(const NamedFilm& named, const std::string& file, const std::string& compression) {
    const Unlocked unlocked;
    check_output("write", file, named.inputs);
    write_exr(file, named.film, named.attributes,
              {value_of("compression", compression, exr_compressions), 0});
}

}  // namespace

void bind_films(py::module_& module) {
    py::class_<NamedFilm, std::shared_ptr<NamedFilm>>(module, "Film")
        .def_property_readonly("names", names_of)
        .def_property_readonly("frame", [](const NamedFilm& n) { return box_of(n.film.frame); })
        .def_property_readonly("window", [](const NamedFilm& n) { return box_of(n.film.window); })
        .def_readwrite("attributes", &NamedFilm::attributes)
        .def("plane", plane_array, py::arg("name"))
        .def("hash", [](const NamedFilm& n) { return film_hash(n.film); })
        .def("preview", [](const NamedFilm& n) { return picture_array(preview(n.film)); })
        .def("write", write_film, py::arg("file"), py::arg("compression"));
    module.def("film_of_arrays", film_of_arrays, py::arg("arrays"), py::arg("frame"),
               py::arg("window"), py::arg("codes"));
    module.def("read_film", read_film, py::arg("file"), py::arg("layer"), py::arg("part"));
    module.def(
        "heatmap",
        [](const NamedFilm& reference, const NamedFilm& test) {
            return picture_array(heatmap(reference.film, test.film));
        },
        py::arg("reference"), py::arg("test"));
    module.def(
        "expand_channels",
        [](const std::vector<std::string>& requests) { return expand_channels(requests); },
        py::arg("requests"));
}

}  // namespace quadrel::python
