// libcitygml 2.4.3 leaks its parser whenever Xerces throws, and a caller cannot free it. Only its
// leaks are ignored.
extern "C" const char* __lsan_default_suppressions() {
  return "leak:citygml::load\n";
}
