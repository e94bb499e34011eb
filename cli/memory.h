// The end of the program where the system has no memory left: what is half made is removed, "out of memory"
// is written to standard error, and the exit status is CLI_FILE. So nothing is reported that would be told
// differently with more memory.
//
// Needs no memory itself. Thread safety: memory_catch belongs at the beginning of the program; memory may
// then end on any thread.
#ifndef GLINT_CLI_MEMORY_H
#define GLINT_CLI_MEMORY_H

void memory_catch(void);
// The same with CLI_REFUSED, as it was --untrusted that refused it; and so where the time is over.
void memory_catch_untrusted(void);

#endif
