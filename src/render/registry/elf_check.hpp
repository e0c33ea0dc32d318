// Whether the loader can be trusted with a file: it believes what headers say, and a damaged one
// ends the process.
#pragma once

#include <optional>
#include <string>
#include <string_view>

namespace quadrel {

/// What is wrong with the bytes of a shared object for this machine, or nothing: the ELF header,
/// the program headers and sections, which must agree, that all they load is in the file, and that
/// the addresses of the dynamic table lie in what is loaded. Code and symbols are not looked at.
std::optional<std::string> elf_fault(std::string_view bytes);

}  // namespace quadrel
