// Recognises files that are no glTF but are given for one, so that the message can say what they
// are and what to do.
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <string>

namespace nightcity {

/// Returns what a file is that starts with `bytes`, and how to get a scene from it, as the end of a
/// message ("is gzip-compressed: decompress it first (gunzip)"). Returns nothing where the bytes
/// are not known.
std::optional<std::string> describe_foreign_file(std::span<const std::byte> bytes);

/// Returns why a glTF file that requires this extension cannot be read, and the remedy: meshes that
/// are stored in a way that this program does not decode.
std::string describe_required_extension(const std::string& name);

}  // namespace nightcity
