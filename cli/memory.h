// Ends the program when the system has no memory left: removes half-made files, writes "out of memory" to
// standard error, and exits with CLI_FILE. So nothing is reported that would differ with more memory.
//
// Needs no memory itself. Thread safety: memory_catch belongs at the beginning of the program; memory may
// then run out on any thread.
#ifndef GLINT_CLI_MEMORY_H
#define GLINT_CLI_MEMORY_H

void memory_catch(void);
// The same with CLI_REFUSED, because --untrusted refused the memory; also when the time is over.
void memory_catch_untrusted(void);

#endif
