# What the page and the extension for Visual Studio Code are made of: to be sourced by tools/page.sh and tools/vscode.sh, with $source, the
# folder in web/ whose package-lock.json says what npm fetches, and $modules, where that goes. Leaves glint-lint in $web, in the folder $here.
libraries=${GLINT_WEB:-$here/build/web-root}
for program in emcc cmake node; do
    command -v "$program" >/dev/null || {
        echo "$0: needs $program" >&2
        exit 1
    }
done

# log COMMAND...: its output only where it fails.
log() {
    "$@" >"$here/build/$source.log" 2>&1 || {
        tail -n 40 "$here/build/$source.log" >&2
        exit 1
    }
}
mkdir -p "$here/build"
[ -d "$libraries/root" ] || "$here/tools/web.sh" "$libraries"
cd "$here"
export GLINT_WEB="$libraries"
web=${GLINT_WEB_BUILD:-$here/build/web}
log cmake --preset web -B "$web"
log cmake --build "$web" --parallel 2 --target npm_package
if ! cmp -s "web/$source/package-lock.json" "$modules/package-lock.json"; then
    rm -rf "$modules"
    mkdir -p "$modules"
    cp "web/$source/package.json" "$modules"
    cp "web/$source/package-lock.json" "$modules/lock.tmp"
    (cd "$modules" && cp lock.tmp package-lock.json && log npm ci --ignore-scripts --no-audit --no-fund) || {
        rm -rf "$modules"
        exit 1
    }
    rm "$modules/lock.tmp"
fi
