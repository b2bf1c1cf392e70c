// Gives memory back before its owner ends.
#pragma once

namespace nightcity {

/// Makes a container empty and frees its memory. `values = {}` would keep it: a vector takes that
/// for a list of no elements, and stays as large as it was.
template <class Container>
void free_memory(Container& values) {
  values = Container();
}

}  // namespace nightcity
