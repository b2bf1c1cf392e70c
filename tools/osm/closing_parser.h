// Closes the files of broken PBFs, which libosmium leaves open.
#pragma once

namespace nightcity::osm {

/// Makes libosmium close a PBF also where an exception ends its parser: libosmium 2.19, Debian's,
/// closes it behind the last blob alone (PBFParser::run). Call it before a Reader is made; once is
/// enough, and it is safe on many threads.
void close_broken_maps();

}  // namespace nightcity::osm
