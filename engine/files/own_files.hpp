// Keeps track of the files that Pulvis wrote, and in which role: it never replaces or removes any other file.
//
// A folder that it writes into holds .pulvis-files with one line per file: state, checksum and bytes, role, name.
//   next   the file may hold these bytes soon: recorded before it is replaced
//   whole  the file holds exactly these bytes
//   start  the file begins with these bytes, and grows
// The last such line for a name and role counts, and all `next` lines after it. A file is Pulvis's own in that role
// if its bytes match; one that someone else changed or put there is not. run.h5, its journal, files for VTK and
// checkpoints are identified by their first bytes. Lines are only appended, each with one write: several programs may do so.
//
// Text is first written beside it, as .<name>.pulvis-new, and renamed: links to the old file keep the old one.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>

#include "engine/files/output_error.hpp"

namespace pulvis {

// There is already a file not written by Pulvis at an output path.
class ForeignFile : public OutputError {
 public:
  using OutputError::OutputError;
};

// The kind of output that a file belongs to.
namespace role {
inline constexpr const char* run = "run";
inline constexpr const char* study = "study";
inline constexpr const char* probe = "probe";
inline constexpr const char* fit = "fit";
inline constexpr const char* reduction = "reduction";
inline constexpr const char* packing = "packing";
inline constexpr const char* comparison = "comparison";
inline constexpr const char* figure = "figure";
}  // namespace role

enum class Extent { whole, start };

bool is_own(const std::filesystem::path& file, std::string_view of);
// Throws ForeignFile if there is a file that is not Pulvis's own; links and folders never are.
void require_own_or_none(const std::filesystem::path& file, std::string_view of);
// Likewise if the folder has a list, .pulvis-files, that is not Pulvis's own.
void require_own_list_in(const std::filesystem::path& folder);
// Likewise if `file`, by whatever path, is the input file being read.
void require_another(const std::filesystem::path& read, const std::filesystem::path& file);

void write_own(const std::filesystem::path& file, std::string_view of, std::string_view text,
               Extent extent = Extent::whole);
// For callers that write `start` and more themselves: into the file returned by begin_own, then call end_own.
std::filesystem::path begin_own(const std::filesystem::path& file, std::string_view of,
                                std::string_view start);
void end_own(const std::filesystem::path& file, std::string_view of, std::string_view start,
             Extent extent);
// The temporary name of a text until it is complete; unique. An existing file is removed, so no link is followed.
std::filesystem::path fresh_beside(const std::filesystem::path& file);
// The new file inherits the list entries of the file it replaces.
void replace_own(const std::filesystem::path& file, std::string_view of, std::string_view text);
// Records that a file that has grown now holds these bytes.
void note_own(const std::filesystem::path& file, std::string_view of, std::string_view bytes,
              Extent extent);
void note_own(const std::filesystem::path& file, std::string_view of, std::uint64_t checksum,
              std::uint64_t bytes);

// Writes text in front of the HDF5 part of a file: its mark.
void write_head(const std::filesystem::path& file, std::string_view text);

// Removes the file if it is Pulvis's own; for a folder, all such files, those half-written, and the folder itself if it is
// then empty.
void remove_own(const std::filesystem::path& file, std::string_view of);
void remove_own_below(const std::filesystem::path& folder, std::string_view of);

}  // namespace pulvis
