// Which files Pulvis wrote itself, and in which role: it never replaces or removes any other, whatever it is asked.
//
// A folder that it writes into holds .pulvis-files, a line a file: state, checksum and number of bytes, role, name.
//   next   the file may hold these bytes soon: noted before it is replaced
//   whole  it holds these bytes
//   start  it begins with these bytes, and grows
// The last line of a name and role holds, and all `next` behind it. A file is Pulvis's own in that role if its bytes
// are such: one that somebody changed or put there is his. run.h5, its journal and checkpoints say themselves
// what they are, by their first bytes. Lines are only added, each with one write: several programs may do so.
//
// Text is written beside, as .<name>.pulvis-new, and renamed: links to the old file keep the old one.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>

#include "engine/files/output_error.hpp"

namespace pulvis {

// A file that Pulvis did not write stands where it wants to write.
class ForeignFile : public OutputError {
 public:
  using OutputError::OutputError;
};

// What a file belongs to.
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
// Throws ForeignFile where there is one that is not; links and folders are nobody's of Pulvis.
void require_own_or_none(const std::filesystem::path& file, std::string_view of);
// The same where `file`, by whatever path, is the one that is being read.
void require_another(const std::filesystem::path& read, const std::filesystem::path& file);

void write_own(const std::filesystem::path& file, std::string_view of, std::string_view text,
               Extent extent = Extent::whole);
// The same for who writes `start` and more himself: into the file that the first names, before the second.
std::filesystem::path begin_own(const std::filesystem::path& file, std::string_view of,
                                std::string_view start);
void end_own(const std::filesystem::path& file, std::string_view of, std::string_view start,
             Extent extent);
// The name that text has until it is whole: nobody else's. A file of it is gone, so that no link is followed.
std::filesystem::path fresh_beside(const std::filesystem::path& file);
// What the list says of the file holds of the new one, too.
void replace_own(const std::filesystem::path& file, std::string_view of, std::string_view text);
// A file that has grown holds these bytes now.
void note_own(const std::filesystem::path& file, std::string_view of, std::string_view bytes,
              Extent extent);
void note_own(const std::filesystem::path& file, std::string_view of, std::uint64_t checksum,
              std::uint64_t bytes);

// Puts text before what is HDF5 of a file: its mark.
void write_head(const std::filesystem::path& file, std::string_view text);

// Removes the file if it is Pulvis's own; of a folder all that are, and the folder if nothing is left in it.
void remove_own(const std::filesystem::path& file, std::string_view of);
void remove_own_below(const std::filesystem::path& folder, std::string_view of);

}  // namespace pulvis
