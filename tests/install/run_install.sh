#!/bin/sh
# cmake --install: run_install.sh GLINT SOURCE WORK BUILD. What is installed runs where there is no source tree, its
# pages are clean, and shells complete what --help lists.
build=$4
. "$2/tests/cli/lib.sh"

DESTDIR=$work/root cmake --install "$build" --prefix /usr >install.log 2>&1 || {
    cat install.log
    fail "cmake --install"
    exit 1
}
share=$work/root/usr/share
pass "cmake --install"

# ---- anywhere

moved=$(mktemp -d)
trap 'rm -rf "$moved"' EXIT
cp -R "$work/root/usr/." "$moved"
for place in "$source" "$build"; do
    grep -qaF "$place/" "$moved/bin/glint" && fail "the program names $place"
done
# run COMMAND: in the moved folder, with the sources covered by an empty folder where that is allowed.
hides=
unshare -rm true 2>/dev/null && hides=yes
run() {
    if [ -n "$hides" ]; then
        unshare -rm sh -c 'mount -t tmpfs none "$1" && cd "$2" && shift 2 && exec "$@"' sh "$source" "$moved" "$@"
    else
        (cd "$moved" && "$@")
    fi
}
[ -n "$hides" ] || echo "note: the sources cannot be hidden here"
expect "version" 0 '^glint [0-9]+\.[0-9]+\.[0-9]+$' - run bin/glint --version
also "its libraries" '^libyaml [0-9.]+, expat [0-9.]+, .*zlib' ''
expect "a scene that came with it" 0 '' '' run bin/glint check share/doc/glint/examples
expect "a picture" 0 '' '' run bin/glint render share/doc/glint/examples/tutorial/step-7.glint.yaml \
    --device reference --no-cache --size 32x24 -o picture.png
[ -s "$moved/picture.png" ] && pass "it is there" || fail "there is no picture"
expect "a schema for a scene" 0 '' '' run bin/glint schema install --schema ../schema.json \
    share/doc/glint/examples/tutorial/step-1.glint.yaml
"$glint" schema json | cmp -s - "$share/glint/schema/glint.schema.json" && pass "schema" || fail "schema is stale"
for file in doc/glint/copyright doc/glint/CHANGELOG.md doc/glint/docs/language.md glint/hooks/pre-commit-hooks.yaml \
    glint/ci/gitlab.yml; do
    [ -s "$share/$file" ] || fail "share/$file is missing"
done

# ---- pages

commands=$("$glint" --help | sed -n '/^Commands:/,/^$/s/^  \([a-z]*\) .*/\1/p')
[ "$(printf '%s\n' "$commands" | wc -l)" -ge 17 ] || fail "the commands are not all of them: $commands"
for page in glint $(printf 'glint-%s\n' $commands); do
    gzip -dc "$share/man/man1/$page.1.gz" >page.1 || {
        fail "$page has no page"
        continue
    }
    if command -v mandoc >/dev/null; then
        mandoc -Tlint page.1 >page.txt 2>&1 || {
            fail "$page.1"
            cat page.txt
        }
    fi
    if command -v man >/dev/null; then
        LC_ALL=C.UTF-8 MANROFFSEQ='' MANWIDTH=80 man --warnings -E UTF-8 -l -Tutf8 -Z page.1 2>page.txt >/dev/null
        [ ! -s page.txt ] || {
            fail "$page.1 as man sees it"
            cat page.txt
        }
    fi
done
# Nothing of --help is lost on the way.
"$glint" render --help | grep -oE '[-]-[a-z-]+' | sort -u >options.txt
"$glint" manual page render | sed 's/\\-/-/g' | grep -oE '[-]-[a-z-]+' | sort -u >page.txt
[ -z "$(comm -23 options.txt page.txt)" ] && pass "pages" || fail "not in the page: $(comm -23 options.txt page.txt)"
expect "a page for a command that is not there" 2 - "there is no command 'rendr'" "$glint" manual page rendr
expect "a kind that is not there" 2 - "did you mean 'bash'" "$glint" manual bsh

# ---- shells

# completed NAME WANTED_WORD... after what complete.txt holds.
completed() {
    name=$1
    shift
    for word in "$@"; do
        grep -qxF -e "$word" complete.txt || {
            fail "$name: '$word' is not offered, but: $(tr '\n' ' ' <complete.txt)"
            return
        }
    done
    pass "$name"
}

# all SHELL: in complete.txt is what it offers after `glint COMMAND --`; --help lists the same.
all() {
    for command in $commands; do
        "$glint" "$command" --help | sed -n 's/^  \(-., \|    \)\(--[a-z-]*\).*/\2/p' | sort -u >options.txt
        "$1" "glint $command --"
        sed 's/=.*//' complete.txt | grep '^--' | sort -u | cmp -s - options.txt || {
            fail "$1: options of $command"
            sed 's/=.*//' complete.txt | sort -u | diff - options.txt
        }
    done
    pass "$1: options of all commands"
}

in_bash() {
    bash --norc -c '. "$1"
        read -r -a COMP_WORDS <<<"$2"
        case $2 in *" ") COMP_WORDS+=("") ;; esac
        COMP_CWORD=$((${#COMP_WORDS[@]} - 1))
        _glint
        [ ${#COMPREPLY[@]} -eq 0 ] || printf "%s\n" "${COMPREPLY[@]}"' \
        bash "$share/bash-completion/completions/glint" "$1" >complete.txt
}
in_fish() { fish --no-config -c 'source $argv[1]; complete -C "$argv[2]"' "$share/fish/vendor_completions.d/glint.fish" "$1" |
    cut -f1 >complete.txt; }

for shell in bash fish; do
    command -v $shell >/dev/null || {
        echo "skip $shell is not installed"
        continue
    }
    in_$shell 'glint re' && completed "$shell: a command" render
    in_$shell 'glint ' && completed "$shell: commands" $commands help
    in_$shell 'glint help ma' && completed "$shell: help about a command" manual
    in_$shell 'glint render --de' && completed "$shell: an option" --device
    in_$shell 'glint render --as ' && completed "$shell: words of an option" yaml xml
    in_$shell 'glint schema ' && completed "$shell: words of a command" json relaxng rnc markdown
    all in_$shell
done

# A terminal types what the test types: zsh completes only there.
if command -v zsh >/dev/null; then
    cp "$share/zsh/site-functions/_glint" .
    cat >complete.zsh <<'END'
zmodload zsh/zpty
zpty shell 'PS1= zsh -f -i'
zpty -w shell 'fpath=('$1' $fpath); autoload -Uz compinit; compinit -u -D; zstyle ":completion:*" list-colors; LISTMAX=0; stty -echo; COLUMNS=200'
zpty -w shell 'bindkey "^I" complete-word; unsetopt zle_bracketed_paste list_ambiguous; print rea"dy"'
zpty -r -m shell line '*ready*'
zpty -w -n shell "$2"$'\t'
sleep 0.3
zpty -w -n shell $'\C-a\C-kprint do'"'ne'"$'\n'
zpty -r -m shell line '*done*'
print -r -- "$line"
zpty -d shell
END
    in_zsh() {
        TERM=dumb zsh -f complete.zsh "$work" "$1" 2>&1 | tr -d '\r' | sed 's/\x1b\[[0-9;?]*[A-Za-z]//g' >zsh.txt
        grep -qE -e "$2" zsh.txt && pass "zsh: $1" || {
            fail "zsh: $1: '$2' is not offered"
            cat -v zsh.txt
        }
    }
    in_zsh 'glint insp' 'inspect'
    in_zsh 'glint render --dev' '--device'
    in_zsh 'glint schema mark' 'markdown'
else
    echo "skip zsh is not installed"
fi
exit $failed
