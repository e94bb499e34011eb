// Folders of files: copied, removed, and told in one text that is equal for equal folders.
//
// Ownership: results are the caller's. Errors: end the test with a message. Thread safety: one thread.
#ifndef GLINT_TESTS_FAULTS_FOLDER_H
#define GLINT_TESTS_FAULTS_FOLDER_H

#include "task.h"

struct bytes read_whole(const char *path);
void copy_file(const char *from, const char *to);
void copy_folder(const char *from, const char *to);
void remove_folder(const char *path);
// A line for each file: its path, its size and a hash of its bytes; and for each folder that is empty.
struct bytes tell_folder(const char *path);
// Whether every line of `now` is one of `before` or of `after`, and none is lost.
bool is_mix(const char *now, const char *before, const char *after);

#endif
