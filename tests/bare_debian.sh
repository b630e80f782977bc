#!/bin/sh
# Both commands of the README in a bare Debian 12: minbase, python3 and certificates.
# What is committed is run, as root. Arguments go to ./roofslip test:
#   sudo tests/bare_debian.sh [tests/solver/test_public.py ...]
# With --image, the steps of the Dockerfile instead, and the page and a report as its user.
set -eu

here=$(CDPATH='' cd -- "$(dirname -- "$0")/.." && pwd -P)

fail() {
    printf '%s\n' "$*" >&2
    exit 1
}

[ "$(id -u)" = 0 ] || fail "a root file system can be made by root only. Run: sudo $0"
PATH=$PATH:/usr/sbin:/sbin
for pair in debootstrap=debootstrap git=git unshare=util-linux; do
    command -v "${pair%%=*}" >/dev/null \
        || fail "${pair%%=*} is not installed. Run: sudo apt-get install ${pair#*=}"
done

top=$(mktemp -d)
root=$top/root
trap 'rm -rf --one-file-system "$top"' EXIT
trap 'exit 130' INT TERM

# Of the host's environment, the root gets only what leads to registries.
# shellcheck disable=SC2013
for name in $(awk 'BEGIN { for (name in ENVIRON) print name }'); do
    case $name in
        PATH | PIP_* | UV_* | SSL_CERT_* | *_proxy | *_PROXY) ;;
        *[!A-Za-z0-9_]*) ;; # a function of another shell
        *) unset "$name" ;;
    esac
done
export HOME=/root

make_root() {
    # The host's own mirror; on another system the default one.
    # shellcheck disable=SC2016
    mirror=$(apt-get indextargets --format '$(REPO_URI)' 'Created-By: Packages' \
        'Codename: bookworm' 2>/dev/null | head -n 1)
    debootstrap --variant=minbase --include=python3,ca-certificates bookworm "$root" \
        ${mirror:+"$mirror"} >"$top/output" 2>&1 || { cat "$top/output"; fail "debootstrap failed"; }
    apt-config dump Acquire >"$root/etc/apt/apt.conf.d/90host" || true
    for file in /etc/hosts /etc/resolv.conf /etc/pip.conf /etc/ssl/certs/ca-certificates.crt; do
        [ ! -e "$file" ] || cp -L "$file" "$root$file"
    done
}

# Unpacks what is committed, or the given parts of it, in a folder of the root.
unpack() {
    mkdir -p "$root$1"
    target=$root$1 && shift
    git -c safe.directory="$here" -C "$here" archive HEAD "$@" | tar -x -C "$target"
}

# Runs a script of the shell in the root, as a user. The mounts and all processes end with their name
# spaces. `|| exit` keeps the shell as process 1: it collects orphans, which Python would not.
inside() {
    # shellcheck disable=SC2016
    unshare --mount --pid --fork --kill-child sh -euc '
        cd "$1" && user=$2 && shift 2
        mount -t proc proc proc
        mount -t devpts devpts dev/pts
        mount -t tmpfs shm dev/shm
        chroot --userspec="$user" . sh -c "$@" || exit
    ' sh "$root" "$@"
}

run() {
    code=0
    started=$(date +%s)
    inside "$@" >"$top/output" 2>&1 </dev/null || code=$?
    seconds=$(($(date +%s) - started))
    shift 3
    printf '$ roofslip %s\n' "$*"
    if [ "$code" = 0 ]; then
        grep '^roofslip: ' "$top/output" || true
        tail -n 10 "$top/output"
    else
        cat "$top/output"
        failed=1
    fi
    printf '%s s, exit code %s\n\n' "$seconds" "$code"
}

# The Dockerfile's COPY (by .dockerignore), ENV, RUN and USER; FROM is the root as it is.
run_image() {
    # shellcheck disable=SC2046
    unpack /opt/roofslip -- $(sed -n 's/^!//p' "$here/.dockerignore")
    mkdir "$root/projects"
    cp -r "$here/projects/example" "$root/projects/yours"
    rm -rf "$root/projects/yours/out"
    chown -R 1000 "$root/projects"
    environment="export HOME=/root $(sed -n 's/^ENV //p' "$here/Dockerfile")"
    steps=$(awk '/^RUN / { on = 1; sub(/^RUN /, "") } on; !/\\$/ { on = 0 }' "$here/Dockerfile")
    run 0 "$environment; cd /opt/roofslip/projects; $steps" sh "(the steps of the image)"
    user=$(sed -n 's/^USER //p' "$here/Dockerfile")
    command="$environment HOME=~roofslip; cd /projects; exec roofslip \"\$@\""
    run "$user:$user" "$command" sh report yours
    run "$user:$user" "$command" sh serve --once --port 0
    run "$user:$user" "$command" sh verify --quick --out /tmp/out
}

failed=0
make_root
if [ "${1-}" = --image ]; then
    run_image
else
    unpack /roofslip
    # shellcheck disable=SC2016
    command='cd /roofslip && exec ./roofslip "$@"'
    run 0 "$command" sh report projects/example
    run 0 "$command" sh test "$@"
fi
exit "$failed"
