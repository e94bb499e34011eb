// Runs a fuzz entry over files, without libFuzzer: each argument is a file or a folder of files.
#include <dirent.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size);

static int replay_file(const char *path, size_t size) {
    FILE *file = fopen(path, "rb");
    uint8_t *data = malloc(size ? size : 1);
    int failed = !file || !data || fread(data, 1, size, file) != size;
    if (failed)
        fprintf(stderr, "%s: cannot be read\n", path);
    else
        LLVMFuzzerTestOneInput(data, size);
    free(data);
    if (file)
        fclose(file);
    return failed;
}

static int replay(const char *path, unsigned *count);

static int replay_folder(const char *path, unsigned *count) {
    DIR *folder = opendir(path);
    if (!folder)
        return 1;
    int failed = 0;
    for (struct dirent *entry; (entry = readdir(folder)) != NULL;) {
        char name[4096];
        if (entry->d_name[0] == '.')
            continue;
        snprintf(name, sizeof name, "%s/%s", path, entry->d_name);
        failed |= replay(name, count);
    }
    closedir(folder);
    return failed;
}

static int replay(const char *path, unsigned *count) {
    struct stat info;
    if (stat(path, &info) != 0) {
        fprintf(stderr, "%s: does not exist\n", path);
        return 1;
    }
    if (S_ISDIR(info.st_mode))
        return replay_folder(path, count);
    ++*count;
    return replay_file(path, (size_t)info.st_size);
}

int main(int argc, char **argv) {
    int failed = argc < 2;
    unsigned count = 0;
    for (int i = 1; i < argc; i++)
        failed |= replay(argv[i], &count);
    printf("%u inputs\n", count);
    return failed || count == 0;
}
