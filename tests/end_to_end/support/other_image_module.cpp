// A module for images of another version than the program's, and one from before there were
// versions. Their tables hold nothing that could be called.
extern "C" {
extern const char gnomonImageModule[];
const char gnomonImageModule[64] = {};
#ifdef OTHER_VERSION
extern const char gnomonImageModuleVersion[];
const char gnomonImageModuleVersion[] = "of another day";
#endif
}
