// Finds what a server says of rows that it left out.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>

namespace nightcity::inventory {

/// Returns what the server that made a file in GeoJSON or Esri's JSON says it left out, by what
/// stands in the first and the last 64 kB; "" where it says nothing: an answer cut at a server's
/// limit is a whole file. `path`: as GDAL takes it. `rows`: as many as the file has.
std::string find_server_limit(const std::string& path, std::size_t rows);

/// Servers write what they say about the whole within so many bytes of a file's ends.
constexpr std::size_t edge_bytes = std::size_t{1} << 16;

/// Returns the first and the last 64 kB of a file, or all of a smaller one; "" where it cannot be
/// read.
std::string read_edges(const std::string& path);

/// Say in the same words, with the remedy: that a mark `key` says that there are more rows, how
/// many of how many were sent, and that there is a next page.
std::string say_part_of_rows(std::string_view key);
std::string say_some_of_rows(std::size_t sent, std::size_t all, std::string_view key);
std::string say_one_page();

}  // namespace nightcity::inventory
