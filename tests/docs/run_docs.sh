#!/bin/sh
# What a page shows must work: its scenes are checked, its commands run. Usage, as cli/lib.sh has it:
# run_docs.sh GLINT SOURCE_FOLDER WORK_FOLDER PAGE [scenes], the last for scenes without commands.
#
# A block ```yaml or ```xml with 'glint: 1' or <Scene is a scene and must have no findings. Any other is a part of one:
# it must have no errors but materials and objects that it does not define. A block ```sh is a list of commands, each of which must
# end with status 0. They run in an empty folder with scenes/, meshes and the files of tests/docs/files, and make small
# pictures. Comments in the page, right before a block, say otherwise:
#
#     <!-- test: not a scene: WHY -->            the block is not checked
#     <!-- test: settings -->                    it is a .glintrc.yaml
#     <!-- test: finds W401 E301 -->             what the check finds, no more and no less
#     <!-- test: file NAME -->                   the block is the file NAME of the commands after it
#     <!-- test: from FILE -->                   its lines occur like this in FILE of the repository, a scene
#     <!-- test: from FILE as NAME -->           and all of that is the file NAME of the commands after it
#     <!-- test: status N -->                    the commands of the block end with status N
#     <!-- test: status N "BEGINNING" -->        those that begin so
#     <!-- test: not run: WHY -->                no command of the block runs
#     <!-- test: not run "BEGINNING": WHY -->    nor do those that begin so
#     <!-- test: printed -->                     a block without language: all that the last command printed
#     <!-- test: printed by COMMAND -->          or that this one prints
here=$(cd "$(dirname -- "$0")" && pwd)
. "$here/../cli/lib.sh"
page=$4
what=${5:-all}
export XDG_CACHE_HOME="$work/cache"

# The folder in which commands run, with a glint that makes small pictures.
stage() {
    mkdir bin play blocks
    cat >bin/glint <<END
#!/bin/sh
before= sized=
for word in "\$@"; do
    shift
    [ "\$before" != --size ] || word=32x20 sized=1
    [ "\$before" != --samples ] || word=2
    before=\$word
    set -- "\$@" "\$word"
done
case \$sized,\$1 in
,render | ,tradeoff | ,extremes) exec "$glint" "\$@" --size 32x20 ;;
esac
exec "$glint" "\$@"
END
    chmod +x bin/glint
    cp -R "$here"/files/* "$source"/scenes/meshes/* play
    cp -R "$source/scenes" play/scenes
    (
        cd play || exit 2
        for mesh in dragon pane door; do
            awk '/^f / && !named++ { print "usemtl Gold" } { print }' gem.obj >$mesh.obj
        done
        cp "$source/tests/fuzz/seeds/ply/text.ply" statue.ply
        cp "$source/tests/data/image/progressive.jpg" sky.jpg
        cp sky.jpg wood.jpg
        cp scene.glint.yaml old.glint.yaml
        sed 's/refractive_index: 1.5/refractive_index: 1.33/' old.glint.yaml >new.glint.yaml
        [ "$what" = scenes ] || ../bin/glint render scene.glint.yaml --quiet --device reference -o reference.png
        "$glint" convert scene.glint.yaml scene.glint.xml && "$glint" convert new.glint.yaml new.glint.xml
    ) || exit 2
}

# mark BEGINNING: what follows it in a mark of the block; false: no such mark.
mark() {
    grep -q "^$1" "$block.marks" && sed -n "s/^$1//p" "$block.marks"
}

# findings FILE: the codes of errors and warnings, sorted, on one line.
findings() {
    "$glint" check --format json "$1" >report.json 2>/dev/null
    [ $? -le 1 ] || echo "no report"
    tr '{,' '\n\n' <report.json | sed -n 's/^ *"code": *"\([EW][0-9]*\)".*/\1/p' | sort -u | tr '\n' ' '
}

# A scene of the page, made whole where it is a part of one.
check_scene() {
    file=play/block_$line.glint.$language
    whole=1
    grep -Eq '^glint: |<Scene' "$text" || whole=0
    case $whole$language in
    0yaml) (echo 'glint: 1' && cat "$text") >"$file" ;;
    0xml) (echo '<Scene glint="1">' && cat "$text" && echo '</Scene>') >"$file" ;;
    *) cp "$text" "$file" ;;
    esac
    found=$(findings "$file" | sed 's/ $//')
    wanted=$(mark 'finds ')
    [ $whole = 1 ] || [ -n "$wanted" ] || found=$(echo "$found" | tr ' ' '\n' | grep -Ev '^W|^E301$|^E308$|^$' | tr '\n' ' ')
    if [ "$found" = "$wanted" ]; then
        pass "$place: ${wanted:-no findings}"
    else
        fail "$place: finds '$found', not '$wanted'"
        "$glint" check "$file" 2>&1 | head -20
    fi
    rm -f "$file"
}

check_settings() {
    mkdir -p play/textures play/meshes
    cp "$text" play/.glintrc.yaml
    if "$glint" check play/scene.glint.yaml >said.txt 2>&1; then
        pass "$place: settings"
    else
        fail "$place: settings"
        head -20 said.txt
    fi
    rm play/.glintrc.yaml
}

# Whether the lines of the block occur in a file of the repository.
check_source() {
    if awk 'NR == FNR { part = part "\n" $0; next } { all = all "\n" $0 }
            END { exit !index(all "\n", part "\n") }' "$text" "$source/$1"; then
        pass "$place: as in $1"
    else
        fail "$place: is not in $1"
    fi
}

# Whether a command is one of those that a mark leaves out.
is_left_out() {
    mark 'not run "' >left_out.txt
    while IFS= read -r rest; do
        case $1 in "${rest%%\":*}"*) return 0 ;; esac
    done <left_out.txt
    return 1
}

# The status that a command must end with.
wanted_status() {
    mark 'status ' >statuses.txt
    while IFS= read -r rest; do
        beginning=
        case $rest in *\"*) beginning=${rest#*\"} ;; esac
        case $1 in "${beginning%\"}"*) echo "${rest%% *}" && return ;; esac
    done <statuses.txt
    echo 0
}

run_command() {
    case " $1" in
    *" glint "*) ;;
    *) fail "$place: '$1' does not run glint: mark it as not run" && return ;;
    esac
    wanted=$(wanted_status "$1")
    (cd play && PATH="$work/bin:$PATH" sh -c "$1" >../printed.txt 2>&1 </dev/null)
    got=$?
    if [ $got -eq "$wanted" ]; then
        pass "$place: $1"
    else
        fail "$place: status $got, not $wanted, of: $1"
        head -20 printed.txt
    fi
}

run_commands() {
    sed -e ':a' -e '/\\$/{N;s/\\\n *//;ta' -e '}' -e '/^ *#/d' -e '/^ *$/d' "$text" >commands.txt
    while IFS= read -r command <&3; do
        is_left_out "$command" || run_command "$command"
    done 3<commands.txt
}

check_printed() {
    command=$(mark 'printed by ') && (cd play && PATH="$work/bin:$PATH" sh -c "$command" >../printed.txt 2>&1 </dev/null)
    if cmp -s "$text" printed.txt; then
        pass "$place: as printed"
    else
        fail "$place: is not what the last command printed"
        diff "$text" printed.txt | head -20
    fi
}

check_block() {
    file=$(mark 'from ') && check_source "${file%% as *}"
    case $file in *" as "*) cp "$source/${file%% as *}" "play/${file##* as }" ;; esac
    name=$(mark 'file ') && cp "$text" "play/$name"
    case $language in
    yaml | xml) [ -z "$file" ] || return 0 ;;
    esac
    case $language in
    yaml) mark settings >/dev/null && check_settings && return 0 ;;
    esac
    case $language in
    yaml | xml) mark 'not a scene: ' >/dev/null || check_scene ;;
    sh) [ "$what" = scenes ] || mark 'not run: ' >/dev/null || run_commands ;;
    plain) [ "$what" = all ] && mark printed >/dev/null && check_printed ;;
    esac
    return 0
}

stage
awk -v folder=blocks -f "$here/fences.awk" "$source/$page" >blocks.txt || fail "$page: a block or a mark does not end"
while read -r line language <&4; do
    block=blocks/$line
    text=$block.$language
    place=$page:$line
    check_block
done 4<blocks.txt
exit $failed
