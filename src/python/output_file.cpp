#include "python/output_file.hpp"

#include <algorithm>
#include <mutex>

#include "file/input_record.hpp"
#include "file/named_descriptor.hpp"
#include "quadrel/error.hpp"

namespace quadrel::python {
namespace {

std::mutex& reading() {
    static std::mutex mutex;
    return mutex;
}

bool ends_in_exr(const std::filesystem::path& file) {
    std::string extension = file.extension().string();
    for (char& c : extension)
        if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
    return extension == ".exr";
}

/// Whether the name does not say what is written. Of folders the writer says that they are some.
bool is_no_file(const std::filesystem::path& file) {
    if (named_descriptor(file) || file.filename().empty()) return true;
    std::error_code error;
    const std::filesystem::file_status status = std::filesystem::status(file, error);
    return std::filesystem::exists(status) && !std::filesystem::is_regular_file(status);
}

}  // namespace

void Inputs::add(const Inputs& others) {
    files_.insert(files_.end(), others.files_.begin(), others.files_.end());
}

void Inputs::add(const std::filesystem::path& file) {
    if (const auto identity = identity_of(file))
        files_.push_back({file, std::filesystem::absolute(file), *identity});
}

void Inputs::check(const std::string& what, const std::filesystem::path& output) const {
    const auto identity = identity_of(output);
    if (!identity) return;
    for (const Input& input : files_)
        // An editor may have put another file in its place since.
        if (input.identity == identity || identity_of(input.absolute) == identity)
            throw UsageError(what + ": " + output.string() + " is the input " +
                             input.name.string() + ", expected another file");
}

Inputs inputs_of(const std::function<void()>& read) {
    const std::lock_guard lock(reading());
    const InputRecord record;
    read();
    Inputs inputs;
    for (const InputFile& input : record.files()) inputs.add(input.name);
    return inputs;
}

void check_output(const std::string& what, const std::string& file, const Inputs& inputs) {
    if (file.empty()) throw UsageError(what + ": found \"\", expected the name of a file");
    inputs.check(what, file);
    if (!ends_in_exr(file) && !is_no_file(file))
        throw UsageError(what + ": found " + file + ", expected a name that ends in .exr");
}

}  // namespace quadrel::python
