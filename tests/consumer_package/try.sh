#!/bin/sh
# Within a bare Debian: what lies in /packages is installed, used and removed.
set -eux
echo 'the packages are tried'
export DEBIAN_FRONTEND=noninteractive
# `set -e` takes no notice of `! command`.
refuse() {
    if "$@"; then
        echo "expected to fail: $*"
        exit 1
    fi
}
writable() { dpkg -L "$1" | xargs -d '\n' ls -ld | grep '^[-d].......w'; }
imports() { command -v python3 && python3 -c 'import quadrel' 2>/dev/null; }
left() { find /etc /usr /opt /srv /var -name '*quadrel*' -not -path '/var/log/*' -not -path '/var/cache/apt/*' | grep .; }
install="apt-get install -qq -y --no-install-recommends"

# The program, without Python.
$install /packages/quadrel_*.deb >/dev/null
cd /tmp
quadrel render thesis-teapot --size 64x64 --preview teapot.png -o teapot.exr
quadrel render bricks-png --size 16x16 -o png.exr
quadrel render bricks-45 --size 4x4 --channels uv --limits gl -o ranges.exr
quadrel export --stage trace/linear | grep -q void
zcat /usr/share/man/man1/quadrel-render.1.gz | grep -q SYNOPSIS
test -e /usr/share/bash-completion/completions/quadrel
test -e /usr/share/zsh/vendor-completions/_quadrel
test -e /usr/share/fish/vendor_completions.d/quadrel.fish
quadrel completion words -- render thesis-tea | grep -q '^thesis-teapot'
zcat /usr/share/doc/quadrel/changelog.gz | grep -q "^quadrel ($(quadrel version | grep -o '[0-9.]*' | head -n 1))"
test -e /usr/share/doc/quadrel/copyright
refuse writable quadrel

if ls /packages/python3-quadrel_*.deb >/dev/null 2>&1; then
    refuse imports
    $install /packages/python3-quadrel_*.deb >/dev/null
    cat >use.py <<'PY'
import importlib.metadata
import pathlib
import numpy as np
import quadrel

assert pathlib.Path(quadrel.__file__).parent == pathlib.Path("/usr/lib/python3/dist-packages/quadrel")
assert importlib.metadata.version("quadrel") == quadrel.__version__
scene = quadrel.load("thesis-teapot", size=(64, 64))
assert scene.file.startswith("/usr/share/quadrel/"), scene.file
film = quadrel.render(scene, ["R", "G", "B", "A", "Z"])
assert film["A"].max() == 1 and film["R"].max() > 0
assert film.hash == quadrel.read("/tmp/teapot.exr").hash  # the program's
assert quadrel.bake(np.eye(8, dtype=np.float32), "max-mip").levels
PY
    python3 use.py
    refuse writable python3-quadrel
    ls /usr/lib/python3/dist-packages/quadrel/__pycache__/*.pyc >/dev/null
    # As another user's, who cannot write there.
    su -s /bin/sh nobody -c 'HOME=/tmp/nobody python3 /tmp/use.py'
    packages="python3-quadrel quadrel"
    # The module goes with what it is made for.
    test "$(apt-get -s remove quadrel | grep -c '^Remv')" -eq 2
fi

installed=$(dpkg -L ${packages:-quadrel} | grep quadrel)
apt-get purge -qq -y ${packages:-quadrel} >/dev/null
hash -r
refuse command -v quadrel
for file in $installed; do
    test ! -e "$file"
done
refuse left
echo 'the packages work'
