#include "render/registry/elf_check.hpp"

#include <elf.h>
#include <fmt/format.h>

#include <bit>
#include <cstring>
#include <vector>

namespace quadrel {

namespace {

#if defined(__x86_64__)
constexpr unsigned this_machine = EM_X86_64;
#elif defined(__aarch64__)
constexpr unsigned this_machine = EM_AARCH64;
#endif
constexpr unsigned char this_order =
    std::endian::native == std::endian::little ? ELFDATA2LSB : ELFDATA2MSB;

using ElfFault = std::optional<std::string>;

class ElfCheck {
  public:
    explicit ElfCheck(std::string_view bytes) : bytes_(bytes) {}

    ElfFault run() {
        if (auto fault = check_header()) return fault;
        if (auto fault = read_segments()) return fault;
        if (auto fault = check_segments()) return fault;
        return check_dynamic();
    }

  private:
    /// Whether [first, first + size) lies in [0, end).
    static bool fits(std::uint64_t first, std::uint64_t size, std::uint64_t end) {
        return first <= end && size <= end - first;
    }

    template <class T>
    T read(std::uint64_t offset) const {
        T value;
        std::memcpy(&value, bytes_.data() + offset, sizeof value);
        return value;
    }

    ElfFault check_header() {
        if (!bytes_.starts_with(std::string_view(ELFMAG, SELFMAG))) return "a file that is no ELF";
        if (bytes_.size() < sizeof(Elf64_Ehdr)) return "a shared object that is cut off";
        header_ = read<Elf64_Ehdr>(0);
        const bool here = header_.e_ident[EI_CLASS] == ELFCLASS64 &&
                          header_.e_ident[EI_DATA] == this_order &&
                          header_.e_machine == this_machine;
        if (!here) return "a shared object for another machine";
        if (header_.e_type != ET_DYN) return "an ELF file that is no shared object";
        const bool sound = header_.e_ident[EI_VERSION] == EV_CURRENT &&
                           header_.e_version == EV_CURRENT &&
                           header_.e_phentsize == sizeof(Elf64_Phdr) && header_.e_phnum > 0;
        return sound ? ElfFault() : "a damaged ELF header";
    }

    ElfFault read_segments() {
        const std::uint64_t size = std::uint64_t(header_.e_phnum) * sizeof(Elf64_Phdr);
        if (!fits(header_.e_phoff, size, bytes_.size())) return "a shared object that is cut off";
        for (unsigned i = 0; i < header_.e_phnum; ++i)
            segments_.push_back(read<Elf64_Phdr>(header_.e_phoff + i * sizeof(Elf64_Phdr)));
        return std::nullopt;
    }

    static bool is_in_file(const Elf64_Phdr& segment) {
        switch (segment.p_type) {
            case PT_LOAD:
            case PT_DYNAMIC:
            case PT_INTERP:
            case PT_NOTE:
            case PT_TLS:
            case PT_GNU_EH_FRAME:
                return true;
            default:
                return false;
        }
    }

    ElfFault check_segments() {
        constexpr std::uint64_t most_memory = std::uint64_t(1) << 32, page = 4096;
        std::uint64_t end = 0;
        for (const Elf64_Phdr& segment : segments_) {
            if (is_in_file(segment) && !fits(segment.p_offset, segment.p_filesz, bytes_.size()))
                return "a shared object that is cut off";
            if (segment.p_type != PT_LOAD) continue;
            // In order, as the format demands, and each page of the file where its address says.
            const bool sound =
                segment.p_vaddr >= end && fits(segment.p_vaddr, segment.p_memsz, most_memory) &&
                segment.p_filesz <= segment.p_memsz &&
                (segment.p_filesz == segment.p_memsz || (segment.p_flags & PF_W) != 0) &&
                std::has_single_bit(segment.p_align) && segment.p_align >= page &&
                segment.p_vaddr % segment.p_align == segment.p_offset % segment.p_align;
            if (!sound) return "a damaged program header";
            end = segment.p_vaddr + segment.p_memsz;
        }
        return check_loaded();
    }

    /// What the loader reads in memory has to be there, from the same place of the file.
    ElfFault check_loaded() const {
        for (const Elf64_Phdr& segment : segments_) {
            const bool read_in_memory = segment.p_type == PT_DYNAMIC || segment.p_type == PT_TLS ||
                                        segment.p_type == PT_NOTE ||
                                        segment.p_type == PT_GNU_EH_FRAME ||
                                        segment.p_type == PT_GNU_PROPERTY;
            if (read_in_memory &&
                !is_mapped(segment.p_vaddr, segment.p_offset, segment.p_filesz, 0))
                return "a damaged program header";
            if (segment.p_type == PT_GNU_RELRO && !is_loaded(segment.p_vaddr, segment.p_memsz))
                return "a damaged program header";
        }
        return check_sections();
    }

    /// Sections repeat what segments say; files may be without.
    ElfFault check_sections() const {
        if (header_.e_shnum == 0) return std::nullopt;
        const std::uint64_t size = std::uint64_t(header_.e_shnum) * sizeof(Elf64_Shdr);
        if (header_.e_shentsize != sizeof(Elf64_Shdr) ||
            !fits(header_.e_shoff, size, bytes_.size()))
            return "a damaged table of sections";
        for (unsigned i = 0; i < header_.e_shnum; ++i) {
            const auto section = read<Elf64_Shdr>(header_.e_shoff + i * sizeof(Elf64_Shdr));
            const bool in_memory = (section.sh_flags & SHF_ALLOC) != 0;
            if (!in_memory || section.sh_type == SHT_NOBITS) continue;
            unsigned flags = PF_R;
            if (section.sh_flags & SHF_WRITE) flags |= PF_W;
            if (section.sh_flags & SHF_EXECINSTR) flags |= PF_X;
            if (!is_mapped(section.sh_addr, section.sh_offset, section.sh_size, flags))
                return "sections outside of the program headers";
        }
        return std::nullopt;
    }

    /// Whether these bytes of the file get to that address, with at least these permissions.
    bool is_mapped(std::uint64_t address, std::uint64_t offset, std::uint64_t size,
                   unsigned flags) const {
        for (const Elf64_Phdr& segment : segments_)
            if (segment.p_type == PT_LOAD && address >= segment.p_vaddr &&
                fits(address - segment.p_vaddr, size, segment.p_filesz) &&
                (segment.p_flags & flags) == flags)
                return address - segment.p_vaddr == offset - segment.p_offset;
        return false;
    }

    bool is_loaded(std::uint64_t address, std::uint64_t size) const {
        for (const Elf64_Phdr& segment : segments_)
            if (segment.p_type == PT_LOAD && address >= segment.p_vaddr &&
                fits(address - segment.p_vaddr, size, segment.p_memsz))
                return true;
        return false;
    }

    static bool is_address(std::int64_t tag) {
        switch (tag) {
            case DT_HASH:
            case DT_GNU_HASH:
            case DT_STRTAB:
            case DT_SYMTAB:
            case DT_RELA:
            case DT_JMPREL:
            case DT_INIT:
            case DT_FINI:
            case DT_INIT_ARRAY:
            case DT_FINI_ARRAY:
            case DT_VERSYM:
            case DT_VERNEED:
            case DT_VERDEF:
            case DT_PLTGOT:
                return true;
            default:
                return false;
        }
    }

    /// The tag whose size belongs to the address of `tag`, or DT_NULL.
    static std::int64_t size_tag(std::int64_t tag) {
        switch (tag) {
            case DT_STRTAB:
                return DT_STRSZ;
            case DT_RELA:
                return DT_RELASZ;
            case DT_JMPREL:
                return DT_PLTRELSZ;
            case DT_INIT_ARRAY:
                return DT_INIT_ARRAYSZ;
            case DT_FINI_ARRAY:
                return DT_FINI_ARRAYSZ;
            default:
                return DT_NULL;
        }
    }

    std::uint64_t value_of(const std::vector<Elf64_Dyn>& table, std::int64_t tag) const {
        for (const Elf64_Dyn& entry : table)
            if (entry.d_tag == tag) return entry.d_un.d_val;
        return 0;
    }

    ElfFault check_dynamic() const {
        for (const Elf64_Phdr& segment : segments_) {
            if (segment.p_type != PT_DYNAMIC) continue;
            std::vector<Elf64_Dyn> table;
            for (std::uint64_t at = 0; at + sizeof(Elf64_Dyn) <= segment.p_filesz;
                 at += sizeof(Elf64_Dyn))
                table.push_back(read<Elf64_Dyn>(segment.p_offset + at));
            return check_table(table);
        }
        return "a shared object without a dynamic table";
    }

    ElfFault check_table(const std::vector<Elf64_Dyn>& table) const {
        bool ends = false;
        for (const Elf64_Dyn& entry : table) {
            if (ends) break;
            ends = entry.d_tag == DT_NULL;
            if (!is_address(entry.d_tag)) continue;
            const std::int64_t size = size_tag(entry.d_tag);
            if (!is_loaded(entry.d_un.d_ptr, size == DT_NULL ? 1 : value_of(table, size)))
                return "a damaged dynamic table";
        }
        const bool complete = value_of(table, DT_STRTAB) != 0 && value_of(table, DT_SYMTAB) != 0;
        return ends && complete ? ElfFault() : "a damaged dynamic table";
    }

    std::string_view bytes_;
    Elf64_Ehdr header_{};
    std::vector<Elf64_Phdr> segments_;
};

}  // namespace

std::optional<std::string> elf_fault(std::string_view bytes) { return ElfCheck(bytes).run(); }

}  // namespace quadrel
