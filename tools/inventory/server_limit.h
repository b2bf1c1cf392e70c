// Tells whether a server cut its answer off at its own limit of rows.
#pragma once

#include <filesystem>
#include <string>

namespace nightcity::inventory {

/// Returns what an answer in JSON says about rows that the server did not send, with the remedy, as
/// a sentence for a report: `exceededTransferLimit` of ArcGIS, and `numberMatched` above
/// `numberReturned` of OGC API and WFS, near the file's beginning or end. "" where it says nothing.
std::string find_server_limit(const std::filesystem::path& file);

}  // namespace nightcity::inventory
