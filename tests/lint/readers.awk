# Of lines "T LINE" of readers.txt and what nm says of objects: readers that fuzzing does not reach.
function is_door(name) {
    return name ~ /^(files_read|files_read_given|files_read_found|stream_read|stream_read_file|spool_open|spool_read|folder_store_read|folder_store_open|cli_read_stream)$/ ||
           name ~ /^(__)?(read|readv|pread|pread64|fread|fgets|fgetc|getc|getline|getdelim|fscanf|mmap|mmap64|recv)(_unlocked)?(_chk)?$/
}
function wrong(line, what) {
    printf "tests/lint/readers.txt:%d: %s\n", line, what
}
$1 == "T" {
    lines++
    if ($2 == "" || $2 == "#")
        next
    if ($3 == "" || ($3 == "-" && $4 == ""))
        wrong(lines, "has neither a function nor a reason")
    said[$2] = $3
    place[$2] = lines
    next
}
{
    file = substr($1, length(build) + 1)
    sub(/\/CMakeFiles\/[^\/]*/, "", file)
    sub(/\.o(\[.*)?:$/, "", file)
    if (file ~ /^tests\/fuzz\// && !(file in reached)) {
        reached[file]
        queue[++count] = file
    }
}
$3 == "U" {
    uses[file, $2]
    used[file] = used[file] " " $2
    if (is_door($2) && !(file in door))
        door[file] = $2
}
$3 ~ /^[A-TV-Z]$/ { home[$2] = file }
END {
    for (i = 1; i <= count; i++) {
        n = split(used[queue[i]], names, " ")
        for (j = 1; j <= n; j++)
            if (names[j] in home && !(home[names[j]] in reached)) {
                reached[home[names[j]]]
                queue[++count] = home[names[j]]
            }
    }
    for (file in door) {
        if (file in reached)
            continue
        if (!(file in said))
            printf "%s:1: reads bytes (%s), and no target of tests/fuzz reaches it\n", file, door[file]
    }
    for (file in said) {
        name = said[file]
        if (!(file in door) || file in reached)
            wrong(place[file], file " needs no line: " (file in door ? "fuzzing reaches it" : "it reads nothing"))
        else if (name != "-" && !((file, name) in uses))
            wrong(place[file], file " does not use " name)
        else if (name != "-" && !(home[name] in reached))
            wrong(place[file], "no target of tests/fuzz reaches " name)
    }
}
