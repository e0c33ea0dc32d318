// The library's exceptions as Python's.
#include <algorithm>
#include <string_view>

#include "python/bindings.hpp"

namespace quadrel::python {
namespace {

/// Types, made once and kept as long as the process.
struct ErrorTypes {
    py::object base, input, usage, output;
};
ErrorTypes* types = nullptr;

py::object make_type(const char* name, const char* text, const py::tuple& bases,
                     const py::dict& members = {}) {
    const std::string whole = std::string("quadrel.") + name;
    return py::reinterpret_steal<py::object>(
        PyErr_NewExceptionWithDoc(whole.c_str(), text, bases.ptr(), members.ptr()));
}

/// What every error has, where nothing else is known.
py::dict unknown_parts() {
    py::dict members;
    for (const char* name : {"file", "key", "found", "expected"}) members[name] = "";
    return members;
}

/// As a text, whatever bytes a file's name has.
py::object text_of(const std::string& text) {
    return py::reinterpret_steal<py::object>(
        PyUnicode_DecodeUTF8(text.data(), static_cast<Py_ssize_t>(text.size()), "surrogateescape"));
}

void raise_with(const py::object& type, const char* message,
                std::initializer_list<std::pair<const char*, py::object>> members) {
    const py::object error = type(text_of(message));
    for (const auto& [name, value] : members) error.attr(name) = value;
    PyErr_SetObject(type.ptr(), error.ptr());
}

py::object known(int number) { return number > 0 ? py::object(py::int_(number)) : py::none(); }

/// The argument, what was found and what was expected, of a message that says them in this order:
/// "isa: found "mmx", expected auto, ..."; of any other, nothing.
struct UsageParts {
    std::string key, found, expected;

    explicit UsageParts(const std::string& message) {
        constexpr std::string_view before_found = ": found ", before_expected = ", expected ";
        const std::size_t colon = message.find(before_found);
        const std::size_t comma = message.rfind(before_expected);
        if (colon == std::string::npos || comma == std::string::npos ||
            comma < colon + before_found.size())
            return;
        // An argument has its option's name.
        const std::size_t dashes = message.starts_with("--") ? 2 : 0;
        key = message.substr(dashes, colon - dashes);
        std::replace(key.begin(), key.end(), '-', '_');
        const std::size_t from = colon + before_found.size();
        found = message.substr(from, comma - from);
        expected = message.substr(comma + before_expected.size());
    }
};

void translate(std::exception_ptr failed) {
    try {
        std::rethrow_exception(failed);
    } catch (const InputError& e) {
        raise_with(types->input, e.what(),
                   {{"file", text_of(e.file)},
                    {"key", text_of(e.key)},
                    {"found", text_of(e.found)},
                    {"expected", text_of(e.expected)},
                    {"line", known(e.line)},
                    {"column", known(e.column)}});
    } catch (const OutputError& e) {
        raise_with(types->output, e.what(),
                   {{"file", text_of(e.file)},
                    {"found", text_of(e.reason)},
                    {"expected", text_of("a file that can be written")},
                    {"reason", text_of(e.reason)}});
    } catch (const UsageError& e) {
        const UsageParts parts(e.what());
        raise_with(types->usage, e.what(),
                   {{"key", text_of(parts.key)},
                    {"found", text_of(parts.found)},
                    {"expected", text_of(parts.expected)}});
    }
}

}  // namespace

void bind_errors(py::module_& module) {
    const auto builtin = [](PyObject* type) { return py::reinterpret_borrow<py::object>(type); };
    const py::object value_error = builtin(PyExc_ValueError), os_error = builtin(PyExc_OSError);
    const py::object base =
        make_type("Error",
                  "Whatever Quadrel refuses, or could not do: `file`, `key` (the place in it, or "
                  "the argument), "
                  "`found` and `expected` are its parts, each empty where it has none.",
                  py::make_tuple(builtin(PyExc_Exception)), unknown_parts());
    types = new ErrorTypes{
        base,
        make_type("InputError",
                  "Bad or missing input: `file`, `key` (the place in it, as objects[0].material; "
                  "may be empty), `found`, `expected`, and `line` and `column` from 1, or None.",
                  py::make_tuple(base, value_error)),
        make_type("UsageError",
                  "A call that makes no sense: `key` is the argument, where one alone is wrong, "
                  "with what was `found` and what was `expected`.",
                  py::make_tuple(base, value_error)),
        make_type("OutputError", "`file` could not be written, for the `reason`; it is untouched.",
                  py::make_tuple(base, os_error))};
    module.attr("Error") = types->base;
    module.attr("InputError") = types->input;
    module.attr("UsageError") = types->usage;
    module.attr("OutputError") = types->output;
    py::register_exception_translator(translate);
}

}  // namespace quadrel::python
