// Linked into programs and tests of sanitizer builds alone (nightcity_keep_libraries_loaded).
#include <dlfcn.h>

/// Takes the place of the system's function and closes nothing. A Vulkan driver is unloaded before
/// the leak sanitizer looks, which then can neither follow pointers that lie in the driver nor name
/// it, so that no suppression for what the driver keeps would match.
extern "C" int dlclose(void* /*handle*/) noexcept {
  return 0;
}
