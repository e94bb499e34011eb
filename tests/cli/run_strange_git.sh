#!/bin/sh
# check --changed --untrusted in a repository whose own settings, hooks and attributes name programs for git to run: none
# of them runs, and the answer is right.
# Usage: run_strange_git.sh GLINT SOURCE_FOLDER WORK_FOLDER
. "$(dirname -- "$0")/lib.sh"
if ! command -v git >/dev/null; then
    echo 'skipped: git is not installed'
    exit 77
fi
GIT_CEILING_DIRECTORIES=$work GIT_CONFIG_GLOBAL=$work/gitconfig GIT_CONFIG_NOSYSTEM=1 HOME=$work
export GIT_CEILING_DIRECTORIES GIT_CONFIG_GLOBAL GIT_CONFIG_NOSYSTEM HOME
git config --global user.name tester
git config --global user.email tester@localhost
git config --global protocol.file.allow always

# A program that leaves a mark, and copies what a filter is given.
printf '#!/bin/sh\n: >"%s/ran"\n[ "$1" = copy ] && cat\nexit 0\n' "$work" >evil
chmod +x evil
cat >plain.yaml <<'G'
glint: 1
camera: {position: [0, 0, 4]}
lights: [{position: [-5, 8, 5]}]
spheres: [{center: [0, 0, 0], radius: 1}]
G
# begin: a repository in which a has changed, b is as it was, and c too, but for its time, so that git looks at its bytes.
begin() {
    cd "$work" && rm -rf repo ran && git init -q repo && cd repo || exit 2
    for scene in a b c; do cp ../plain.yaml $scene.glint.yaml; done
    printf '%s\n' "$*" >.gitattributes
    touch -d 2020-01-01 ./*.yaml .gitattributes
    git add -A && git commit -q -m one
    sed -i 's/radius: 1/radius: 2/' a.glint.yaml
    touch c.glint.yaml
}
# quiet NAME: what was set up has an effect on git, but not on --untrusted.
answer='^glint: 1 of 3 scenes reads what changed'
quiet() {
    rm -f "$work/ran"
    tells "$1" 0 "${2:-$answer}" "$glint" check --changed --untrusted
    [ ! -e "$work/ran" ] && pass "$1: nothing runs" || fail "$1: the repository's program was run"
}
# loud NAME: without --untrusted, git runs it, as it does for its user.
loud() {
    rm -f "$work/ran"
    "$glint" check --changed >out.txt 2>&1
    [ -e "$work/ran" ] && pass "$1: git would run it" || fail "$1: this test proves nothing"
}

begin
quiet 'a plain repository'
git config core.fsmonitor "$work/evil"
quiet 'a monitor'
loud 'a monitor'
git config core.fsmonitor true
quiet 'a monitor of git'
[ -z "$(pgrep -f "fsmonitor--daemon.*$work" 2>/dev/null)" ] && pass 'no daemon' || fail 'a daemon was started'

begin
cp ../evil .git/hooks/post-index-change
index=$(cksum <.git/index)
quiet 'a hook'
if "$glint" --version | grep -q Landlock; then
    [ "$index" = "$(cksum <.git/index)" ] && pass 'the index is not written' || fail 'the index was written'
fi
loud 'a hook'
begin
mkdir hooks && cp ../evil hooks/post-index-change
printf 'hooks\n' >.git/info/exclude
git config core.hooksPath hooks
quiet 'a folder of hooks'
loud 'a folder of hooks'

begin '*.yaml diff=x'
git config diff.external "$work/evil"
git config diff.x.command "$work/evil"
git config diff.x.textconv "$work/evil"
quiet 'differences of its own'

for required in false true; do
    begin '*.yaml filter=x'
    git config filter.x.clean "$work/evil copy"
    git config filter.x.smudge "$work/evil copy"
    git config filter.x.required $required
    quiet "a filter, required: $required"
    loud "a filter, required: $required"
    begin '*.yaml filter=x.y'
    git config filter.x.y.process "$work/evil"
    git config filter.x.y.required $required
    quiet "a filter that stays, required: $required"
    loud "a filter that stays, required: $required"
done
begin '*.yaml filter=x'
printf '[filter "x"]\n\tclean = "%s copy"\n' "$work/evil" >../more
git config include.path "$work/more"
quiet 'a filter of an included file'
git config --unset include.path
git config 'filter.x=y.clean' "$work/evil copy"
expect 'a filter that has no name' 2 - 'E810' "$glint" check --changed --untrusted
[ ! -e "$work/ran" ] && pass 'is not run' || fail 'a filter that has no name was run'

# What is not there would be fetched.
begin
git config core.repositoryFormatVersion 1
git config extensions.partialClone origin
git config remote.origin.url "$work/repo"
git config remote.origin.promisor true
git config remote.origin.uploadpack "$work/evil"
git config core.sshCommand "$work/evil"
tree=$(git rev-parse 'HEAD^{tree}')
rm -f ".git/objects/$(echo "$tree" | cut -c1-2)/$(echo "$tree" | cut -c3-)"
rm -f "$work/ran"
expect 'what is to be fetched is not' 2 - 'E810' "$glint" check --changed --untrusted
[ ! -e "$work/ran" ] && pass 'and no program is run for it' || fail 'a program was run to fetch'
loud 'what is to be fetched'

# A submodule has settings of its own: all in it counts as changed.
begin
git init -q ../sub 2>/dev/null
(cd ../sub && cp ../plain.yaml s.glint.yaml && git add -A && git commit -q -m one)
git submodule --quiet add ../sub sub
git add -A && git commit -q -m two
git -C sub config core.fsmonitor "$work/evil"
quiet 'a submodule' '^glint: 1 of 4 scenes reads what changed'
loud 'a submodule'

# Its files are said to be elsewhere.
begin
mkdir -p ../elsewhere && cp ../plain.yaml ../elsewhere/secret.glint.yaml
git config core.worktree "$work/elsewhere"
expect 'files elsewhere' 2 - 'its files are elsewhere.*E810' "$glint" check --changed --untrusted
git config core.worktree "$work"
expect 'files above' 2 - 'its files are elsewhere.*E810' "$glint" check --changed --untrusted
cd "$work" && rm -rf repo && git init -q --bare repo && cd repo || exit 2
git config core.bare false
git config core.worktree "$work/elsewhere"
expect 'a repository that is the folder' 2 - 'E810' "$glint" check --changed --untrusted

begin
mkdir below && cp a.glint.yaml below
quiet_below=$(cd below && "$glint" check --changed --untrusted 2>&1)
case $quiet_below in *'2 of 4 scenes read what changed'*) pass 'from a folder of it' ;; *) fail "from a folder of it: $quiet_below" ;; esac
git worktree add -q ../tree 2>/dev/null && cd ../tree || exit 2
tells 'in another work tree' 0 '^glint: none of 3 scenes' "$glint" check --changed --untrusted
expect 'a revision that is none' 2 - 'bad revision.*E810' "$glint" check --changed --untrusted no-such
exit "$failed"
