// Outputs of one command, which appear together or not at all.
#pragma once

#include <vector>

#include "file/atomic_file.hpp"

namespace quadrel {

/// While it lives, the files that this thread commits are finished, but keep their temporary names
/// until commit(). A signal that ends the process before removes all of them, one that comes while
/// they are renamed waits until all are.
class OutputGroup {
  public:
    OutputGroup();
    /// Without commit(): none of the files appears.
    ~OutputGroup();
    OutputGroup(const OutputGroup&) = delete;
    OutputGroup& operator=(const OutputGroup&) = delete;

    /// Throws OutputError, and then files that took free names are gone again.
    void commit();

  private:
    friend class AtomicFile;
    static OutputGroup*& current();
    void publish_through();
    void rename_all();

    OutputGroup* outer_;
    std::vector<AtomicFile> files_;
};

}  // namespace quadrel
