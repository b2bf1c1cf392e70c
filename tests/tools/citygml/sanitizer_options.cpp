// libcitygml 2.4.3 leaks its parser whenever Xerces throws: nothing a caller could free. Its leaks alone are
// silent.
extern "C" const char* __lsan_default_suppressions() {
  return "leak:citygml::load\n";
}
