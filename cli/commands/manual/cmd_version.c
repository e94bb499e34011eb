// glint --version.
#include "cli/about/about.h"
#include "cli/commands/commands.h"
#include "files/sandbox.h"

int cmd_version(struct cli *cli) {
    struct strbuf text;
    strbuf_init(&text);
    const int landlock = sandbox_landlock();
    about_program(GLINT_VERSION, GLINT_DEVICE, &text);
    if (landlock)
        strbuf_format(&text, "--untrusted is enforced by the kernel, too (Landlock %d)\n", landlock);
    else
        strbuf_cstr(&text, "--untrusted is enforced by glint alone: the system has no Landlock\n");
    const int status = cli_print(cli, strbuf_view(&text));
    strbuf_finish(&text);
    return status;
}
