#include "cli/about/about.h"

#include <expat.h>
#include <jansson.h>
#include <png.h>
#include <yaml.h>
#include <zlib.h>

#include <stdio.h>

#include <jpeglib.h>

#define TEXT_OF(x) #x
#define TEXT(x)    TEXT_OF(x)

static void add_origin(bool has_devices, struct strbuf *out) {
    if (about_commit[0])
        strbuf_format(out, "commit %s%s%s, ", about_commit, about_date[0] ? " of " : "", about_date);
    strbuf_format(out, "%s\n",
                  has_devices ? "draws on Vulkan devices" : "built to check: draws on no device");
}

// libjpeg gives its version only at compile time.
void about_program(const char *version, bool has_devices, struct strbuf *out) {
    const XML_Expat_Version expat = XML_ExpatVersionInfo();
    strbuf_format(out, "glint %s\n", version);
    add_origin(has_devices, out);
    strbuf_format(out, "libyaml %s, expat %d.%d.%d, jansson %s, libpng %s, zlib %s",
                  yaml_get_version_string(), expat.major, expat.minor, expat.micro, jansson_version_str(),
                  png_get_libpng_ver(NULL), zlibVersion());
#ifdef LIBJPEG_TURBO_VERSION
    strbuf_cstr(out, ", libjpeg-turbo " TEXT(LIBJPEG_TURBO_VERSION));
#endif
    strbuf_char(out, '\n');
}
