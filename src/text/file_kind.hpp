#pragma once

#include <string>
#include <string_view>

namespace slipfront {

/// As what a file is to be read.
enum class ReadAs { events, table, scenario };

/// Recognizes files of other programs and other commands by their first lines, so that their readers do not report
/// errors of TOML or CSV. \throws InputError that names the kind of the file and states what to do, if it is one that
/// cannot be read so.
void refuse_other_kinds(std::string_view text, const std::string& file, ReadAs as);

}  // namespace slipfront
